"""``skyline-viz evaluate``: what it prints and writes."""

import csv
import json

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.evaluation import FILES
from skyline_viz.sky_model import SEEN
from skyline_viz.system.fingerprints import fingerprint, packed
from testing.networks import bright_sky
from testing.programs.commands import files, write_scenes


def test_evaluate_prints_and_writes(say, hills, tmp_path):
    status, out, err = say("evaluate", hills, "--out", "report")
    assert (status, err) == (0, "")
    assert files(tmp_path / "report") == sorted(FILES)
    summary = json.loads((tmp_path / "report" / "summary.json").read_text())
    assert (summary["dataset"], summary["layout"]) == ("hills", "plain")
    assert summary["summary"]["default"]["photos"] == 4
    settings = summary["settings"]["default"]
    assert settings["config"]["delta"] == sv.DetectorConfig().delta
    assert settings["bank"]["images"] == sv.FilterBank.default().provenance.images
    with (tmp_path / "report" / "photos.csv").open(newline="") as file:
        lines = list(csv.DictReader(file))
    assert [line["name"] for line in lines] == ["p0", "p1", "p2", "p3"]
    mean = np.mean([float(line["a_err"]) for line in lines])
    assert summary["summary"]["default"]["mean"] == pytest.approx(mean, abs=1e-4)
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
    said = "skyline-viz: b.npz was trained on all 4 photos, so this is no test; see --folds.\n"
    assert err == said
    assert say("evaluate", hills, "--bank", "b.npz", "--method", "edges")[2] == said
    assert say("evaluate", hills, "--method", "edges", "b.npz")[2] == said


def test_a_sky_model_that_saw_the_photos_is_noticed_in_folds_too(say, hills, tmp_path):
    photos = [sv.read_photo(file) for file in (hills / "images").iterdir()]
    notes = {SEEN: packed(map(fingerprint, photos))}
    (tmp_path / "sky.onnx").write_bytes(bright_sky(notes=notes))
    saw = "the sky model of default:sky=sky.onnx was trained on all 4 photos"
    assert saw in say("evaluate", hills, "--sky", "sky.onnx", "--folds", "2")[2]
    assert saw in say("evaluate", hills, "--sky", "sky.onnx")[2]
    assert say("evaluate", hills, "--method", "default:sky_weight=0", "--folds", "2")[2] == ""


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


def test_one_method_is_printed_with_its_worst_photos_and_several_as_a_table(say, hills):
    status, out, _ = say("evaluate", hills, "--method", "edges")
    assert status == 0
    assert out.startswith("hills: 4 photos, edges, as it is\n")
    assert "Worst photos" in out
    status, out, _ = say("evaluate", hills, "--method", "edges", "default")
    assert status == 0
    assert out.startswith("hills: 4 photos, as they are; A_err in px\n")
    assert [line.split()[0] for line in out.splitlines()[1:4]] == ["method", "edges", "default"]
    assert out.splitlines()[4].startswith("edges less default: ")


def test_several_methods_write_the_files_that_one_writes(say, hills, tmp_path):
    words = ["--method", "default", "edges", "--folds", "2", "--out", "report"]
    status, out, _ = say("evaluate", hills, *words)
    assert status == 0
    assert "summary.json, photos.csv, histogram.png, curves.csv, curves.png, column_err" in out
    assert files(tmp_path / "report") == sorted([*FILES, "folds.csv"])
    with (tmp_path / "report" / "photos.csv").open(newline="") as file:
        lines = list(csv.DictReader(file))
    assert [line["method"] for line in lines] == ["default"] * 4 + ["edges"] * 4


def test_a_report_shows_the_first_method_and_tells_the_others(say, hills, tmp_path):
    words = ["--method", "edges", "paper", "--folds", "2", "--report", "r.html"]
    status, out, _ = say("evaluate", hills, *words)
    assert status == 0
    assert "r.html: 4 photos, " in out
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "Photos are shown as edges finds them." in text
    assert text.count("paper: A_err ") == 4


def test_shards_do_the_photos_and_the_last_run_sums_up(say, hills, tmp_path):
    say("evaluate", hills, "--out", "at_once")
    told = [say("evaluate", hills, "--out", "parts", "--shard", f"{one}/3") for one in (1, 2, 3)]
    assert [status for status, _, _ in told] == [0, 0, 0]
    counts = [int(out.split()[0]) for _, out, _ in told if "are kept in" in out]
    assert sum(counts) == 4
    assert not (tmp_path / "parts" / "summary.json").exists()
    status, _, err = say("evaluate", hills, "--out", "parts")
    assert (status, "4 of 4 photos were done already." in err) == (0, True)
    wanted, found = (
        [line.split(",")[:6] for line in (tmp_path / one / "photos.csv").read_text().splitlines()]
        for one in ("at_once", "parts")
    )
    assert wanted == found
    assert not (tmp_path / "parts" / "unfinished").exists()


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ((), "--shard keeps what its photos come to in a folder: name it, --out."),
        (("--out", "o", "--folds", "2"), "--folds is of all photos, and --shard does a part"),
        (("--out", "o", "--report", "r.html"), "--report is of all photos"),
        (("--out", "o", "--predictions", "p"), "--predictions is of all photos"),
        (("--out", "o", "--shard", "3/2"), "--shard is I/N, from 1/N to N/N"),
    ],
)
def test_a_shard_has_no_figures_of_all_photos(say, hills, more, said):
    status, out, err = say("evaluate", hills, "--shard", "1/2", *more)
    assert (status, out) == (2, "")
    assert err.startswith(f"skyline-viz: {said}")
