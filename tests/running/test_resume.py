"""Runs that are interrupted go on: nothing is done twice, and the results are the same."""

import csv
import re
import shutil
import signal
import subprocess
import sys

import pytest

import skyline_viz as sv
from skyline_viz import detector
from skyline_viz.cli import main
from skyline_viz.evaluation.tasks import PhotoTask
from skyline_viz.running.batch import Failure
from skyline_viz.running.resume import FOLDER, Codec, Kept
from testing import until
from testing.programs.ends import started, write_set

PHOTOS = 6
COMMANDS = {
    "evaluate": "evaluate",
    "cross-validated": "evaluate --folds 2",
    "methods": "evaluate --method default edges --folds 2",
    "diagnose": "diagnose",
    "tables": "tables --method paper edges --no-studies",
}


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    return write_set(tmp_path_factory.mktemp("data") / "hills", PHOTOS, size=(160, 120))


class Stops:
    """Lets so many detections be made, and is interrupted by the next one."""

    def __init__(self, monkeypatch, after):
        self.made, self.after, plain = 0, after, detector.Detector.detect

        def detect(detector, photo):
            if len(photo) > 32:  # of a photo, not to load what is compiled
                if self.made == self.after:
                    raise KeyboardInterrupt
                self.made += 1
            return plain(detector, photo)

        monkeypatch.setattr(detector.Detector, "detect", detect)


def written(out):
    """What a run has written, without what is never the same twice: times."""
    found = {}
    for path in sorted(path for path in out.rglob("*") if path.is_file()):
        text = path.read_bytes()
        if path.name == "photos.csv":
            rows = list(csv.DictReader(path.read_text().splitlines()))
            text = [{key: row[key] for key in row if key != "seconds"} for row in rows]
        elif path.name == "summary.json":
            text = re.sub(r'"seconds": [\d.]+', "", path.read_text())
        elif path.name == "tables.md":
            text = path.read_text().split("Table VI")[0]
        elif path.name == "tables.tex":
            continue  # the same again
        found[str(path.relative_to(out))] = text
    return found


@pytest.mark.parametrize("name", COMMANDS)
def test_the_next_run_goes_on_and_comes_to_the_same(name, data, tmp_path, monkeypatch, capsys):
    command, *more = COMMANDS[name].split()
    words = [command, str(data), *more, "--workers", "1", "--out"]
    assert main([*words, str(tmp_path / "whole")]) == 0
    with monkeypatch.context() as patched:
        Stops(patched, after=4)
        assert main([*words, str(tmp_path / "out")]) == 130
    assert list((tmp_path / "out" / FOLDER).glob("*/*.json"))
    capsys.readouterr()
    with monkeypatch.context() as patched:
        counted = Stops(patched, after=10**6)
        assert main([*words, str(tmp_path / "out")]) == 0
    assert re.search(
        r"\b\d+ of \d+ (photos?|detections?) (was|were) done already", capsys.readouterr().err
    )
    if name in ("evaluate", "cross-validated"):
        assert counted.made == PHOTOS - 4
    assert written(tmp_path / "out") == written(tmp_path / "whole")
    assert not (tmp_path / "out" / FOLDER).exists()


def interrupted(data, out, monkeypatch):
    with monkeypatch.context() as patched:
        Stops(patched, after=4)
        assert main(["evaluate", str(data), "--workers", "1", "--out", str(out)]) == 130
    return sorted((out / FOLDER / "evaluate").iterdir())


def truncated(file, _):
    file.write_bytes(file.read_bytes()[:-9])


def altered(file, _):
    file.write_text(file.read_text().replace('"a_err": ', '"a_err": 1'))


def of_another_shape(file, _):
    shutil.copy(file, file.with_suffix(".old"))
    Kept(file.parent).keep(file.stem, {"name": "x"})
    file.with_suffix(".old").unlink()


def empty(file, _):
    file.write_bytes(b"")


def no_text(file, _):
    file.write_bytes(b"\xff" * 99)


def another_truth(_, data):
    mask = data / "masks" / "hill-001.png"
    mask.write_bytes((data / "masks" / "hill-000.png").read_bytes() + b"\0")


def another_photo(_, data):
    photo = data / "images" / "hill-001.png"
    photo.write_bytes((data / "images" / "hill-005.png").read_bytes())


@pytest.mark.parametrize(
    "harm", [truncated, altered, of_another_shape, empty, no_text, another_truth, another_photo]
)
def test_what_is_damaged_or_has_changed_is_done_again(harm, data, tmp_path, monkeypatch, capsys):
    mine = shutil.copytree(data, tmp_path / "hills")
    kept = interrupted(mine, tmp_path / "out", monkeypatch)
    harm(kept[1], mine)
    for out in ("out", "whole"):
        assert main(["evaluate", str(mine), "--workers", "1", "--out", str(tmp_path / out)]) == 0
        assert ("3 of 6 photos were done already" in capsys.readouterr().err) == (out == "out")
    assert written(tmp_path / "out") == written(tmp_path / "whole")


def test_other_settings_are_another_run(data, tmp_path, monkeypatch, capsys):
    interrupted(data, tmp_path, monkeypatch)
    words = ["evaluate", str(data), "--workers", "1", "--out", str(tmp_path)]
    assert main([*words, "--config.delta", "2"]) == 0
    assert "done already" not in capsys.readouterr().err


def test_what_others_keep_there_stays(data, tmp_path, monkeypatch):
    out = tmp_path / "out"
    records = interrupted(data, out, monkeypatch)
    (out / FOLDER / "notes.txt").write_text("mine")
    (out / FOLDER / "evaluate" / "notes.json").write_text("mine")
    assert main(["diagnose", str(data), "--out", str(out)]) == 0
    assert sorted((out / FOLDER / "evaluate").glob("*.json"))[: len(records)] == records
    assert main(["evaluate", str(data), "--out", str(out)]) == 0
    assert sorted(one.name for one in (out / FOLDER).rglob("*.*")) == ["notes.json", "notes.txt"]


def test_without_a_folder_nothing_is_kept(data, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["evaluate", str(data)]) == 0
    assert list(tmp_path.iterdir()) == []


def test_photos_that_fail_fail_again_and_the_run_is_whole(data, tmp_path, capsys):
    mine = shutil.copytree(data, tmp_path / "hills")
    (mine / "images" / "hill-002.png").write_bytes(b"no photo")
    for _ in range(2):
        assert main(["evaluate", str(mine), "--out", str(tmp_path / "out")]) == 1
        assert "hill-002" in capsys.readouterr().err
    assert not (tmp_path / "out" / FOLDER).exists()


def test_a_photo_that_cannot_be_found_is_a_failure_with_its_own_words(tmp_path):
    codec = Codec(dict, dict)
    item = sv.DatasetItem("gone", tmp_path / "gone.png")
    photo_task = PhotoTask(item, sv.Detector(), "digest")

    def key(task):
        return str(task.item.photo_path.read_bytes())

    (outcome,) = Kept(tmp_path / FOLDER).run(_photo_of, [photo_task], key, codec)
    assert isinstance(outcome, Failure)
    assert "gone.png cannot be read" in str(outcome)


def _photo_of(task):
    return {"rows": len(task.item.photo())}


@pytest.mark.parametrize("ending", [signal.SIGKILL, signal.SIGTERM])
def test_after_a_kill_the_next_run_goes_on(ending, tmp_path):
    data = write_set(tmp_path / "hills", photos=60, size=(320, 240))
    words = ["skyline_viz", "evaluate", str(data), "--workers", "2", "--out"]
    process = started([*words, str(tmp_path / "out")], tmp_path)
    folder = tmp_path / "out" / FOLDER / "evaluate"
    until(lambda: len(list(folder.glob("*.json"))) >= 5, process)
    process.send_signal(ending)
    process.communicate(timeout=60)
    kept = len(list(folder.glob("[!.]*.json")))
    again, whole = (
        subprocess.run(
            [sys.executable, "-m", *words, tmp_path / out],
            capture_output=True,
            text=True,
            check=True,
        )
        for out in ("out", "whole")
    )
    assert again.stderr == f"skyline-viz: {kept} of 60 photos were done already.\n"
    assert whole.stderr == ""
    assert written(tmp_path / "out") == written(tmp_path / "whole")
