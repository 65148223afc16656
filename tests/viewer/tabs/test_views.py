"""What tabs are made of: grids without holes."""

import pytest

from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import grid, photo_view


@pytest.mark.parametrize(("width", "columns"), [(800, 2), (400, 3)])
@pytest.mark.parametrize("count", [4, 7, 9])
def test_wide_photos_have_room_for_two_views_side_by_side(width, columns, count):
    views = [photo_view(str(number), ["photo"]) for number in range(count)]
    rows = [len(row.contents) for row in grid(Contents(300, width), views, "Tab").contents]
    assert max(rows) == columns or sum(rows) == count <= columns**2
    assert min(rows) >= max(rows) - 1  # and no hole
