"""The studies of Tables III and IV: what is trained, and on what."""

import pytest

import skyline_viz as sv
from skyline_viz.detector import Detector
from skyline_viz.evaluation import tables
from skyline_viz.evaluation.cross_validation import cross_validate, evaluate


@pytest.mark.parametrize("size", [5, 7])
def test_filters_of_a_size_are_learned_for_each_fold(items, size):
    config = sv.DetectorConfig.paper()
    found = cross_validate(items, Detector(tables.untrained(size), config), 2)
    assert found.methods["paper"].bank.size == size
    expected = sv.train(
        [(one.photo(), one.truth()) for one in items[1::2]],
        config=sv.TrainingConfig(filter_size=size, detector=config),
    )
    assert found.methods["paper"].bank.filters == pytest.approx(expected.filters, abs=1e-6)


def test_the_study_of_sizes_has_a_row_for_each(items, monkeypatch):
    monkeypatch.setattr(tables, "SIZES", (7, 5))
    table = tables.table_3({"hills": items}, 2, 0, 1)
    measured = [row for row in table.rows if row[1] == "hills"]
    assert [row[0] for row in measured] == ["7 x 7", "5 x 5"]
    found = cross_validate(items, "paper", 2).summaries["paper"]
    assert measured[0][2:4] == (found.mean, found.standard_deviation)


def test_each_data_set_teaches_for_each_other_one(items):
    table = tables.table_4({"a": items[:3], "b": items[3:]}, 0, 1)
    measured = [row for row in table.rows if "published" not in row[0]]
    assert [row[:2] for row in measured] == [("a", "b"), ("b", "a")]
    config = sv.DetectorConfig.paper()
    taught = Detector(config=config).fit(items[:3])
    (expected,) = evaluate(items[3:], taught).summaries.values()
    assert measured[0][2] == expected.mean
