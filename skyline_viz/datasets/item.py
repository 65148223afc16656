"""A photo and its truth, wherever they come from: what learning and testing ask for."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol

from skyline_viz.arrays import U8
from skyline_viz.skyline import Skyline, SkylineError


class Item(Protocol):
    """A photo of a data set. `DatasetItem` is one; so is whatever has a name and these two.

    Both may be asked for again and again, so they read from where the pixels lie, and keep nothing.
    """

    @property
    def name(self) -> str:
        """What the photo is called; no other one of the data set has the same name."""

    def photo(self) -> U8:
        """The photo, ``(H, W, 3)`` uint8 RGB."""

    def truth(self) -> Skyline | None:
        """Its true skyline; None where there is none."""


@dataclass(frozen=True, eq=False)
class LoadedItem:
    """A photo and its truth in memory.

    Examples:
        >>> from skyline_viz.rendering import render
        >>> scene = render("desert", 1, 160, 120)
        >>> LoadedItem(scene.name, scene.photo, scene.truth).photo().shape
        (120, 160, 3)
    """

    name: str
    """What the photo is called."""

    pixels: U8
    """``(H, W, 3)`` uint8 RGB."""

    skyline: Skyline | None = None
    """Its true skyline, where it is known."""

    def photo(self) -> U8:
        """The pixels."""
        return self.pixels

    def truth(self) -> Skyline | None:
        """The true skyline."""
        return self.skyline


def listed(items: Iterable[Item]) -> list[Item]:
    """The photos of a data set as a list.

    Raises:
        ValueError: They are none, or something else than photos.
    """
    if isinstance(items, str | os.PathLike):
        raise ValueError(f"{os.fspath(items)} is a path; open it with sv.open_dataset.")
    found = list(items) if isinstance(items, Iterable) else [items]
    for one in found:
        if not all(hasattr(one, part) for part in ("name", "photo", "truth")):
            kind = type(one).__name__
            raise ValueError(
                f"a photo to work on has a name, photo() and truth(), as sv.LoadedItem has; "
                f"this is a {kind}."
            )
    if not found:
        raise ValueError("there are no photos to work on.")
    return found


def photo_and_truth(item: Item) -> tuple[U8, Skyline]:
    """Both, of a photo to learn from or to be tested on.

    Raises:
        PhotoError: The photo cannot be read.
        SkylineError: It has no truth, or one that is damaged or of another width.
    """
    truth = item.truth()  # first: without it there is no need to read the photo
    if truth is None:
        raise SkylineError("there is no truth")
    photo = item.photo()
    if photo.shape[1] != truth.width:
        raise SkylineError(f"the photo is {photo.shape[1]} columns wide, the truth {truth.width}")
    return photo, truth
