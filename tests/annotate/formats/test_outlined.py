"""Lines of every form, as files of other programs draw them."""

import numpy as np
import pytest

from testing import label_files as made
from testing.imports import imported, said_about
from testing.label_files import WIDTH, coco, labelme, shape


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
