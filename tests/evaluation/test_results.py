"""Results photo by photo, and their summary."""

import math
from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.evaluation.results import PhotoResult, Summary, worst


def result(name="a", error=0.0, **changes):
    """A result whose figures are made up."""
    plain = PhotoResult.of(name, sv.Skyline([4]), sv.Skyline([4]), height=9, seconds=0.5)
    return replace(plain, a_err=error, **changes)


def test_a_result_by_hand():
    truth = sv.Skyline([10, 10, 10, 10], np.array([True, True, True, False]))
    one = PhotoResult.of("a", sv.Skyline([10, 16, 10, 29]), truth, height=30, seconds=0.25)
    assert one == PhotoResult(
        name="a",
        a_err=2.0,
        worst_error=6.0,
        worst_column=1,
        segmentation_accuracy=1 - 2 / 30,
        gross_miss=True,
        seconds=0.25,
        height=30,
        width=4,
    )


def test_a_result_needs_a_visible_column_of_the_truth():
    blind = sv.Skyline([1, 2], np.array([False, False]))
    with pytest.raises(sv.SkylineError, match="visible in no column"):
        PhotoResult.of("a", sv.Skyline([1, 2]), blind, height=9)


def test_a_detection_that_looks_away_is_counted_all_the_same():
    found = sv.Skyline([1, 2, 3, 9], np.array([True, True, True, False]))
    one = PhotoResult.of("a", found, sv.Skyline([1, 2, 3, 4]), height=9)
    assert (one.a_err, one.worst_column, one.called_invisible) == (1.25, 3, 0.25)
    assert Summary.of([one, PhotoResult.of("b", found, found, height=9)]).called_invisible == 0.125


def test_a_summary_by_hand():
    errors = (0.0, 3.99, 4.0, 5.0)
    summary = Summary.of(
        [
            result("a", error, gross_miss=error > 4.5, segmentation_accuracy=1 - error / 10)
            for error in errors
        ]
    )
    assert summary.photos == 4
    assert summary.mean == pytest.approx(3.2475)
    assert summary.standard_deviation == pytest.approx(np.std(errors))
    assert summary.median == pytest.approx(3.995)
    assert (summary.minimum, summary.maximum) == (0.0, 5.0)
    assert (summary.under_4_px, summary.under_5_px) == (0.5, 0.75)
    assert summary.gross_misses == 1
    assert summary.segmentation_accuracy == pytest.approx(1 - 0.32475)
    assert summary.seconds == 0.5


def test_a_summary_of_nothing_has_no_figures():
    summary = Summary.of([])
    assert (summary.photos, summary.gross_misses) == (0, 0)
    assert math.isnan(summary.mean)


def test_the_worst_come_first_and_ties_by_name():
    results = [result("c", 1.0), result("a", 1.0), result("b", 7.0), result("d", 0.5)]
    assert [one.name for one in worst(results, 3)] == ["b", "a", "c"]
