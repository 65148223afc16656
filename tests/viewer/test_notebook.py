"""What a cell of a notebook is sent, and the example notebook, run by a real kernel."""

import subprocess

import nbformat
import numpy as np
import pytest
import rerun.notebook as rrn
from nbclient import NotebookClient

import skyline_viz as sv
from skyline_viz.viewer import entities
from skyline_viz.viewer.program.rerun_internals import program
from testing import ROOT, SAMPLES
from testing.recordings import Read


@pytest.fixture
def shown(monkeypatch):
    """Viewers that were displayed."""
    viewers = []

    def display(viewer):
        viewers.append(viewer)

    monkeypatch.setattr(rrn.Viewer, "display", display)
    return viewers


def sent(viewer, folder):
    """What a viewer is going to be sent, as a recording."""
    parts = [buffer for event, (buffer,) in viewer._viewer._event_queue if event["type"] == "rrd"]
    files = [folder / f"{number}.rrd" for number in range(len(parts))]
    for file, part in zip(files, parts, strict=True):
        file.write_bytes(part)
    merged = folder / "merged.rrd"
    subprocess.run(
        [program(), "rrd", "merge", *files, "-o", merged], check=True, capture_output=True
    )
    return Read(merged)


@pytest.mark.filterwarnings("default::DeprecationWarning")  # of the widgets' library
def test_the_cell_is_sent_the_detection(shown, tmp_path):
    pytest.importorskip("rerun_notebook", reason="not run, the extra 'notebook' is not installed")
    photo = sv.read_photo(ROOT / "sample_data" / "images" / "rover-2.jpg")
    detection = sv.Detector().detect(photo)
    sv.show_detection(detection, detection.skyline, name="rover", height=300)
    (viewer,) = shown
    assert (viewer._viewer._width, viewer._viewer._height) == ("auto", 300)
    read = sent(viewer, tmp_path)
    assert {entities.PHOTO, entities.EDGES, entities.SCORE, entities.REPORT} <= read.entities()
    assert read.array(f"{entities.METRICS}/a_err", "scalars") == [0.0]
    assert "Stages" in read.view_names
    np.testing.assert_array_equal(read.picture(entities.EDGES) > 0, detection.edges)


def test_without_the_extra_it_says_what_to_install(monkeypatch):
    monkeypatch.setattr(rrn, "HAS_NOTEBOOK", False)
    photo = sv.read_photo(ROOT / "sample_data" / "images" / "rover-2.jpg")
    with pytest.raises(ImportError, match=r'pip install "skyline-viz\[notebook\]"'):
        sv.show_detection(sv.Detector().detect(photo))


@pytest.mark.filterwarnings("default")  # of the libraries that run notebooks
def test_the_example_notebook_runs():
    pytest.importorskip("ipykernel", reason="not run, ipykernel is not installed")
    pytest.importorskip("rerun_notebook", reason="not run, the extra 'notebook' is not installed")
    notebook = nbformat.read(ROOT / "docs" / "notebook.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells)  # kept clean in the repository
    done = NotebookClient(notebook, timeout=120, resources={"metadata": {"path": ROOT / "docs"}})
    done.execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    texts = [one["text"] for one in outputs if one["output_type"] == "stream"]
    views = [
        one for one in outputs if "application/vnd.jupyter.widget-view+json" in one.get("data", {})
    ]
    (item,) = (one for one in sv.open_dataset(SAMPLES) if one.name == "hazy-1")
    for name in ("default", "paper"):
        error = sv.a_err(sv.find_method(name).detect(item.photo()).skyline, item.truth())
        assert f"A_err {error:.2f} px" in "".join(texts)
    assert len(views) >= 2
    assert not [one for one in outputs if one["output_type"] == "error"]
