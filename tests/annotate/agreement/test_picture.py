"""The picture of the photos that differ most, looked at pixel by pixel."""

import numpy as np
import pytest

from annotate.agreement.pairs import compared
from annotate.agreement.picture import COLOURS, picture
from skyline_viz.photo import write_photo
from testing.labels import made

PASSES = [("ann", 1), ("bob", 1), ("eve", 1)]
GREY = 120
LEGEND = 40  # rows of the picture that hold the legend and no photo, at most


@pytest.fixture
def folder(tmp_path):
    for number in range(8):
        write_photo(tmp_path / f"{number}.png", np.full((400, 600, 3), GREY, np.uint8))
    return tmp_path


def labels(count, apart=40):
    """Photos on which bob is off in a few columns, more from one to the next."""
    found = []
    for number in range(count):
        rows = np.full(600, 200)
        where = {"name": f"{number}.png", "digest": f"{number}"}
        found += [made(rows, "ann", **where), made(rows + 1, "eve", **where)]
        rows = rows.copy()
        rows[300:330] += apart + number
        found.append(made(rows, "bob", **where))
    return found


def has(part, colour):
    return bool((np.abs(part.astype(int) - colour).sum(axis=2) < 12).any())


def test_the_legend_and_the_place_have_the_colour_of_each_pass(folder):
    found = picture(compared(labels(1), PASSES), PASSES, folder)
    for colour in COLOURS[:3]:
        assert has(found[:LEGEND], colour)
        assert has(found[LEGEND:], colour)
    assert len(set(COLOURS)) == len(COLOURS)


def test_the_place_is_enlarged_and_five_photos_are_readable(folder):
    found = picture(compared(labels(5), PASSES), PASSES, folder)
    assert found.shape[1] == 960
    assert len(found) < 1600
    zoom = found[LEGEND : LEGEND + 240, 240:]
    bob = np.argwhere(np.abs(zoom.astype(int) - COLOURS[1]).sum(axis=2) < 12)
    across = np.ptp(bob[bob[:, 0] > np.median(bob[:, 0]) + 20][:, 1])
    assert across > 3 * 30  # his 30 columns


def test_the_worst_photos_are_drawn_and_no_more_than_six(folder):
    six = picture(compared(labels(6), PASSES), PASSES, folder)
    assert picture(compared(labels(8), PASSES), PASSES, folder).shape == six.shape


def test_photos_that_are_gone_are_left_out(folder, tmp_path):
    (folder / "0.png").unlink()
    assert picture(compared(labels(1), PASSES), PASSES, folder) is None


@pytest.mark.parametrize("size", [(16, 16), (16, 600), (400, 16), (20, 2000)])
def test_photos_of_any_shape_are_drawn(size, tmp_path):
    height, width = size
    write_photo(tmp_path / "0.png", np.full((height, width, 3), GREY, np.uint8))
    where = {"name": "0.png", "digest": "0"}
    both = [made([0] * width, **where), made([height] * width, "bob", **where)]
    found = picture(compared(both, PASSES[:2]), PASSES[:2], tmp_path)
    assert found.shape[1] == 960
