"""What is said of the pixels in a column."""

import numpy as np

import skyline_viz as sv
from skyline_viz.diagnosis.explanation import explain_pixels
from skyline_viz.viewer import entities
from skyline_viz.viewer.pixel_words import about_pixels
from testing.recordings import scene


def test_costs_of_both_and_their_difference_stand_beside_each_other():
    found = sv.Detector().detect(scene()[0])
    path, truth = explain_pixels(found, [int(found.skyline.rows[5]), 80], [5, 5])
    at = np.array([5], np.int32)
    (text,) = about_pixels(found, [("path", at, [path]), ("truth", at, [truth])], at)
    assert text.startswith("**Column 5**\n")
    gap = truth.cost - path.cost
    assert f"| **nodal cost** | {path.cost:.3f} | {truth.cost:.3f} | **{gap:+.3f}** |" in text
    assert f"| pays for no edge | 0.000 | {truth.terms['no edge']:.3f} |" in text
    assert "| edge | yes | **no** |  |" in text
    assert path.why_edge in text
    assert truth.filtered.why[1] in text


def test_terms_that_are_switched_off_are_left_out():
    found = sv.Detector(config=sv.DetectorConfig.paper()).detect(scene()[0])
    at = np.array([entities.OPENING], np.int32)
    (text,) = about_pixels(found, [("path", at, explain_pixels(found, [30], [5]))], at)
    assert "clear sky" not in text
    assert "pays for score" in text
    assert "the worst one" in text
