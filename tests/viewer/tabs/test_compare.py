"""Two detections beside each other."""

from skyline_viz.stage import OURS, Quantity
from skyline_viz.viewer.blueprints import detection_blueprint
from skyline_viz.viewer.contents import Contents
from testing.layouts import shown_in, tab_of


def test_the_second_of_two_methods_shows_stages_that_the_first_has_not():
    probability = Quantity("sky probability", group="maps")
    contents = Contents(300, 800, compared="own", compared_stages=(*OURS[:1], probability))
    assert "other/maps/sky_probability/**" in shown_in(
        tab_of(detection_blueprint(contents), "Compare")
    )
