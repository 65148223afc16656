"""The studies of Tables III and IV: what is trained, and on what."""

from dataclasses import replace

import pytest

import skyline_viz as sv
from skyline_viz.detector import Detector
from skyline_viz.evaluation.cross_validation import cross_validate, evaluate
from skyline_viz.evaluation.paper_tables import tables
from skyline_viz.evaluation.timing import Timing


@pytest.mark.parametrize("size", [5, 7])
def test_filters_of_a_size_are_learned_for_each_fold(items, size):
    config = sv.DetectorConfig.paper()
    found = cross_validate(items, Detector(tables.untrained(size), config), 2)
    assert found.methods["paper"].bank.size == size
    expected = sv.train(
        [(one.photo(), one.truth()) for one in items[1::2]],
        config=replace(sv.TrainingConfig.of(config), filter_size=size),
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


def test_ours_are_known_by_what_they_are_and_not_by_their_names(items):
    found = evaluate(items, ["mine=default", "default=edges", "paper:delta=4", "edges"])
    table = tables.table_2({"hills": found})
    measured = [row[0] for row in table.rows if "published" not in row[1]]
    assert list(dict.fromkeys(measured)) == ["mine", "paper:delta=4"]
    timings = [Timing(name, 2.0 ** (1 + at)) for at, name in enumerate(found.methods)]
    rows = tables.table_6(timings, found.methods).rows[: len(timings)]
    assert [(row[0], row[3]) for row in rows] == [
        ("mine", "1.0"),
        ("default", "2.0"),
        ("paper:delta=4", "4.0"),
        ("Edges only", "8.0"),
    ]
    rows = tables.table_6(timings[1:], found.methods).rows  # without the default one
    assert rows[0][3] == "0.5"


def test_what_published_figures_were_trained_on():
    published = {row[0]: row[2] for row in tables.table_1({}, 2).rows}
    assert published["Proposed"] == "CH1"
    assert (published["Edges only"], published["G_r"]) == ("nothing", "nothing")
    assert {published["SVM-mDCSI"], published["SIFT+HOG edges"]} == {"Basalt Hills (9)"}
