"""The photos of a folder, and of the folders in it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from skyline_viz.datasets.matching import is_truth_folder, without_truths
from skyline_viz.photo import find_photos
from skyline_viz.picture_files.kinds import left_out
from skyline_viz.picture_files.listing import find_unread


def photos_below(folder: Path) -> Iterator[Path]:
    """Photos of a folder and of the folders in it; hidden ones and truths are left out."""
    for place, folders, _ in os.walk(folder):
        here = Path(place)
        shown = sorted(name for name in folders if not name.startswith("."))
        folders[:] = [name for name in shown if not is_truth_folder(here / name)]
        yield from without_truths(find_photos(here))


def unread_below(folder: Path) -> str | None:
    """A sentence about pictures of a folder, and of those in it, that cannot be read."""
    found: list[Path] = []
    for place, folders, _ in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        found += find_unread(place)
    return left_out(found, folder)
