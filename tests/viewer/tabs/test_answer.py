"""The first tab: the line, and beside it what it comes to."""

import pytest

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.answer import photos_tab, skyline_tab
from testing.layouts import shown_in


@pytest.mark.parametrize("shape", [(300, 800), (500, 500), (800, 400)])
def test_the_line_is_there_with_its_report_and_errors(shape):
    shown = shown_in(skyline_tab(Contents(*shape, truth=True)))
    assert {entities.PHOTO, f"{entities.PATH}/**", entities.REPORT, entities.ERRORS} <= shown


def test_without_a_truth_the_margin_stands_in_place_of_the_error():
    shown = shown_in(skyline_tab(Contents(300, 800)))
    assert entities.MARGINS in shown
    assert entities.ERRORS not in shown


def test_several_photos_have_their_errors_only_with_a_truth():
    assert f"{entities.METRICS}/a_err" in shown_in(photos_tab(Contents(3, 8, truth=True)))
    assert f"{entities.METRICS}/a_err" not in shown_in(photos_tab(Contents(3, 8)))
