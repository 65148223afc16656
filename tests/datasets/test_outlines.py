"""The geometry of drawn labels: which pixels a polygon holds, and which rows a line has."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from skyline_viz.datasets.outlines import line_rows, polygon_mask
from testing import label_files as made
from testing.examples import examples
from testing.imports import imported, said_about
from testing.label_files import WIDTH, coco, labelme, shape

FEW = examples(30, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.mark.parametrize(
    ("points", "wanted"),
    [
        ([(0.5, 50), (40.5, 50), (40.5, 20), (60.5, 20), (60.5, 50), (159.5, 50)], "steps"),
        ([(0.5, 50), (40, 50), (50, 40), (30, 20), (60, 20), (159.5, 50)], "overhang"),
        ([(-30, 50), (40.5, 50), (400, 50)], "beyond"),
        ([(2.5, 50), (157, 50)], "inside"),
    ],
)
def test_lines_of_every_form(tmp_path, photos, points, wanted):
    line = imported(made.written(tmp_path / "a.json", labelme(shape(points))), photos)
    line = line.found[0].skyline
    x = np.arange(WIDTH) + 0.5
    if wanted == "steps":
        np.testing.assert_array_equal(line.rows, np.where((x >= 40.5) & (x <= 60.5), 20, 50))
    elif wanted == "overhang":
        assert (line.rows[:29] == 50).all()
        assert (line.rows[30:60] == 20).all()
        assert (np.diff(line.rows[60:]) >= 0).all()
    elif wanted == "beyond":
        assert (line.rows == 50).all()
        assert line.visible.all()
    else:
        assert np.flatnonzero(line.visible)[[0, -1]].tolist() == [2, 157]


@FEW
@given(
    data=st.data(),
)
def test_polygons_mean_the_pixels_whose_centres_they_hold(tmp_path, photos, data):
    place = st.floats(-20, 60, allow_nan=False).map(lambda one: round(one, 2) + 0.003)
    points = data.draw(st.lists(st.tuples(place, place), min_size=3, max_size=8))
    mask, _ = polygon_mask([np.array(points)], 30, 40)
    for row, column in [(r, c) for r in range(0, 30, 3) for c in range(0, 40, 3)]:
        x, y = column + 0.5, row + 0.5
        crossed = [
            y0 + (x - x0) / (x1 - x0) * (y1 - y0)
            for (x0, y0), (x1, y1) in zip(points, [*points[1:], points[0]], strict=True)
            if (x0 <= x) != (x1 <= x)
        ]
        if all(abs(y - one) > 1e-6 for one in crossed):  # a centre on an edge may be either
            assert mask[row, column] == (sum(y > one for one in crossed) % 2 == 1)


SHARES = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.4), (0.5, 0.3), (0.0, 0.4)]


IN_SHARES = {
    "coco": coco([[made.flat(SHARES)]]),
    "labelme line": labelme(shape(SHARES[2:])),
    "labelme polygon": labelme(shape(SHARES, "sky", "polygon")),
    "cvat": made.cvat(f'<polyline label="skyline" points="{made.cvat_points(SHARES[2:])}"/>'),
}


@pytest.mark.parametrize("kind", IN_SHARES)
def test_shares_of_the_sides_are_no_pixels(tmp_path, photos, kind):
    ending = "xml" if kind == "cvat" else "json"
    said = said_about(made.written(tmp_path / f"a.{ending}", IN_SHARES[kind]), photos)
    assert "its points lie within one pixel of the corner: coordinates must be in pixels." in said


@pytest.mark.parametrize(("height", "row"), [(20.4, 20), (20.5, 21), (20.6, 21), (0.2, 0)])
def test_rows_of_a_line_are_whole_and_the_nearest(height, row):
    rows, reached = line_rows([np.array([[0.0, height], [9.0, height]])], 48, 9)
    assert reached.all()
    assert set(rows) == {row}
