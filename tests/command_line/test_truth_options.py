"""The options that say how to read truths."""

import numpy as np
import pytest

from skyline_viz.command_line.truth_options import Truths
from skyline_viz.skyline import SkylineError
from testing import label_files as made
from testing.datasets import put


def test_sky_and_terrain_exclude_each_other():
    with pytest.raises(ValueError, match="exclude each other"):
        Truths(sky="0", terrain="1")


def test_a_data_set_is_read_as_was_said(tmp_path):
    mask = made.ASK["three greys"](tmp_path)
    (tmp_path / "masks").mkdir()
    mask.rename(tmp_path / "masks" / "a.png")
    for other in tmp_path.glob("*.png"):
        other.unlink()
    put(tmp_path / "a.png", np.zeros((made.HEIGHT, made.WIDTH, 3), np.uint8))
    (item,) = Truths(sky="2").open(tmp_path)
    assert item.truth() == made.SKYLINE
    (item,) = Truths().open(tmp_path)
    with pytest.raises(SkylineError, match="--sky"):
        item.truth()
