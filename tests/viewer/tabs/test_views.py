"""What tabs are made of: grids without holes."""

import pytest

from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.maps.map_aids import SCALE
from skyline_viz.viewer.tabs.views import columns_for, grid, map_view, photo_view


@pytest.mark.parametrize(
    ("shape", "count", "columns"),
    [
        ((519, 1388), 9, 3),
        ((1024, 1024), 9, 3),
        ((1024, 768), 9, 5),
        ((300, 3000), 4, 1),
        ((1024, 1024), 4, 2),
    ],
)
def test_as_many_columns_as_make_the_maps_largest(shape, count, columns):
    assert columns_for(Contents(*shape), count) == columns


@pytest.mark.parametrize("shape", [(300, 800), (400, 400), (800, 400)])
@pytest.mark.parametrize("count", [1, 4, 7, 9])
def test_a_grid_has_no_holes(shape, count):
    views = [photo_view(str(number), ["photo"]) for number in range(count)]
    rows = [len(row.contents) for row in grid(Contents(*shape), views, "Tab").contents]
    assert sum(rows) == count
    assert max(rows) - min(rows) <= 1


def test_maps_of_photos_of_several_sizes_have_no_scale_that_would_shrink_them():
    one = map_view(Contents(300, 800), "Map", ["map"])
    many = map_view(Contents(300, 800, one_size=False), "Map", ["map"])
    assert "VisualBounds2D" in one.properties
    assert f"- /map/{SCALE}" not in one.contents
    assert "VisualBounds2D" not in many.properties
    assert f"- /map/{SCALE}" in many.contents
