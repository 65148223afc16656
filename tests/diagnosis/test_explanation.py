"""One pixel, all the way down: every number is the one that the detection used."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.diagnosis.explanation import explain_pixel, explain_pixels
from testing.recordings import scene


@pytest.fixture(scope="module")
def found():
    return sv.Detector().detect(scene()[0])


def test_every_edge_pixel_is_explained_by_the_numbers_of_its_detection(found):
    some = slice(None, None, 7)
    told = explain_pixels(found, found.edge_rows[some], found.edge_columns[some])
    assert all(one.edge for one in told)
    for name in ("strength", "coherence", "orientation"):
        values = [getattr(one.filtered, name) for one in told]
        np.testing.assert_allclose(values, getattr(found, name)[some], rtol=1e-6)
    assert [one.filtered.bin for one in told] == found.bins[some].tolist()
    for scores in ([one.score for one in told], [one.filtered.score for one in told]):
        np.testing.assert_allclose(scores, found.scores[some], atol=1e-7)


@given(st.data())
def test_terms_sum_up_to_the_cost_and_products_to_the_score(found, data):
    height, width = found.edges.shape
    row = data.draw(st.integers(0, height - 1))
    column = data.draw(st.integers(0, width - 1))
    told = explain_pixel(found, row, column)
    assert sum(told.terms.values()) == pytest.approx(told.cost, abs=1e-5)
    assert told.cost == pytest.approx(found.cost[row, column])
    assert told.edge == found.edges[row, column]
    assert told.why_edge.startswith("an edge" if told.edge else "no edge")
    once = told.filtered
    assert np.clip(once.product.sum(), 0, 1) == pytest.approx(once.score, abs=1e-4)
    middle = once.patch.shape[0] // 2
    np.testing.assert_array_equal(told.colours[middle, middle], found.photo[row, column])
    assert (told.score is None) == (not told.edge)
    assert len(once.why) == 3
    assert once.axes[0] >= once.axes[1] >= 0


def test_several_pixels_are_explained_as_each_alone(found):
    rows, columns = [40, 3, 89], [17, 119, 0]
    for one, row, column in zip(explain_pixels(found, rows, columns), rows, columns, strict=True):
        alone = explain_pixel(found, row, column)
        assert (one.row, one.column, one.why_edge) == (row, column, alone.why_edge)
        assert dict(one.terms) == pytest.approx(dict(alone.terms))
        np.testing.assert_array_equal(one.filtered.product, alone.filtered.product)
    assert explain_pixels(found, [], []) == []


def test_the_gradient_is_the_one_that_the_thresholds_are_for():
    photo = np.full((40, 60, 3), 120, np.uint8)
    photo[20:] = 90
    config = sv.DetectorConfig(
        fit_thresholds=False, low_threshold=50, high_threshold=150, frame=0, sky_edges=1.0
    )
    detect = sv.Detector(config=config).detect
    assert explain_pixel(detect(photo), 20, 30).gradient == 4 * 30
    assert "is over 50, but" in explain_pixel(detect(photo), 20, 30).why_edge
    photo[20:] = 60
    on, beside = (explain_pixel(detect(photo), row, 30) for row in (20, 19))
    assert on.why_edge == "an edge: its gradient of 240 is over 150"
    assert (
        beside.why_edge == "no edge: its gradient of 240 is over 150, but a neighbour's is larger"
    )


def test_pixels_of_a_frame_have_no_gradient():
    photo, _ = scene(height=90, width=120)
    framed = np.pad(photo, ((12, 12), (0, 0), (0, 0)))
    found = sv.Detector().detect(framed)
    assert found.frame.top == 12
    told = explain_pixel(found, 3, 40)
    assert told.gradient is None
    assert told.why_edge == "no edge: it lies in the frame of the picture"
    first = explain_pixel(found, 12, 40)
    inside = explain_pixel(sv.Detector().detect(photo), 0, 40)
    assert first.gradient == inside.gradient


def test_other_methods_know_their_score_and_terms_alone():
    photo, _ = scene()
    found = sv.find_method("gradient").detect(photo)
    told = explain_pixel(found, 30, 40)
    assert (told.filtered, told.gradient, told.why_edge) == (None, None, "")
    assert told.score is not None
    assert told.cost == pytest.approx(sum(told.terms.values()), abs=1e-5)


@pytest.mark.parametrize(("row", "column"), [(-1, 0), (90, 0), (0, 120)])
def test_pixels_that_there_are_not_are_refused(found, row, column):
    with pytest.raises(ValueError, match=f"row {row} and column {column}: the photo has 90 rows"):
        explain_pixel(found, row, column)
