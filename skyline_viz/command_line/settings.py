"""The options that say how to detect: preset, single settings, filter bank."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, TypeAlias, cast, get_args

import tyro

from skyline_viz.command_line.messages import UsageError
from skyline_viz.config import DetectorConfig

if TYPE_CHECKING:
    from skyline_viz.detector import Detector  # compiled code: not needed for help

Preset: TypeAlias = Literal["default", "paper"]
"""Where single settings start from: the best that is known, or the published method."""

Folder: TypeAlias = Annotated[Path, tyro.conf.arg(metavar="DIR")]
"""A folder."""

OptionalFolder: TypeAlias = Annotated[Path | None, tyro.conf.arg(metavar="DIR")]
"""A folder, or None to do without."""

BankFile: TypeAlias = Annotated[Path | None, tyro.conf.arg(metavar="FILE")]
"""A filter bank, or None for the shipped one."""

Switch: TypeAlias = tyro.conf.FlagCreatePairsOff[bool]
"""Off unless it is named."""


def check_picture(path: Path | None) -> None:
    """Refuse a file for a picture that would be of no known kind.

    Raises:
        UsageError: It ends in neither ``.png`` nor ``.jpg``.
    """
    if path is not None and path.suffix.lower() not in (".png", ".jpg"):
        raise UsageError(f"pictures are PNG or JPEG, so {path} should end in .png or .jpg.")


def config_of(preset: Preset) -> DetectorConfig:
    """Settings of a preset."""
    return DetectorConfig.paper() if preset == "paper" else DetectorConfig()


def asked_preset(arguments: Sequence[str]) -> Preset:
    """Preset that a command line asks for, looked up before it is parsed.

    The preset decides about the defaults of all single settings, which parsing has to know.

    >>> asked_preset(["detect", "a.jpg", "--preset", "paper", "--config.delta", "2"])
    'paper'
    """
    words = [word for argument in arguments for word in argument.split("=", 1)]
    asked = [after for word, after in pairwise(words) if word == "--preset"]
    known = [cast("Preset", preset) for preset in asked if preset in get_args(Preset)]
    return known[-1] if known else "default"


def make_detector(bank: Path | None, config: DetectorConfig) -> Detector:
    """Detector with a filter bank from a file, or with the shipped one.

    Raises:
        FilterBankError: The file is no filter bank.
    """
    from skyline_viz.detector import Detector  # noqa: PLC0415
    from skyline_viz.filter_bank import FilterBank  # noqa: PLC0415

    return Detector(FilterBank.load(bank) if bank else FilterBank.default(), config)
