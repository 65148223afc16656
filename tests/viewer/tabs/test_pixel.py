"""Tabs of one pixel: nothing is shown of a truth or a bank that there is not."""

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.pixel import bank_tab, pixel_tab
from testing.layouts import shown_in


def test_both_pixels_are_shown_where_there_is_a_truth():
    assert f"{entities.pixel_of('truth')}/product" in shown_in(
        pixel_tab(Contents(300, 800, truth=True, columns=True))
    )
    assert f"{entities.pixel_of('truth')}/product" not in shown_in(
        pixel_tab(Contents(300, 800, columns=True))
    )


def test_a_method_without_filters_has_words_alone():
    shown = shown_in(pixel_tab(Contents(300, 800, bank=False, columns=True)))
    assert entities.PIXEL_ABOUT in shown
    assert f"{entities.pixel_of('path')}/filter" not in shown


def test_the_bank_has_the_photo_beside_it_where_pixels_can_be_chosen():
    assert entities.PHOTO in shown_in(bank_tab(Contents(300, 800, columns=True)))
    assert entities.PHOTO not in shown_in(bank_tab(Contents(300, 800)))
