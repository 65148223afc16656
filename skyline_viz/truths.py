"""Reading truths: painted photographs, masks, label maps, and skylines in CSV or JSON.

Which one a file is, is told by its content. A painted photograph has one pure red or pure blue
pixel a column; a mask is grey, 0 in the sky and 255 in the terrain, cut at 128.

GeoPose3K's label maps are rendered from a terrain model; black, (0, 0, 0), is taken for its sky,
and every other colour, blends at borders too, for terrain. A column without sky, or with nothing
else, is not visible: there the skyline lies outside the picture.
"""

import re
from pathlib import Path

from skyline_viz.arrays import U8
from skyline_viz.photo import PhotoError, read_photo
from skyline_viz.skyline import Skyline, SkylineError

SKYLINE_SUFFIXES = (".csv", ".json")
"""File name endings (lower case) of a `Skyline`."""


def read_truth(path: Path, label_map: bool = False) -> Skyline:
    """Read one truth.

    Args:
        path: Painted photo, mask, label map, CSV or JSON.
        label_map: Whether a picture is a label map.

    Raises:
        SkylineError: Damaged, or no truth; the message names the file.
    """
    try:
        if path.suffix.lower() == ".csv":
            return Skyline.read_csv(path)
        if path.suffix.lower() == ".json":
            return Skyline.read_json(path)
        pixels = read_photo(path)
    except PhotoError as error:
        raise SkylineError(str(error)) from error
    except OSError as error:
        raise SkylineError(f"{path} cannot be read: {error.strerror}.") from error
    try:
        if label_map:
            return _from_label_map(pixels)
        grey = (pixels.max(axis=2) - pixels.min(axis=2)).max() < 32  # JPEG tints a grey mask a bit
        return _from_mask(pixels[:, :, 1]) if grey else Skyline.from_painted(pixels)
    except SkylineError as error:
        raise SkylineError(f"{path} is no truth: {error}.") from error


def begins_like_a_skyline(file: Path) -> bool:
    """Whether a CSV or JSON among photos holds a skyline, and not something else about them."""
    try:
        with file.open("rb") as opened:
            return re.search(rb"column,row,visible|skyline", opened.read(80)) is not None
    except OSError:
        return False


def _from_mask(grey: U8) -> Skyline:
    """Skyline of a mask ``(H, W)``; refuses what would silently give a wrong truth."""
    if 0 < grey.max() < 128:
        raise SkylineError(f"its brightest value is {grey.max()}, and terrain is 255 in a mask")
    terrain = grey >= 128
    skyline = Skyline.from_mask(~terrain)
    upside_down = terrain[0].all() and not terrain[-1].any()
    if upside_down or (skyline.to_mask(len(grey)) == terrain).mean() > 0.2:  # a few lakes are fine
        raise SkylineError("it is neither painted nor a mask with sky (0) above terrain (255)")
    return skyline


def _from_label_map(pixels: U8) -> Skyline:
    """Skyline of a GeoPose3K label map ``(H, W, 3)``."""
    rows = Skyline.from_mask((pixels == 0).all(axis=2)).rows
    visible = (rows > 0) & (rows < len(pixels))
    if not visible.any():
        raise SkylineError("no column holds both sky (black) and terrain")
    return Skyline(rows, visible)
