"""Banks from whole data sets are those of the library, whatever the processes."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.config import FILTER_SIZES, TrainingConfig
from skyline_viz.evaluation.training_runs import (
    readable,
    train_on,
    train_on_several,
    train_sizes,
)
from skyline_viz.running.batch import Failure
from skyline_viz.training import GramMatrices, gather_item, solve, together


def test_training_is_that_of_the_library(items):
    bank, failures = train_on(items, TrainingConfig(), seed=3, dataset="hills")
    expected = sv.train([(i.photo(), i.truth()) for i in items], seed=3, dataset="hills")
    assert failures == []
    np.testing.assert_array_equal(bank.filters, expected.filters)
    np.testing.assert_array_equal(bank.samples, expected.samples)
    assert bank.provenance == expected.provenance


def test_two_processes_train_the_same_bank(items):
    alone, _ = train_on(items, TrainingConfig())
    shared, _ = train_on(items, TrainingConfig(), workers=2)
    np.testing.assert_array_equal(alone.filters, shared.filters)


def test_several_data_sets_count_alike_and_are_named(items):
    config = TrainingConfig()
    bank, failures = train_on_several({"few": items[:1], "many": items[1:]}, config, seed=2)
    sums = [
        sum((gather_item(config, 2, one) for one in part), GramMatrices.empty(config))
        for part in (items[:1], items[1:])
    ]
    expected = solve(together(sums), 2, config, "few, many")
    assert failures == []
    np.testing.assert_array_equal(bank.filters, expected.filters)
    assert bank.provenance == expected.provenance
    assert bank.provenance.images == len(items)
    alike, _ = train_on(items, config, seed=2)
    np.testing.assert_array_equal(bank.samples, alike.samples)
    assert not np.allclose(bank.filters, alike.filters)


def test_a_data_set_of_which_no_photo_can_be_used_is_not_passed_over(items, tmp_path):
    gone = sv.DatasetItem("bad/gone", tmp_path / "gone.png", items[0].truth_path)
    with pytest.raises(ValueError, match="the first one failed: bad/gone: "):
        train_on_several({"good": items, "bad": [gone]}, TrainingConfig())


def test_training_on_nothing_is_refused(tmp_path):
    with pytest.raises(ValueError, match="at least one photo with a true skyline"):
        train_on([], TrainingConfig())
    with pytest.raises(ValueError, match=r"the first one failed: gone: there is no truth"):
        train_on([sv.DatasetItem("gone", tmp_path / "gone.png")], TrainingConfig())


def test_banks_of_all_sizes_are_those_trained_one_by_one(items, tmp_path):
    gone = sv.DatasetItem("gone", tmp_path / "gone.png", items[0].truth_path)
    banks, failures = train_sizes([*items, gone], TrainingConfig(), dataset="hills")
    assert [failure.name for failure in failures] == ["gone"]
    assert [bank.size for bank in banks] == list(FILTER_SIZES)
    for bank in banks:
        alone, _ = train_on(items, TrainingConfig(filter_size=bank.size), dataset="hills")
        assert np.array_equal(bank.filters, alone.filters)
        assert bank.provenance == alone.provenance


def test_photos_that_cannot_be_read_are_put_aside():
    scene = sv.render("desert", 1, 96, 64)
    good = sv.LoadedItem("a", scene.photo, scene.truth)
    bad = sv.LoadedItem("b", scene.photo)
    found, failures = readable([good, bad, good])
    assert found == {0: good, 2: good}
    assert failures == [Failure("b", "there is no truth")]
