"""Methods of somebody's: the example of the docs in every command, and what may go wrong."""

import json
import pickle
import re
import subprocess
import sys

import numpy as np
import pytest

import skyline_viz as sv
from annotate import LiveWire
from annotate.work.overlays import overlay
from skyline_viz.cli import main
from skyline_viz.command_line.inputs import collect
from skyline_viz.commands.gallery import build
from skyline_viz.method import Learner, MethodError, UnnamedClassError
from skyline_viz.methods.finding import plugins
from skyline_viz.methods.finding.method_files import method_digest, save_method
from skyline_viz.methods.finding.plugins import as_method
from skyline_viz.rendering import render
from skyline_viz.viewer import entities
from testing import ROOT
from testing.labelling import workbench, write_hills
from testing.methods import own_folder, write_module
from testing.recordings import Read, verify

SCENE = render("clear", 3, 80, 60)

LEARNS = """
import numpy as np

class Share:
    name = "share"

    def __init__(self, model=None, lower: int = 0):
        self.model, self.lower = dict(model or {}), lower

    def fit(self, items, seed=0):
        shares = [item.truth().rows.mean() / len(item.photo()) for item in items]
        return Share({"share": np.array([np.mean(shares)])}, self.lower)

    def detect(self, photo):
        rows = self.model["share"][0] * len(photo) + self.lower
        return np.full(photo.shape[1], rows)
"""


@pytest.fixture
def here(tmp_path, monkeypatch):
    with own_folder(tmp_path, monkeypatch) as folder:
        yield folder


@pytest.fixture
def drop(here):
    """The example of the docs, as it stands."""
    page = (ROOT / "docs" / "extend.md").read_text()
    code = re.search(r"```python\n(.*?)```", page, re.DOTALL)
    (here / "drop.py").write_text(code[1])
    return here


@pytest.fixture
def hills(here):
    for number in range(4):
        scene = render("desert", 50 + number, 80, 60)
        sv.write_photo(here / "hills" / "images" / f"h{number}.png", scene.photo)
        scene.truth.write_csv(here / "hills" / "masks" / f"h{number}.csv")
    return here / "hills"


def test_rows_become_a_detection_of_the_line(drop):
    method = sv.find_method("drop:Drop")
    found = method.detect(SCENE.photo)
    grey = sys.modules["drop"].Drop().detect(SCENE.photo)
    np.testing.assert_array_equal(found.skyline.rows, grey)
    assert (found.method, method.name) == ("drop", "drop")
    assert found.path_cost == 0
    assert found.total_seconds > 0
    np.testing.assert_array_equal(found.cost[found.skyline.rows.astype(int), range(80)], 0)


def test_settings_are_the_parameters_of_the_class(drop):
    method = sv.find_method("drop:Drop:blur=6")
    assert method.inner.blur == 6.0
    assert method.name == "drop:blur=6"
    assert sv.find_method("smooth=drop:Drop:blur=6").name == "smooth"
    with pytest.raises(MethodError, match=r"drop:Drop has no setting blurr; did you mean blur\?"):
        sv.find_method("drop:Drop:blurr=6")
    with pytest.raises(MethodError, match="blur is a number from -inf to inf, not 'x'"):
        sv.find_method("drop:Drop:blur=x")


def test_it_is_evaluated_also_in_other_processes(drop, hills, capsys):
    words = ["evaluate", "hills", "--workers", "2", "--out", "out"]
    assert main([*words, "--method", "default", "drop:Drop", "smooth=drop:Drop:blur=6"]) == 0
    said = capsys.readouterr().out
    assert re.search(r"^drop +\d", said, re.MULTILINE)
    assert re.search(r"^smooth +\d", said, re.MULTILINE)


def test_it_is_diagnosed(drop, hills, capsys):
    assert main(["diagnose", "hills", "--method", "drop:Drop", "--out", "out"]) == 0
    assert "hills: 4 photos" in capsys.readouterr().out
    assert (drop / "out" / "diagnosis.json").exists()


def test_it_is_in_the_tables(drop, hills, capsys):
    words = ["tables", "hills", "--method", "default", "drop:Drop", "--no-studies", "--out", "t"]
    assert main(words) == 0
    assert re.search(r"│ drop +│|^ *drop ", capsys.readouterr().out, re.MULTILINE)


@pytest.mark.parametrize("methods", [["drop:Drop"], ["default", "drop:Drop:blur=6"]])
def test_it_is_inspected(drop, hills, methods):
    photo = "hills/images/h0.png"
    words = ["inspect", photo, "--truth", "hills/masks/h0.csv", "--save", "a.rrd"]
    assert main([*words, "--method", *methods]) == 0
    verify(drop / "a.rrd")
    read = Read(drop / "a.rrd")
    line = entities.PATH if len(methods) == 1 else entities.ALTERNATIVE
    (strip,) = read.last(line, "strips").as_py()
    wanted = sv.find_method(methods[-1]).detect(sv.read_photo(photo)).skyline.rows
    np.testing.assert_array_equal(np.array(strip)[:, 1], wanted)


def test_methods_with_settings_have_a_tab_each(drop, hills):
    words = ["inspect", "hills/images/h0.png", "--save", "a.rrd", "--method"]
    assert main([*words, "default", "default:delta=8,v=0.9", "drop:Drop", "b, c=paper"]) == 0
    verify(drop / "a.rrd")
    read = Read(drop / "a.rrd")
    for name in ("default:v=0.9,delta=8", "drop", "b, c"):
        assert name in read.view_names
        assert f"{entities.stages_of(name)}/{entities.COST}" in {
            one.replace("/methods", "methods", 1) for one in read.entities()
        }


def test_it_is_in_a_gallery(drop, hills):
    inputs = collect([hills])
    entries, failures = build(drop / "g", inputs, sv.find_method("drop:Drop"), 1)
    assert not failures
    assert {entry.method for entry in entries} == {"drop"}
    assert not any("bin" in {stage.name for stage in entry.stages} for entry in entries)


def test_it_proposes_for_labels_and_is_kept(drop):
    folder = write_hills(drop / "photos", count=1)
    method = sv.find_method("drop:Drop:blur=3")
    bench = workbench(folder, detector=method)
    (photo,) = bench.photos
    session = bench.session(photo)
    wanted = method.detect(session.pixels).skyline.rows
    np.testing.assert_array_equal(session.wire.skyline.rows, wanted.astype(int))
    for name in ("edges", "score", "cost"):
        assert overlay(bench.detection(bench.session(photo)), name).data[1:4] == b"PNG"
    kept = bench.store.detector(bench.label(photo))
    assert (kept.name, kept.inner.blur) == ("drop:blur=3", 3.0)
    bench.close()
    wire = LiveWire(SCENE.photo, method)
    assert wire.anchor(30, 20).rows[30] == 20


def test_one_that_learns_is_cross_validated_trained_and_used(here, hills, capsys, monkeypatch):
    (here / "shares.py").write_text(LEARNS)
    assert main(["evaluate", "hills", "--folds", "2", "--method", "shares:Share", "default"]) == 0
    assert re.search(r"^share +\d", capsys.readouterr().out, re.MULTILINE)
    words = ["train", "hills", "--method", "shares:Share:lower=2", "--out", "m.npz"]
    assert main(words) == 0
    with np.load("m.npz") as file:
        share = file["share"][0]
    found = sv.find_method("shares:Share:model=m.npz").detect(SCENE.photo)
    assert found.skyline.rows[0] == pytest.approx(60 * share)
    again = sv.find_method("m.npz")
    assert isinstance(again, Learner)
    assert again.detect(SCENE.photo).skyline.rows[0] == pytest.approx(60 * share + 2)
    assert pickle.loads(pickle.dumps(again)).name == again.name
    monkeypatch.setattr(plugins, "_named", set())
    with pytest.raises(UnnamedClassError, match=r"no file decides what is run.*model=m\.npz"):
        sv.find_method("m.npz")


def test_a_file_makes_nothing_be_imported(here):
    (here / "shares.py").write_text(LEARNS)
    save_method(sv.find_method("shares:Share"), here / "m.npz")
    (here / "shares.py").write_text("open('imported', 'w')")
    code = "import skyline_viz as sv; sv.find_method('m.npz')"
    done = subprocess.run([sys.executable, "-c", code], check=False, capture_output=True, text=True)
    assert "UnnamedClassError" in done.stderr
    assert not (here / "imported").exists()


@pytest.mark.parametrize(
    ("body", "says"),
    [
        ("return None", "mine:Mine found no skyline"),
        ("return [1, 2, 3]", "mine:Mine found 3 rows in a photo of 80 columns"),
        ("return [float('nan')] * 80", "mine:Mine found no skyline"),
        ("return [[1] * 80]", "mine:Mine found no skyline"),
        ("return photo[0, 0, 9]", "mine:Mine failed in mine.py, line 3: IndexError"),
    ],
)
def test_what_is_no_skyline_is_one_sentence(here, body, says):
    place = write_module(here, f"class Mine:\n    def detect(self, photo):\n        {body}\n")
    with pytest.raises(MethodError, match=says):
        sv.find_method(place).detect(SCENE.photo)


def test_other_code_finds_other_lines(drop):
    first = method_digest(sv.find_method("drop:Drop"))
    assert method_digest(sv.find_method("drop:Drop:blur=6")) != first
    file = drop / "drop.py"
    file.write_text(file.read_text() + "# changed\n")
    assert method_digest(sv.find_method("drop:Drop")) != first


def test_an_object_is_a_method_as_it_is():
    class Level:
        name = "level"

        def detect(self, photo):
            return sv.Skyline(np.full(photo.shape[1], 7.0))

    method = as_method(Level())
    assert (method.name, method.detect(SCENE.photo).skyline.rows[0]) == ("level", 7)
    assert as_method(method) is method
    assert json.dumps(method.settings()) == "{}"
