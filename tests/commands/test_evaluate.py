"""``skyline-viz evaluate``: what it prints and writes."""

import csv
import json

import numpy as np
import pytest

import skyline_viz as sv
from testing.commands import files, write_scenes


def test_evaluate_prints_and_writes(say, hills, tmp_path):
    status, out, err = say("evaluate", hills, "--out", "report")
    assert (status, err) == (0, "")
    assert files(tmp_path / "report") == ["histogram.png", "photos.csv", "summary.json"]
    summary = json.loads((tmp_path / "report" / "summary.json").read_text())
    assert (summary["dataset"], summary["layout"]) == ("hills", "plain")
    assert summary["summary"]["photos"] == 4
    assert summary["config"]["delta"] == sv.DetectorConfig().delta
    with (tmp_path / "report" / "photos.csv").open(newline="") as file:
        lines = list(csv.DictReader(file))
    assert [line["name"] for line in lines] == ["p0", "p1", "p2", "p3"]
    mean = np.mean([float(line["a_err"]) for line in lines])
    assert summary["summary"]["mean"] == pytest.approx(mean, abs=1e-4)
    assert f"{mean:.2f} px" in out
    assert "p3" in out


def test_a_cross_validation_says_so(say, hills, tmp_path):
    status, out, err = say("evaluate", hills, "--folds", "2", "--seed", "4", "--out", "report")
    assert (status, err) == (0, "")
    assert "2-fold cross-validation" in out
    summary = json.loads((tmp_path / "report" / "summary.json").read_text())
    assert (summary["folds"], summary["seed"], summary["failed"]) == (2, 4, [])


def test_testing_on_the_training_photos_is_noticed(say, hills):
    assert say("train", hills, "--out", "b.npz")[0] == 0
    status, _, err = say("evaluate", hills, "--bank", "b.npz")
    assert status == 0
    assert err == "skyline-viz: the bank was trained on hills, so this is no test; see --folds.\n"


def test_an_evaluation_lists_failures(say, tmp_path):
    root = tmp_path / "some"
    write_scenes(root, 2)
    (root / "images" / "p0.png").write_bytes(b"no photo")
    status, _, err = say("evaluate", root, "--out", "report")
    assert status == 1
    assert "p0.png" in err
    summary = json.loads((tmp_path / "report" / "summary.json").read_text())
    assert [failed["name"] for failed in summary["failed"]] == ["p0"]


def test_a_report_is_not_written_among_the_photos(say, hills):
    before = files(hills)
    assert say("evaluate", hills, "--out", hills / "images")[0] == 2
    assert files(hills) == before
