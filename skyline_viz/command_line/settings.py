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

Switch: TypeAlias = tyro.conf.FlagCreatePairsOff[bool]
"""Off unless it is named."""


def check_picture(path: Path | None) -> None:
    """Refuse a file for a picture that would be of no known kind.

    Raises:
        UsageError: It ends in neither ``.png`` nor ``.jpg``.
    """
    if path is not None and path.suffix.lower() not in (".png", ".jpg"):
        raise UsageError(f"pictures are PNG or JPEG, so {path} should end in .png or .jpg.")
