"""What a cell of a notebook is sent, and the example notebook, run by a real kernel."""

import base64
import io
import json
import subprocess

import nbformat
import numpy as np
import pytest
import rerun.notebook as rrn
from ipywidgets import Output
from nbclient import NotebookClient
from PIL import Image

import skyline_viz as sv
from skyline_viz.colours import PATH
from skyline_viz.diagnosis.explanation import explain_pixel
from skyline_viz.viewer import entities, notebook
from skyline_viz.viewer.program.rerun_internals import program
from testing import ROOT, SAMPLES
from testing.recordings import Read


@pytest.fixture
def shown(monkeypatch):
    """Viewers that were displayed, with the bundles of their outputs."""
    pytest.importorskip("rerun_notebook", reason="not run, the extra 'notebook' is not installed")
    viewers, bundles = [], []
    widget = notebook.notebook_widget
    monkeypatch.setattr(
        notebook, "notebook_widget", lambda viewer: (viewers.append(viewer), widget(viewer))[1]
    )
    monkeypatch.setattr("IPython.display.display", lambda bundle, raw: bundles.append(bundle))
    return viewers, bundles


def sent(viewer, folder):
    """What a viewer is going to be sent, as a recording."""
    queue = viewer._viewer._event_queue
    parts = [buffers[0] for event, buffers in queue if event["type"] == "rrd"]
    files = [folder / f"{number}.rrd" for number in range(len(parts))]
    for file, part in zip(files, parts, strict=True):
        file.write_bytes(part)
    merged = folder / "merged.rrd"
    subprocess.run(
        [program(), "rrd", "merge", *files, "-o", merged], check=True, capture_output=True
    )
    return Read(merged)


def rover():
    return sv.Detector().detect(sv.read_photo(SAMPLES / "images" / "rover-2.jpg"))


def clicked(viewer, **item):
    """Tell a viewer's listeners that something was selected."""
    event = {"type": "selection_change", "items": [{"type": "entity", **item}]}
    event |= {"application_id": "skyline-viz", "recording_id": "rover"}
    for listener in viewer._viewer._raw_event_callbacks:
        listener(json.dumps(event))


def said(output):
    """What stands below a viewer."""
    return [one["data"] for one in output.outputs]


@pytest.mark.filterwarnings("default::DeprecationWarning")  # of the widgets' library
def test_the_cell_is_sent_the_detection(shown, tmp_path):
    detection = rover()
    sv.show_detection(detection, detection.skyline, name="rover", height=300)
    ((viewer,), (bundle,)) = shown
    assert (viewer._viewer._width, viewer._viewer._height) == ("auto", 300)
    read = sent(viewer, tmp_path)
    assert {entities.PHOTO, entities.EDGES, entities.SCORE, entities.REPORT} <= read.entities()
    assert {entities.BANK_FILTERS, entities.PIXEL_ABOUT} <= read.entities()
    assert read.array(f"{entities.METRICS}/a_err", "scalars") == [0.0]
    assert {"Stages", "Pixel", "Filter bank", "Columns"} <= read.view_names
    assert not {"Diagnosis", "Compare", "Sweep"} & read.view_names
    np.testing.assert_array_equal(read.picture(entities.EDGES) > 0, detection.edges)
    still = Image.open(io.BytesIO(base64.b64decode(bundle["image/png"]))).convert("RGB")
    assert still.width / still.height == pytest.approx(
        detection.edges.shape[1] / detection.edges.shape[0], rel=0.01
    )
    near = (np.abs(np.asarray(still).astype(int) - PATH) < 60).all(axis=2)
    assert near.any(axis=0).mean() > 0.5  # the line is to be seen on it


@pytest.mark.filterwarnings("default::DeprecationWarning")
def test_a_cell_has_all_tabs(shown, tmp_path):
    detection = rover()
    truth = sv.Skyline(rows=np.maximum(detection.skyline.rows - 60, 0))
    other = sv.find_method("gradient").detect(detection.photo)
    sv.show_detection(detection, truth, other=other, sweep=True)
    ((viewer,), _) = shown
    read = sent(viewer, tmp_path)
    assert {"Diagnosis", "Compare", "Sweep", "Pixel"} <= read.view_names
    assert {entities.DIAGNOSIS, entities.COMPARISON, entities.SWEEP_REPORT} <= read.entities()


def test_only_our_settings_can_be_swept(shown):
    found = sv.find_method("gradient").detect(rover().photo)
    with pytest.raises(TypeError, match="not gradient"):
        sv.show_detection(found, sweep=True)


@pytest.mark.filterwarnings("default::DeprecationWarning")
def test_a_click_asks_the_running_python(shown, monkeypatch):
    below = Output()
    monkeypatch.setattr("ipywidgets.Output", lambda: below)
    detection = rover()
    sv.show_detection(detection)
    ((viewer,), _) = shown
    assert said(below) == []
    clicked(viewer, entity_path="/skyline/strip", position=[100.4, 57.9, None])
    words, picture = said(below)
    assert "Column 100" in words["text/markdown"]
    assert explain_pixel(detection, 57, 100).why_edge in words["text/markdown"]
    assert base64.b64decode(picture["image/png"]).startswith(b"\x89PNG")
    clicked(viewer, entity_path="/photo", position=[-3.0, 10.0, None])
    clicked(viewer, entity_path="/photo")
    assert said(below) == [words, picture]  # it stays


def test_without_the_extra_it_says_what_to_install(monkeypatch):
    monkeypatch.setattr(rrn, "HAS_NOTEBOOK", False)
    photo = sv.read_photo(ROOT / "sample_data" / "images" / "rover-2.jpg")
    with pytest.raises(ImportError, match=r'pip install "rerun-sdk\[notebook\]"'):
        sv.show_detection(sv.Detector().detect(photo))


@pytest.mark.filterwarnings("default")  # of the libraries that run notebooks
def test_the_example_notebook_runs():
    pytest.importorskip("ipykernel", reason="not run, ipykernel is not installed")
    pytest.importorskip("rerun_notebook", reason="not run, the extra 'notebook' is not installed")
    example = nbformat.read(ROOT / "docs" / "notebook.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in example.cells)  # kept clean in the repository
    done = NotebookClient(example, timeout=120, resources={"metadata": {"path": ROOT / "docs"}})
    done.execute()
    outputs = [output for cell in example.cells for output in cell.get("outputs", [])]
    texts = [one["text"] for one in outputs if one["output_type"] == "stream"]
    views = [
        one for one in outputs if "application/vnd.jupyter.widget-view+json" in one.get("data", {})
    ]
    (item,) = (one for one in sv.open_dataset(SAMPLES) if one.name == "hazy-1")
    for name in ("default", "paper"):
        error = sv.a_err(sv.find_method(name).detect(item.photo()).skyline, item.truth())
        assert f"A_err {error:.2f} px" in "".join(texts)
    assert len(views) >= 2
    assert all("image/png" in one["data"] for one in views)
    assert len(nbformat.writes(example)) < 2_000_000
    assert not [one for one in outputs if one["output_type"] == "error"]
