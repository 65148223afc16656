"""``skyline-viz train --learn-sky``: the network that it writes, and what it refuses."""

import numpy as np
import pytest

from skyline_viz.sky_model import SkyModel
from skyline_viz.skyline import Skyline
from testing.deep import needs_deep
from testing.programs.commands import scene, write_scene, write_scenes

SHORT = ("--learn-sky", "small", "--steps", "2", "--out", "sky.onnx")


@needs_deep
def test_a_sky_model_is_written_and_runs(say, hills, tmp_path):
    status, out, err = say("train", hills, *SHORT)
    assert (status, err) == (0, "")
    assert "4 of 4" in out
    assert SkyModel.load(tmp_path / "sky.onnx").name == "sky.onnx"


@needs_deep
def test_a_teacher_labels_photos_without_a_truth(say, hills, tmp_path):
    assert say("train", hills, *SHORT)[0] == 0
    write_scene(tmp_path / "bare" / "p0.png", 0)
    taught = ("--learn-sky", "small", "--steps", "1", "--out", "b.onnx", "--teacher", "sky.onnx")
    status, out, _ = say("train", hills, "bare", *taught)
    assert status == 0
    assert "5 of 5" in out


@needs_deep
def test_photos_whose_truth_shows_no_line_are_counted_apart(say, tmp_path):
    write_scenes(tmp_path / "some", 2)
    file = tmp_path / "some" / "masks" / "p0"
    truth = next(file.parent.glob("p0.*"))
    truth.unlink()
    width = scene(0)[1].width
    hidden = Skyline(np.zeros(width, np.float32), np.zeros(width, bool))
    hidden.write_csv(file.with_suffix(".csv"))
    status, out, _ = say("train", "some", *SHORT)
    assert status == 0
    assert "1 of 2" in out
    assert "left out     1 photo whose truth shows no line" in out


@needs_deep
def test_training_goes_on_past_a_bad_photo(say, tmp_path):
    write_scenes(tmp_path / "some", 2)
    (tmp_path / "some" / "images" / "p0.png").write_bytes(b"no photo")
    status, out, err = say("train", "some", *SHORT)
    assert status == 1
    assert "1 of 2" in out
    assert "p0.png" in err


@needs_deep
def test_a_cluster_reads_the_photos_and_the_model_is_the_same(say, hills, tmp_path):
    assert say("train", hills, *SHORT)[0] == 0
    status, out, err = say("train", hills, *SHORT[:-1], "there.onnx", "--cluster", "local:1")
    assert (status, err.count("\n")) == (0, 1)  # which tells where it is watched
    assert "4 of 4" in out
    assert (tmp_path / "there.onnx").read_bytes() == (tmp_path / "sky.onnx").read_bytes()


@needs_deep
def test_photos_that_cannot_all_be_drawn_are_counted(say, hills, monkeypatch):
    monkeypatch.setattr("skyline_viz.sky_training.choosing.BATCH", 1)
    status, out, _ = say("train", hills, *SHORT)
    assert status == 0
    assert "photos used  2 of 4" in out
    assert "not read     2 photos: 2 steps see 2 at the most" in out


@pytest.mark.parametrize(
    ("options", "why"),
    [
        (("--teacher", "t.onnx"), "--learn-sky"),
        (("--steps", "7"), "--learn-sky"),
        (("--learn-sky", "small", "--steps", "0"), "1 batch"),
        (("--learn-sky", "small", "--method", "paper"), "--method"),
        (("--learn-sky", "small", "--teacher", "missing.onnx"), "missing.onnx"),
    ],
    ids=["teacher alone", "steps alone", "no steps", "a method", "no teacher there"],
)
def test_what_does_not_fit_is_refused_in_one_sentence(say, hills, tmp_path, options, why):
    status, out, err = say("train", hills, *options, "--out", "x.onnx")
    assert (status, out) == (2, "")
    assert why in err
    assert len(err.strip().splitlines()) == 1
    assert not (tmp_path / "x.onnx").exists()
