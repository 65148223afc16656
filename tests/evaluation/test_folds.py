"""Learning for folds: who shares what, and what is kept for the next run."""

from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.evaluation.folds import Folds
from skyline_viz.methods.registry import make_method
from skyline_viz.running.resume import Kept


@pytest.fixture
def counted(monkeypatch):
    """The photos that were looked at for training."""
    looked, plain = [], Detector.gather

    def gather(detector, item, seed=0):
        looked.append(item.name)
        return plain(detector, item, seed)

    monkeypatch.setattr(Detector, "gather", gather)
    return looked


def _dealt(items, count):
    return tuple(place % count for place in range(len(items)))


def learned(items, methods, kept=None, count=2):
    return list(Folds(tuple(items), _dealt(items, count), kept=kept or Kept()).learned(methods))


def test_detectors_that_see_the_same_edges_learn_once_and_keep_their_settings(items, counted):
    steep = Detector(config=DetectorConfig(delta=9))
    grey = Detector(config=DetectorConfig(edge_source="grey"))
    first, second, third = learned(items, [Detector(), steep, grey])
    assert len(counted) == 2 * len(items)
    for one, other, another in zip(first.methods, second.methods, third.methods, strict=True):
        assert one.bank is other.bank
        assert other.config == steep.config
        assert another.bank is not one.bank


def test_a_detector_learns_filters_of_the_size_and_bins_that_it_has(items):
    coarse = sv.Bins(coherences=1, strengths=2, orientations=4)
    bank = sv.FilterBank(np.zeros((8, 5, 5), np.float32), np.zeros(8, np.int64), bins=coarse)
    (found,) = learned(items, [Detector(bank)])
    assert {(one.bank.size, one.bank.bins) for one in found.methods} == {(5, coarse)}
    assert Detector(bank).fit(items).bank.filters.shape == (8, 5, 5)


def test_what_was_learned_by_adding_is_not_learned_again(items, counted, tmp_path):
    bad = sv.DatasetItem("z", tmp_path / "gone.png", items[0].truth_path)
    kept = Kept(tmp_path / "kept")
    (first,) = learned([*items, bad], [Detector()], kept)
    before = len(counted)
    (again,) = learned([*items, bad], [Detector()], kept)
    assert len(counted) == before
    assert again.unusable == first.unusable
    assert [one.name for one in again.unusable] == ["z"]
    for one, other in zip(first.methods, again.methods, strict=True):
        np.testing.assert_array_equal(one.bank.filters, other.bank.filters)
    next(kept.folder.glob("*.npz")).write_bytes(b"damaged")
    learned([*items, bad], [Detector()], kept)
    assert len(counted) > before


@pytest.mark.parametrize("change", ["seed", "photos", "folds", "settings"])
def test_other_work_is_learned_anew(items, counted, tmp_path, change):
    kept = Kept(tmp_path)
    learned(items, [Detector()], kept)
    before = len(counted)
    if change == "seed":
        list(Folds(items, _dealt(items, 2), seed=1, kept=kept).learned([Detector()]))
    elif change == "photos":
        learned(items[:4], [Detector()], kept)
    elif change == "folds":
        learned(items, [Detector()], kept, count=3)
    else:
        learned(items, [Detector(config=DetectorConfig(frame=0))], kept)
    assert len(counted) > before


def test_what_was_learned_fold_by_fold_is_read_again(items, tmp_path, monkeypatch):
    method = make_method("sift-hog-edges")
    kept = Kept(tmp_path)
    (first,) = learned(items, [method], kept)

    def fit(*_):
        raise AssertionError("it was learned before")

    monkeypatch.setattr(type(method), "fit", fit)
    (again,) = learned(items, [method], kept)
    assert again.failures == ()
    for one, other in zip(first.methods, again.methods, strict=True):
        np.testing.assert_array_equal(one.model["weights"], other.model["weights"])


def test_a_family_that_cannot_learn_is_told_under_each_name(items, monkeypatch):
    first, second = make_method("sift-hog-edges"), make_method("sift-hog-scores")
    assert first.family == second.family

    def fit(*_):
        raise ValueError("it rains.")

    monkeypatch.setattr(type(first), "fit", fit)
    found = learned(items, [first, second])
    assert [one.failures[0].name for one in found] == [first.name, second.name]
    assert {method for one in found for method in one.methods} == {None}


def test_a_photo_that_cannot_be_read_spoils_no_fold(items, tmp_path):
    bad = sv.DatasetItem("p05", tmp_path / "gone.png", items[0].truth_path)
    order = sorted([*items, bad], key=lambda item: item.name)
    (found,) = learned(order, [make_method("sift-hog-edges")])
    assert [one.name for one in found.unusable] == ["p05"]
    assert None not in found.methods
    assert found == replace(found, failures=())
