"""What has seen a photo in training, and what is said of it."""

from dataclasses import replace

import pytest

import skyline_viz as sv
from skyline_viz.datasets.item import LoadedItem
from skyline_viz.detector import Detector
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.evaluation.seen import in_titles, notes, seen_by, seen_in_training
from skyline_viz.methods.finding.method_files import Trained, load_method, save_method
from skyline_viz.methods.registry import make_method
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline
from skyline_viz.system.fingerprints import fingerprint


@pytest.fixture(scope="module")
def trained():
    scene = render("desert", 1, 160, 120)
    items = [LoadedItem("clip1-1", scene.photo, scene.truth)]
    items.append(LoadedItem("other", *vars_of(render("snow", 2, 160, 120))))
    return Detector().fit(items)


def vars_of(scene):
    return scene.photo, scene.truth


def test_what_a_detector_has_seen_is_known_again(trained, tmp_path):
    photo = render("desert", 1, 160, 120).photo
    other = render("spires", 3, 160, 120).photo
    trained.save(tmp_path / "d.npz")
    for one in (trained, Detector.load(tmp_path / "d.npz")):
        assert seen_in_training(one, photo, "x") == "training: exact"
        assert seen_in_training(one, photo[::2, ::2], "x") == "training: near"
        assert seen_in_training(one, other, "clip1-2") == "training: clip"
        assert seen_in_training(one, other, "x") == ""
    assert "seen this photo in training" in " ".join(trained.detect(photo).about())
    assert "seen" not in " ".join(trained.detect(other).about())


def test_a_sky_model_counts_where_it_is_asked():
    photo = render("clear", 5, 160, 120).photo
    detector = Detector()
    vars(detector.sky)["seen"] = (*detector.sky.seen, fingerprint(photo))
    try:
        assert seen_in_training(detector, photo) == "sky model: exact"
        off = detector.with_settings({"sky_weight": 0.0})
        assert seen_in_training(off, photo) == ""
    finally:
        vars(detector.sky).pop("seen")


def test_other_methods_keep_what_they_have_seen(tmp_path):
    photo = render("clear", 5, 160, 120).photo
    kept = Trained("hills", 1, 0, (fingerprint(photo),))
    save_method(make_method("edges"), tmp_path / "e.npz", kept)
    known = load_method(tmp_path / "e.npz")
    assert seen_in_training(known, photo) == "training: exact"
    assert seen_in_training(make_method("edges"), photo) == ""
    save_method(known, tmp_path / "again.npz")
    assert seen_in_training(load_method(tmp_path / "again.npz"), photo) == "training: exact"


def test_what_is_shipped_knows_its_photographs():
    detector = Detector()
    assert len(detector.bank.seen) == 386
    assert len(detector.sky.seen) == len(sv.SkyModel.large().seen) == 486


def test_sentences_and_titles_count():
    seen = {"a": "training: exact; sky model: exact", "b": "sky model: near", "c": ""}
    assert seen_by("training", seen) == ["a"]
    first, second = notes("mine", seen)
    assert first.startswith("mine has seen 1 of 3 photos in training")
    assert first.endswith(": a.")
    assert second.startswith("the sky model of mine was trained on 2 of 3 photos")
    assert notes("mine", {"a": ""}) == notes("mine", {}) == []
    assert notes("mine", {"a": "training: near"}, folds=True) == [
        "mine was trained on the photo, so this is no test."
    ]
    result, other = (PhotoResult.of(name, Skyline([1]), Skyline([1]), 9) for name in "ab")
    results = {"m": [replace(result, seen=seen["a"]), other], "n": [result, other]}
    told = "1 of 2 photos seen in training, 1 of 2 photos seen by the sky model"
    assert in_titles(results) == told
    assert in_titles({}) == in_titles({"n": [result]}) == ""
