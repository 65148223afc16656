"""The diagnosis: frames, lines and marks on the whole photo, and why."""

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.diagnosis import diagnosis_tab
from testing.layouts import shown_in, views_of


def test_it_shows_segments_lines_marks_and_reasons():
    shown = shown_in(diagnosis_tab(Contents(300, 800, truth=True, diagnosed=True)))
    assert {
        f"{entities.SEGMENTS}/**",
        f"{entities.COUNTERFACTUAL}/**",
        entities.TRUTH_MISSED,
        entities.DIAGNOSIS,
    } <= shown


def test_photos_of_several_sizes_are_not_cut_to_that_of_the_first():
    def bounds(**more):
        (photo, *_) = views_of(diagnosis_tab(Contents(300, 800, diagnosed=True, **more)))
        return "VisualBounds2D" in photo.properties

    assert bounds()
    assert not bounds(one_size=False)
