"""From a region of sky to its skyline."""

import numpy as np
import pytest

from skyline_viz.datasets.sky_region import line_of
from skyline_viz.datasets.truths import truth_with_notes
from skyline_viz.skyline import SkylineError
from testing import label_files as made


@pytest.mark.parametrize(
    ("kind", "note"),
    [
        ("a frame of 2", "a frame of 2 pixels was left out"),
        ("a bird", "specks above the line were left out in columns 50 to 55"),
    ],
)
def test_what_was_left_out_is_said(tmp_path, kind, note):
    assert truth_with_notes(made.SAME[kind](tmp_path)).notes == (note,)


def test_a_large_piece_in_the_sky_is_terrain_and_is_said(tmp_path):
    path = made.picture(tmp_path / "m.png", made.spotted(made.MASK, 5, 25, 50, 80, 255))
    line = truth_with_notes(path)
    assert (line.skyline.rows[50:80] == 5).all()
    assert "columns 50 to 79" in line.notes[0]


def test_a_region_of_nothing_has_no_line():
    with pytest.raises(SkylineError):
        line_of(np.random.default_rng(0).random((40, 40)) > 0.5)
