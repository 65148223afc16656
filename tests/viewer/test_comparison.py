"""A second detection beside the first: its line, its stages, and what differs."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.viewer import entities
from skyline_viz.viewer.comparison import log_comparison
from testing.recordings import Read, drawn_rows, scene, visible_rows


@pytest.mark.parametrize("apart", [0, 30])
def test_it_says_where_the_second_one_differs(apart, tmp_path):
    photo, truth = scene()
    detection = sv.Detector().detect(photo)
    changed = photo.copy()
    if apart:  # a wall in the sky, which the second detector sees
        changed[5:, 20:60] = 20
    other = sv.Detector().detect(changed)
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        verdict = log_comparison(recording, detection, other, truth, "the <second> one")
    assert verdict.a_err == pytest.approx(sv.a_err(other.skyline, truth))
    read = Read(tmp_path / "a.rrd")
    line = drawn_rows(read.last(entities.ALTERNATIVE, "strips").as_py(), photo.shape[1])
    np.testing.assert_array_equal(line, visible_rows(other.skyline))
    assert entities.below(entities.OTHER, entities.COST) in read.entities()
    (text,) = read.last(entities.COMPARISON, "text").as_py()
    lower = np.abs(other.skyline.rows - detection.skyline.rows)
    assert f"Largest difference {lower.max():.0f} px, mean {lower.mean():.2f} px" in text
    assert ("apart: none" in text) == (apart == 0)
    assert "<second>" not in text
