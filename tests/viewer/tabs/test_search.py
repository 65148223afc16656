"""Tab *Search*."""

import pytest

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.maps.stage_maps import SEARCH
from skyline_viz.viewer.tabs.search import search_tab
from testing.layouts import views_of


@pytest.mark.parametrize("width", [800, 300])
def test_other_lines_have_a_view_and_a_table_where_there_are_any(width):
    plain = list(views_of(search_tab(Contents(300, width, truth=True))))
    assert [one.name for one in plain] == [one.title.split(":")[0] for one in SEARCH]
    found = list(views_of(search_tab(Contents(300, width, truth=True, other_lines=3))))
    assert len(found) == len(plain) + 2
    assert any(f"+ /{entities.OTHER_LINES}/**" in (one.contents or []) for one in found)
    assert any(str(one.origin) == entities.OTHER_LINES_TABLE for one in found)
