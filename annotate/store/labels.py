"""What is known about a photo that has been labelled, and the words for it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from annotate.engine.hidden import Hidden
from skyline_viz.arrays import read_only
from skyline_viz.skyline import Skyline

Status: TypeAlias = Literal["to do", "in progress", "accepted", "needs review", "rejected"]
"""How far a photo is."""

STATUSES: tuple[Status, ...] = get_args(Status)
"""All of them."""

NO_SKYLINE = "no visible skyline"
"""The tag of a photo in which nothing of the line can be seen, whatever its line is."""

TAGS = (NO_SKYLINE, "not left to right", "needs terrain data")
"""Tags that are offered; annotators add their own."""

HIDDEN_BY = ("cloud", "fog", "person", "mast", "frame", "building")
"""What may hide the line in some columns; the page offers these."""


MOST_PASSES = 1_000_000
"""The largest number of a pass."""

LONGEST_NAME = 80
"""Characters of an annotator's name at most."""


LONGEST_COMMENT = 300
"""Characters of a comment at most."""

CONSENSUS = "consensus"
"""Annotator of the pass that comes out of comparing several."""


@dataclass(frozen=True)
class Comment:
    """What is to be looked at on a photo, or why it is rejected."""

    text: str
    """A sentence."""

    by: str
    """Who says so."""

    def __str__(self) -> str:
        """Both, on one line."""
        return f"{self.by}: {self.text}"


def named(annotator: str, number: int) -> str:
    """A pass by name, as commands take it.

    >>> named("ann", 1), named("ann", 2)
    ('ann', 'ann:2')
    """
    return annotator if number == 1 else f"{annotator}:{number}"


def check_annotator(name: str) -> str:
    """Return the name of an annotator.

    Raises:
        ValueError: It is none that can be shown on one line, and be part of a file's name.
    """
    if not name.strip():
        raise ValueError("an annotator needs a name.")
    if len(name) > LONGEST_NAME:
        raise ValueError(f"an annotator's name has at most {LONGEST_NAME} characters.")
    if not name.isprintable() or any(one in name for one in "/\\"):
        raise ValueError(f"an annotator's name is plain text without slashes, not {name!a}.")
    return name


@dataclass(frozen=True, eq=False)
class Label:
    """One pass of an annotator over a photo."""

    name: str
    """The photo's file below the folder, with ``/`` between folders."""

    digest: str
    """SHA-256 of the photo's file, in hexadecimal; empty where the label came without one."""

    width: int
    """Columns of the photo."""

    height: int
    """Its rows."""

    annotator: str
    """Who."""

    number: int
    """1 for the first pass of this annotator over the photo, 2 for the second."""

    status: str
    """One of `STATUSES`."""

    tags: tuple[str, ...]
    """What has been noted about the photo."""

    skyline: Skyline | None
    """The line, in whole rows; None where there is none yet. Nothing of it is visible where the
    tags say `NO_SKYLINE`."""

    origin: npt.NDArray[np.uint8]
    """``(W,)`` where the row of each column is from, as an index into `ORIGINS`."""

    operations: tuple[dict[str, Any], ...]
    """Everything that was done, oldest first: objects with ``kind`` and ``at``, a Unix time."""

    seconds: float
    """Time spent on it."""

    detector: str
    """What made the proposal, in words; empty for a label that is blind, or imported."""

    blind: bool
    """Whether it was labelled without a proposal."""

    comment: Comment | None = None
    """What is to be looked at, or why it is rejected; None where nobody has said anything."""

    pixels: str = ""
    """SHA-256 of the photo's upright pixels (`identity.pixel_digest`), which stays when metadata is
    edited; empty where it is not known."""

    hidden: tuple[Hidden, ...] = ()
    """Runs of columns that the annotator has hidden, and why."""

    def __post_init__(self) -> None:
        """Check that the widths agree, and freeze the array."""
        if self.status not in STATUSES:
            raise ValueError(f"the status of {self.name!r} is {self.status!r}, which is none.")
        if self.skyline is not None and self.skyline.width != self.width:
            raise ValueError(
                f"{self.name!r} has {self.width} columns, its skyline {self.skyline.width}."
            )
        if self.origin.shape != (self.width,):
            raise ValueError(f"{self.name!r} has {self.width} columns, and as many origins.")
        read_only(self.origin)
