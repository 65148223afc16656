"""Options that commands share."""

from pathlib import Path

import pytest

from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.settings import check_picture, window_size


def test_pictures_are_png_or_jpeg():
    for path in (None, Path("a.png"), Path("b.JPG")):
        check_picture(path)
    with pytest.raises(UsageError, match=r"so a\.gif should end in .png or .jpg"):
        check_picture(Path("a.gif"))


def test_a_window_has_a_size_that_a_screen_could_have():
    assert window_size("1920x1080") == (1920, 1080)
    for text in ("1920", "1920x", "10x10", "99999x800", "axb", "800x600x2", "-800x600", ""):
        with pytest.raises(UsageError, match=r"--screenshot-size is WIDTHxHEIGHT"):
            window_size(text)
