"""Options that commands share."""

from pathlib import Path

import pytest

from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.settings import check_picture


def test_pictures_are_png_or_jpeg():
    for path in (None, Path("a.png"), Path("b.JPG")):
        check_picture(path)
    with pytest.raises(UsageError, match=r"so a\.gif should end in .png or .jpg"):
        check_picture(Path("a.gif"))
