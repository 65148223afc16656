"""Kinds of options that commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal, TypeAlias

import tyro

from skyline_viz.command_line.messages import UsageError

Preset: TypeAlias = Literal["default", "paper"]
"""Where single settings start from: the best that is known, or the published method."""

Folder: TypeAlias = Annotated[Path, tyro.conf.arg(metavar="DIR")]
"""A folder."""

OptionalFolder: TypeAlias = Annotated[Path | None, tyro.conf.arg(metavar="DIR")]
"""A folder, or None to do without."""

BankFile: TypeAlias = Annotated[Path | None, tyro.conf.arg(metavar="FILE")]
"""A file of a detector or filter bank, or None for the shipped one."""

RunFile: TypeAlias = Annotated[Path | None, tyro.conf.arg(name="config", metavar="FILE")]
"""run.json or summary.json of an earlier run, or None."""

ClusterAddress: TypeAlias = Annotated[str | None, tyro.conf.arg(metavar="ADDRESS")]
"""Address of a dask scheduler, ``local:N``, or None to do without."""

Switch: TypeAlias = tyro.conf.FlagCreatePairsOff[bool]
"""Off unless it is named."""

_SIDES = (320, 8192)  # of a window, in pixels


def check_picture(path: Path | None) -> None:
    """Refuse a file for a picture that would be of no known kind.

    Raises:
        UsageError: It ends in neither ``.png`` nor ``.jpg``.
    """
    if path is not None and path.suffix.lower() not in (".png", ".jpg"):
        raise UsageError(f"pictures are PNG or JPEG, so {path} should end in .png or .jpg.")


def window_size(text: str) -> tuple[int, int]:
    """Width and height of a window, in pixels.

    >>> window_size("1920x1080")
    (1920, 1080)

    Raises:
        UsageError: It is none that a viewer's window can have.
    """
    sides = [int(part) if part.isdecimal() else 0 for part in text.lower().split("x")]
    if len(sides) != 2 or not all(_SIDES[0] <= side <= _SIDES[1] for side in sides):
        raise UsageError(
            f"--screenshot-size is WIDTHxHEIGHT, each from {_SIDES[0]} to {_SIDES[1]} pixels, "
            f"such as 1920x1080, not {text}."
        )
    return sides[0], sides[1]
