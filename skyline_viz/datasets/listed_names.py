"""Which pictures of a listing are photos, by names alone, as `tree` tells it of folders.

A storage is not asked about sizes and contents of millions of files. So a picture is a truth where
it lies in a folder of truths, is called ``a_mask``, or as another picture beside it with ``_edge``,
``_gt`` or the like; or where it lies with a ``photo`` of GeoPose3K.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby
from posixpath import splitext
from typing import TypeVar

from skyline_viz.datasets.matching import TRUTH_FOLDERS, is_truth_word
from skyline_viz.datasets.tree import OF_ONE_PHOTO, is_truth_beside

_PHOTO = "photo"  # of GeoPose3K

Kept = TypeVar("Kept")


def told_apart(pictures: Iterable[tuple[str, Kept]]) -> Iterator[tuple[str, Kept, bool]]:
    """Each picture, and whether it is a photo.

    Args:
        pictures: Paths below what was listed, folder by folder, each folder before those in it;
            and whatever belongs to them.

    >>> found = told_apart([("a.jpg", 1), ("a_gt.png", 2), ("masks/b.png", 3), ("tor_gt.jpg", 4)])
    >>> [(name, photo) for name, _, photo in found]
    [('a.jpg', True), ('a_gt.png', False), ('masks/b.png', False), ('tor_gt.jpg', True)]
    """
    lone: set[str] = set()  # folders with a photo of GeoPose3K
    for folder, group in groupby(pictures, lambda one: one[0].rpartition("/")[0]):
        inside = [*group]
        known = {_stem(name) for name, _ in inside}
        if any(one.lower() == _PHOTO for one in known):
            lone.add(folder)
        above, _, own = folder.rpartition("/")
        maps = own.lower() in OF_ONE_PHOTO and above in lone
        truths = maps or any(part in TRUTH_FOLDERS for part in folder.lower().split("/"))
        for name, kept in inside:
            beside = is_truth_beside(_stem(name), known)
            word = folder in lone and is_truth_word(_stem(name))
            yield name, kept, not (truths or beside or word)


def _stem(name: str) -> str:
    return splitext(name.rpartition("/")[2])[0]
