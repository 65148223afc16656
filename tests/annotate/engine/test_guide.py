"""The corridor along a rough stroke."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from annotate.engine.guide import Guide, guide_along, radii_of
from testing.examples import examples

SIZE = HEIGHT, WIDTH = 60, 90
VERTICES = st.lists(
    st.tuples(st.integers(-20, WIDTH + 20), st.integers(-20, HEIGHT + 20)), min_size=1, max_size=6
)


def covered(points, radius):
    """Pixels within the radius of a stroke, one by one: ``(H, W)``."""
    rows, columns = np.mgrid[:HEIGHT, :WIDTH]
    nearest = np.full(SIZE, np.inf)
    for (x, y), (to_x, to_y) in zip(points, points[1:] or points, strict=False):
        across, down = to_x - x, to_y - y
        length = across**2 + down**2
        along = ((columns - x) * across + (rows - y) * down) / length if length else 0.0
        along = np.clip(along, 0, 1)
        away = np.hypot(columns - x - along * across, rows - y - along * down)
        nearest = np.minimum(nearest, away)
    return nearest <= radius


@examples(100)
@given(
    st.lists(
        st.tuples(st.integers(0, WIDTH - 1), st.integers(0, HEIGHT - 1)), min_size=1, max_size=5
    ),
    st.integers(1, 15),
)
def test_a_corridor_is_what_a_disc_covers_of_each_column(points, radius):
    guide = guide_along(points, radius, [], SIZE)
    across = [column for column, _ in points]
    assert guide.columns == (min(across), max(across))
    wanted = covered(points, radius)
    for at, column in enumerate(range(guide.first, guide.last + 1)):
        rows = np.flatnonzero(wanted[:, column])
        assert abs(guide.tops[at] - rows.min()) <= 1
        assert abs(guide.bottoms[at] - rows.max()) <= 1


@examples(100)
@given(VERTICES, st.integers(1, 15), st.integers(1, 5))
def test_from_every_pixel_of_a_corridor_a_line_leads_on(points, radius, delta):
    guide = guide_along(points, radius, [], SIZE)
    if guide is None:
        return
    tops, bottoms = guide.bounds(delta)
    assert (tops <= guide.tops).all()
    assert (bottoms >= guide.bottoms).all()
    assert (tops >= 0).all()
    assert (bottoms < HEIGHT).all()
    assert (np.abs(np.diff(tops)) <= delta).all()
    assert (np.abs(np.diff(bottoms)) <= delta).all()


def test_a_stroke_that_is_not_too_steep_is_not_widened():
    guide = guide_along([(5, 20), (40, 50), (80, 10)], 4, [], SIZE)
    tops, bottoms = guide.bounds(2)
    assert tops.tolist() == list(guide.tops)
    assert bottoms.tolist() == list(guide.bottoms)


@pytest.mark.parametrize("points", [[(-9, 5), (-4, 9)], [(5, -9)], [(5, 70)], [(100, 5)]])
def test_a_stroke_beside_the_photo_is_none(points):
    assert guide_along(points, 3, [], SIZE) is None


def test_many_far_vertices_take_little_memory():
    zigzag = [(100_000 * (-1) ** one, 100_000 * (-1) ** (one // 2)) for one in range(500)]
    assert guide_along(zigzag, 3, [], SIZE).columns == (0, WIDTH - 1)


def test_what_is_cut_out_is_gone():
    guide = Guide(10, (1, 2, 3, 4), (5, 6, 7, 8))
    assert guide.without(11, 12) == [Guide(10, (1,), (5,)), Guide(13, (4,), (8,))]
    assert guide.without(0, 10) == [Guide(11, (2, 3, 4), (6, 7, 8))]
    assert guide.without(20, 30) == [guide]
    assert guide.without(0, 30) == []


def test_a_fast_hand_is_less_certain():
    vertices = np.array([[0.0, 5.0], [10.0, 5.0], [80.0, 5.0]])
    slow = radii_of(vertices, 4, [0, 5000, 40_000])
    fast = radii_of(vertices, 4, [0, 5000, 5100])
    np.testing.assert_allclose(slow, 4, rtol=0.02)
    np.testing.assert_allclose(fast, [slow[0], 8, 8])
    assert radii_of(vertices, 4, []).tolist() == [4, 4, 4]
    assert radii_of(vertices, 4, [7, 7, 7]).tolist() == [8, 8, 8]
