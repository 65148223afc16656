"""Reading truths: painted photographs, masks, label maps, and skylines in CSV or JSON.

Which one a file is, is told by its content.

- A *painted photograph* has a line in pure red or pure blue, about one pixel a column. Hundreds a
  column are a region, and so a mask. In a picture of few colours a strip may be a river or a road.
- A *mask* tells sky from terrain, by grey level, colour, palette or transparency. Sky lies above
  terrain: of two values the upper one is sky, whether it is 0, as we write it, or 255. Soft masks
  are cut in the middle, at 128. A mask of one grey level is all sky if it is 0, and all terrain if
  it is 255. With more than two values somebody has to say which is which.
- Specks above the line, as birds are, and a frame of a few pixels are left out.

GeoPose3K's label maps are rendered from a terrain model; black, (0, 0, 0), is taken for its sky,
and every other colour, blends at borders too, for terrain. A column without sky, or with nothing
else, is not visible: there the skyline lies outside the picture.
"""

import re
from pathlib import Path

import numpy as np

from skyline_viz.arrays import U8, Bool, in_colour
from skyline_viz.datasets.label_classes import Classes, classes_of
from skyline_viz.datasets.label_picture import LabelPicture, read_label_picture
from skyline_viz.datasets.painted_line import painted_line
from skyline_viz.datasets.sky_region import Line, line_of, shape_of
from skyline_viz.photo import PhotoError, read_photo
from skyline_viz.skyline import Skyline, SkylineError

SKYLINE_SUFFIXES = (".csv", ".json")
"""File name endings (lower case) of a `Skyline`."""

_MOST_BYTES = 50_000_000
"""A CSV or JSON of more bytes holds no skyline."""


def read_truth(
    path: Path, label_map: bool = False, *, sky: str | None = None, terrain: str | None = None
) -> Skyline:
    """Read one truth.

    Args:
        path: Painted photo, mask, label map, CSV or JSON.
        label_map: Whether a picture is a label map.
        sky: Which value of a mask is sky: a grey level, a palette index, a colour (``#4682b4`` or
            ``steelblue``), ``transparent`` or ``opaque``; several with commas between. Told by
            the mask itself unless given.
        terrain: Which value is terrain, instead of `sky`.

    Raises:
        SkylineError: Damaged, no truth, or to be read in two ways; the message names the file.
    """
    return truth_with_notes(path, label_map, sky=sky, terrain=terrain).skyline


def truth_with_notes(
    path: Path, label_map: bool = False, *, sky: str | None = None, terrain: str | None = None
) -> Line:
    """Read one truth as `read_truth` does, and say what was left out of it.

    Raises:
        SkylineError: As `read_truth`.
    """
    if sky is not None and terrain is not None:
        raise SkylineError("say which value is sky, or which is terrain, and not both.")
    try:
        if path.suffix.lower() in SKYLINE_SUFFIXES:
            return Line(_text(path))
        if label_map:
            pixels = read_photo(path)
        else:
            picture = read_label_picture(path)
    except PhotoError as error:
        raise SkylineError(str(error)) from error
    except OSError as error:
        raise SkylineError(f"{path} cannot be read: {error.strerror}.") from error
    try:
        if label_map:
            return Line(_from_label_map(pixels))
        line = _read(picture, sky, terrain)
        return Line(line.skyline, picture.notes + line.notes)
    except _AskError as error:
        raise SkylineError(f"{path} {error}.") from error
    except SkylineError as error:
        raise SkylineError(f"{path} is no truth: {error}.") from error


def begins_like_a_skyline(file: Path) -> bool:
    """Whether a CSV or JSON among photos holds a skyline, and not something else about them."""
    try:
        if not file.is_file():
            return False
        with file.open("rb") as opened:
            return (
                re.search(rb'column,row,visible|"format":\s*"skyline"', opened.read(80)) is not None
            )
    except OSError:
        return False


class _AskError(SkylineError):
    """A mask can be read in two ways."""


def _text(path: Path) -> Skyline:
    if not path.is_file() and path.exists():  # reading a pipe would wait for its other end
        raise SkylineError(f"{path} is no file that holds a skyline.")
    if path.stat().st_size > _MOST_BYTES:
        raise SkylineError(f"{path} is larger than any skyline.")
    if path.suffix.lower() == ".csv":
        return Skyline.read_csv(path)
    return Skyline.read_json(path)


def _read(picture: LabelPicture, sky: str | None, terrain: str | None) -> Line:
    """Tell what a picture is, and read it."""
    given = sky is not None or terrain is not None
    if not given and (painted := painted_line(picture)) is not None:
        return painted
    classes = classes_of(picture)
    if classes is None:
        if given and (painted := painted_line(picture)) is not None:
            return painted
        raise SkylineError("no pixel is painted in pure red or pure blue, and it is no mask")
    if sky is None and terrain is None:
        return line_of(_upper(classes))
    region = classes.region(sky) if sky is not None else ~classes.region(str(terrain))
    shape = shape_of(region)
    if region.any() and (shape.below > shape.above or not (shape.above or region[0].any())):
        called, value = ("sky", sky) if sky is not None else ("terrain", terrain)
        raise SkylineError(f"{value} is not {called} in it, or sky would lie below terrain")
    return line_of(region)


def _upper(classes: Classes) -> Bool:
    """Where the sky is, if only one reading is possible.

    Raises:
        SkylineError: None is, or several are.
    """
    dark: Bool = np.asarray(classes.regions == 0)
    usual = classes.kind == "grey levels" and classes.found[0].is_meant_by("0")
    if len(classes.found) == 1:
        if usual or classes.found[0].is_meant_by("255"):
            return dark if usual else np.asarray(~dark)
        raise _AskError(f"holds {_asking(classes)}")
    if len(classes.found) > 2:
        raise _AskError(f"holds {_asking(classes)}")
    lower, upper = shape_of(dark), shape_of(~dark)
    if lower.possible and (usual or not lower.thin):
        return dark
    if upper.possible and not upper.thin:
        return np.asarray(~dark)
    raise SkylineError(
        f"it is neither painted nor a mask with sky above terrain; it holds {_asking(classes)}"
    )


def _asking(classes: Classes) -> str:
    top = classes.found[np.bincount(classes.regions[0]).argmax()]
    return (
        f"{classes.said}: say which is sky with --sky {top.shown} or the like, "
        f"or which is terrain with --terrain VALUE"
    )


def _from_label_map(pixels: U8) -> Skyline:
    """Skyline of a GeoPose3K label map ``(H, W, 3)``."""
    rows = Skyline.from_mask(in_colour(pixels, (0, 0, 0))).rows
    visible = (rows > 0) & (rows < len(pixels))
    if not visible.any():
        raise SkylineError("no column holds both sky (black) and terrain")
    return Skyline(rows, visible)
