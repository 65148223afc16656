"""Bars and dates on finished photos."""

import pytest

from skyline_viz.rendering.marks import bars, stamp


@pytest.mark.parametrize(
    ("border", "corner", "top", "side"),
    [
        ("", False, False, False),
        ("letterbox", True, True, False),
        ("pillarbox", True, False, True),
        ("passepartout", True, True, True),
        ("window", False, False, False),
    ],
)
def test_bars_lie_where_their_name_says(border, corner, top, side):
    mask = bars(border, 0.1, (60, 90))
    assert not mask[10:50, 10:80].any()
    assert (mask[0, 0], mask[5, 45], mask[30, 5]) == (corner, top, side)
    assert (mask == mask[::-1, ::-1]).all()


def test_a_date_grows_with_the_photo_and_fits_into_small_ones():
    assert stamp(600, 900).sum() == 4 * stamp(300, 450).sum()
    assert not stamp(300, 450)[:250].any()
    assert stamp(32, 32).any()
