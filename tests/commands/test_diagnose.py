"""``skyline-viz diagnose``: what it says and writes."""

import csv
import json
import re

import pytest

import skyline_viz as sv
from skyline_viz.cli import main
from skyline_viz.diagnosis.causes import CAUSES
from testing import SAMPLES, detections
from testing.detections import flat_truth, write_dataset


@pytest.fixture(scope="module")
def hazy():
    return detections.hazy()


@pytest.fixture(scope="module")
def flat():
    return detections.flat()


def test_where_all_is_right_nothing_has_to_help(flat, tmp_path, capsys):
    write_dataset(tmp_path, flat, flat_truth([], 0))
    assert main(["diagnose", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert out.endswith("All are right: no column is off by more than the tolerance.\n")


def test_where_nothing_helps_it_is_said(flat, tmp_path, capsys):
    write_dataset(tmp_path, flat, flat_truth(slice(100, 200), 30))
    assert main(["diagnose", str(tmp_path)]) == 0
    assert "None of these helps" in capsys.readouterr().out


def test_the_command_tells_causes_and_remedies(tmp_path, capsys):
    words = ["diagnose", str(SAMPLES), "--out", str(tmp_path), "--workers", "2"]
    assert main(words) == 0
    out = capsys.readouterr().out
    assert "sample_data: 12 photos" in out
    assert "share of their error" in out
    assert "What would help, tried on all photos" in out
    assert re.search(r"\n[a-z].+ \(--config\.\S+ \S+\) +-\d+\.\d\d px", out)
    with (tmp_path / "segments.csv").open() as file:
        segments = list(csv.DictReader(file))
    assert {one["cause"] for one in segments} <= set(CAUSES)
    document = json.loads((tmp_path / "diagnosis.json").read_text())
    told = {photo["name"]: photo for photo in document["photos"]}
    assert len(told) == 12
    assert sum(len(photo["segments"]) for photo in told.values()) == len(segments)
    first, last = told["hazy-2"]["segments"][0]["columns"]
    assert 0 <= first < last <= 959
    assert len(told["hazy-1"]["remedies"]) > 25
    assert sv.read_photo(tmp_path / "causes.png").shape[1] == 1440
    assert {name for one in document["causes"] for name in one["names"]} <= {*told}
    assert document["causes"][0]["a_err"] >= document["causes"][-1]["a_err"]


def test_one_photo_leaves_the_report_of_the_data_set(tmp_path, capsys):
    (tmp_path / "diagnosis.json").write_text("all")
    assert main(["diagnose", str(SAMPLES), "--photo", "hazy-1", "--out", str(tmp_path)]) == 0
    assert f"hazy-1.json and hazy-1.md in {tmp_path}" in capsys.readouterr().out
    assert (tmp_path / "diagnosis.json").read_text() == "all"
    assert not (tmp_path / "segments.csv").exists()
    document = json.loads((tmp_path / "hazy-1.json").read_text())
    assert [photo["name"] for photo in document["photos"]] == ["hazy-1"]
    assert (tmp_path / "hazy-1.md").read_text().startswith("**hazy-1**")


def test_the_command_tells_one_photo_in_full(capsys):
    assert main(["diagnose", str(SAMPLES), "--photo", "hazy-1", "--config.sky-weight", "0"]) == 0
    out = capsys.readouterr().out
    assert re.match(r"hazy-1  A_err 1\d\d\.\d\d px", out)
    assert "the truth costs more than the path by: score" in out
    assert "edges found anew with a quarter of the Canny thresholds" in out
    assert re.search(r"What would help most\nsetting .* A_err .* repairs .* breaks\n", out)
    assert re.search(r"For the best: add --\S+", out)
    assert main(["diagnose", str(SAMPLES), "--photo", "nobody"]) == 2
    assert "has no photo nobody" in capsys.readouterr().err
    assert main(["diagnose", str(SAMPLES), "--tolerance", "-1"]) == 2
    assert main(["diagnose", str(SAMPLES), "--folds", "2", "--bank", "x.npz"]) == 2


def test_a_report_has_all_photos_causes_and_remedies(flat, tmp_path, capsys):
    write_dataset(tmp_path / "set", flat, flat_truth(slice(100, 200), 30))
    file = tmp_path / "r.html"
    assert main(["diagnose", str(tmp_path / "set"), "--report", str(file)]) == 0
    assert f"{file}: 1 photo, " in capsys.readouterr().out
    text = file.read_text(encoding="utf-8")
    assert "columns 100 to 199" in text
    assert main(["diagnose", str(tmp_path / "set"), "--report", str(tmp_path / "r.pdf")]) == 2
