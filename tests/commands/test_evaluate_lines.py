"""``skyline-viz evaluate --predictions`` and groups of photos that stay together."""

import csv
import json
import shutil

import numpy as np

import skyline_viz as sv
from annotate.formats import export_labels
from testing.exports import label
from testing.programs.commands import files


def errors(folder):
    with (folder / "photos.csv").open(newline="") as file:
        return {(line["method"], line["name"]): line["a_err"] for line in csv.DictReader(file)}


def test_our_own_masks_have_the_errors_of_the_run_that_made_them(say, hills, tmp_path):
    assert say("evaluate", hills, "--out", "run")[0] == 0
    assert say("detect", hills, "--mask", "--json", "--out", "found")[0] == 0
    for ending in (".csv", ".json", "-mask.png"):
        kind = tmp_path / ending.strip(".-")
        kind.mkdir()
        for file in (tmp_path / "found").glob(f"*{ending}"):
            file.rename(kind / file.name)
        status, out, err = say("evaluate", hills, "--predictions", kind, "--out", "again")
        assert (status, err) == (0, "")
        assert f"4 photos, lines of {kind}" in out
        assert "Worst photos" in out
        assert "time of a detection" not in out
        again = errors(tmp_path / "again")
        ours = errors(tmp_path / "run")
        assert again == {(kind.name, name): error for (_, name), error in ours.items()}


def test_exports_of_the_annotator_have_the_errors_of_the_run_that_made_them(say, hills, tmp_path):
    assert say("evaluate", hills, "--out", "run")[0] == 0
    assert say("detect", hills, "--out", "found")[0] == 0
    photos = tmp_path / "photos"
    shutil.copytree(hills / "images", photos)
    labels = [
        label(photos, file.name, line.rows, width=line.width, height=len(sv.read_photo(file)))
        for file in sorted(photos.iterdir())
        for line in [sv.Skyline.read_csv(tmp_path / "found" / f"{file.stem}.csv")]
    ]
    ours = errors(tmp_path / "run")
    for kind in ("coco", "json", "csv", "mask"):
        export_labels(labels, photos, tmp_path / kind, kind)
        status, _, err = say("evaluate", hills, "--predictions", kind, "--out", "again")
        assert (status, err) == (0, ""), kind
        again = errors(tmp_path / "again")
        assert again == {(kind, name): error for (_, name), error in ours.items()}
    (tmp_path / "coco" / "annotations-rle.json").unlink()
    assert say("evaluate", hills, "--predictions", "coco", "--out", "again")[0] == 0
    assert [*errors(tmp_path / "again").values()] == [*ours.values()]


def test_missing_and_extra_lines_are_counted_and_named(say, hills, tmp_path):
    assert say("detect", hills, "--out", "found")[0] == 0
    (tmp_path / "found" / "p1.csv").unlink()
    (tmp_path / "found" / "p2.csv").rename(tmp_path / "found" / "other.csv")
    status, out, err = say("evaluate", hills, "--predictions", "found", "--out", "run")
    assert status == 1
    assert "2 photos" in out
    assert "found: 1 file belongs to no photo: other.csv.\n" in err
    assert err.endswith("2 of 4 photos have no line in found: p1, p2.\n")
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["predictions"]["found"]["belong_to_no_photo"] == ["other.csv"]
    assert [one["name"] for one in summary["failed"]] == ["p1", "p2"]


def test_runs_are_compared_photo_by_photo(say, hills, tmp_path):
    assert say("detect", hills, "--out", "found")[0] == 0
    first = tmp_path / "found" / "p0.csv"
    line = sv.Skyline.read_csv(first)
    sv.Skyline(np.maximum(line.rows - 9, 0)).write_csv(first)
    status, out, _ = say(
        "evaluate", hills, "--predictions", "mine=found", "--method", "default", "--out", "run"
    )
    assert status == 0
    assert "default less mine: " in out
    assert "better on 1 of 4 photos, worse on 0, alike within 0.5 px on 3." in out
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    (compared,) = summary["compared"]
    assert (compared["method"], compared["other"], compared["won"]) == ("default", "mine", ["p0"])
    assert compared["interval"][0] <= compared["difference"] <= compared["interval"][1]
    with np.load(tmp_path / "run" / "column_errors.npz") as kept:
        assert (
            kept["mine/p0"] - kept["default/p0"] == np.maximum(line.rows - 9, 0) - line.rows
        ).all()
    assert "curves.csv" in files(tmp_path / "run")


def test_names_of_folders_must_differ_and_reports_need_stages(say, hills):
    assert say("detect", hills, "--out", "found")[0] == 0
    status, _, err = say("evaluate", hills, "--predictions", "found", "found")
    assert status == 2
    assert "two folders of lines are called found; give one a label: other=found." in err
    status, _, err = say("evaluate", hills, "--predictions", "found", "--report", "r.html")
    assert status == 2
    assert "name a --method" in err


def test_groups_stay_together_and_a_split_comes_back(say, hills, tmp_path):
    status, out, _ = say(
        "evaluate", hills, "--folds", "2", "--group", "p[01]|p[23]", "--out", "run"
    )
    assert status == 0
    assert "2-fold cross-validation of 4 groups" in out
    say("evaluate", hills, "--folds", "2", "--group", "p([02])?", "--out", "run")
    split = (tmp_path / "run" / "folds.csv").read_text()
    assert split.startswith("name,fold\np0,")
    status, out, _ = say("evaluate", hills, "--split", "run/folds.csv", "--out", "again")
    assert status == 0
    assert "2-fold cross-validation" in out
    assert (tmp_path / "again" / "folds.csv").read_text() == split
    assert errors(tmp_path / "again") == errors(tmp_path / "run")
    assert say("diagnose", hills, "--split", "run/folds.csv", "--no-remedies")[0] == 0


def test_groups_and_splits_of_no_use_are_refused(say, hills, tmp_path):
    for words, said in (
        (("--folds", "2", "--group", "("), "( is no pattern for names"),
        (("--folds", "2", "--group", "zebra"), "zebra is in no name of a photo"),
        (("--folds", "2", "--group", "folder"), "from 2 to the 1 groups of the 4 photos, not 2"),
        (("--folds", "2", "--split", "a.csv"), "leave out --folds and --group"),
        (("--split", "gone.csv"), "gone.csv cannot be read"),
    ):
        status, _, err = say("evaluate", hills, *words)
        assert (status, said in err) == (2, True), err


def test_photos_seen_in_training_are_known_under_any_name(say, hills, tmp_path):
    assert say("train", hills, "--out", "b.npz")[0] == 0
    (tmp_path / "elsewhere").symlink_to(hills)
    status, _, err = say("evaluate", "elsewhere", "--bank", "b.npz", "--out", "run")
    assert (status, "b.npz was trained on all 4 photos, so this is no test" in err) == (0, True)
    with (tmp_path / "run" / "photos.csv").open(newline="") as file:
        assert [line["seen"] for line in csv.DictReader(file)] == ["training: exact"] * 4
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert {*summary["seen_in_training"]["b.npz"]} == {"p0", "p1", "p2", "p3"}
    assert summary["notes"] == [
        "b.npz was trained on all 4 photos, so this is no test; see --folds."
    ]
    for words in (
        ("diagnose", "elsewhere", "--no-remedies"),
        ("inspect", hills / "images" / "p0.png", "--truth", hills / "masks" / "p0.csv"),
        ("inspect", "elsewhere", "--report", "r.html"),
    ):
        headless = ("--headless",) if "--truth" in words else ()
        _, _, err = say(*words, "--bank", "b.npz", *headless)
        assert "so this is no test" in err, words
    assert "no test: seen in training" in (tmp_path / "r.html").read_text()


def test_a_folder_of_the_same_name_is_no_training(say, hills, tmp_path):
    (tmp_path / "mountains").symlink_to(hills)
    status, _, err = say("evaluate", "mountains")
    assert (status, err) == (0, "")
