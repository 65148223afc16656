"""The charts of a data set."""

import pytest

from skyline_viz.reports.charts import LARGEST, SIZE, charts
from testing.detections import result


def results(*errors):
    return [result(f"p{number}", error) for number, error in enumerate(errors)]


def test_the_highest_bar_fills_the_chart_and_the_last_bin_is_far():
    found = charts({"default": results(0.1, 0.2, 3.0, 300.0)})
    assert [bar.label for bar in found.bars] == ["50%", "25%", "25%"]
    assert found.bars[0].height == SIZE[1]
    assert [bar.far for bar in found.bars] == [False, False, True]


def test_bars_of_several_methods_stand_beside_each_other():
    first, second = charts({"a": results(0.1), "b": results(0.2)}).bars
    assert first.x + first.width == pytest.approx(second.x)
    assert (first.method, second.method) == (0, 1)


def test_the_curve_climbs_at_the_errors_and_ends_at_the_largest_tolerance():
    (curve,) = charts({"a": results(LARGEST / 2, 300.0)}).curves
    assert curve.path == "M0 160L0 160L0 160L180 160L180 80L360 80L360 80"
    assert curve.said == "0% within 1 px, 0% within 4 px, 50% within 20 px"


def test_no_method_is_an_empty_chart():
    assert charts({}).bars == ()
