"""The photos of a folder and of the folders in it: which pictures are photos, and what the rest is.

Every command of both programs asks here, so that all see the same photos in a folder.

- Hidden files and folders are left out. Linked ones count under their own names.
- Folders called as `TRUTH_FOLDERS`, and pictures called as `ADDED` says, hold truths.
- Where a folder of truths lies beside ``images/`` or the like, the photos are in ``images/``.
- In a folder with a ``photo`` of GeoPose3K or an ``original``, that one is the photo.
- What `skyline_viz` and `annotate` have written is no photo, see `SIGNS`.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from skyline_viz.datasets.image_folder import linked_truths
from skyline_viz.datasets.matching import (
    ADDED,
    IMAGE_FOLDERS,
    TRUTH_FOLDERS,
    bare_stem,
    folders_in,
    is_label_map,
    is_truth_word,
)
from skyline_viz.picture_files.kinds import left_out
from skyline_viz.picture_files.listing import find_photos, find_unread

SIGNS = (
    ("skylines.csv", "run.json"),
    ("gallery.json",),
    ("summary.json", "photos.csv"),
    ("segments.csv", "diagnosis.json"),
    ("index.html", "pages", "thumbnails"),
    ("names.csv", "ground_truth"),
    ("names.csv", "cvg"),
)
"""Files that lie together in what was written by `detect`, `gallery`, `evaluate`, `diagnose`,
``gallery --html``, and an export with photos."""

OF_ONE_PHOTO = ("cyl", "pinhole")
"""Folders of GeoPose3K that belong to the photo beside them."""

_GALLERY = {"gallery.json", "thumbnails"}
_FIGURES = ("histogram", "curves", "causes")  # pictures in a folder of results
_OVERLAY = "-overlay"  # what `detect` adds to the name of a photo with its line
_SKY = "sky"  # a folder of truths only beside images


@dataclass
class Tree:
    """What lies in a folder and in the folders below it."""

    root: Path
    """The folder."""

    named: bool = True
    """Whether it was asked for, and is not one that was come upon."""

    photos: list[Path] = field(default_factory=list)
    """Its photos, those of a folder before those of the folders in it."""

    lone: set[Path] = field(default_factory=set)
    """Those that are called after their folder, which holds no other photo."""

    beside: list[Path] = field(default_factory=list)
    """Pictures among photos that are truths."""

    truths: list[Path] = field(default_factory=list)
    """Folders of truths."""

    linked: dict[Path, Path] = field(default_factory=dict)
    """The truths that a table beside photos names."""

    unread: list[Path] = field(default_factory=list)
    """Pictures that cannot be read."""

    written: Counter[Path] = field(default_factory=Counter)
    """How many pictures of a folder our programs have written."""

    elsewhere: Counter[Path] = field(default_factory=Counter)
    """How many photos lie in a folder beside those of a data set."""

    @classmethod
    def of(cls, root: Path, *, named: bool = True) -> Tree:
        """Look through a folder.

        Args:
            root: The folder.
            named: See `Tree.named`.

        Raises:
            OSError: It cannot be listed. Folders in it that cannot be are left out.
        """
        tree = cls(root, named)
        tree._visit(root, {})
        return tree

    def said(self) -> tuple[str, ...]:
        """What was not taken, a sentence for each reason."""
        found = [left_out(self.unread, self.root)]
        if self.written:
            found.append(
                f"pictures written by skyline-viz are no photos: {self._at(self.written)}."
            )
        if self.elsewhere:
            where = self._at(self.elsewhere)
            found.append(
                f"photos in other places are not taken: {where}; name those folders to take them."
            )
        return tuple(one for one in found if one)

    def _at(self, counts: Mapping[Path, int]) -> str:
        """How many lie where, in words."""
        return ", ".join(
            f"{count} in {self._called(folder)}" for folder, count in sorted(counts.items())
        )

    def _called(self, folder: Path) -> str:
        return "the folder itself" if folder == self.root else str(folder.relative_to(self.root))

    def _visit(self, here: Path, above: Mapping[tuple[int, int], Path]) -> None:
        status = here.stat()
        place = status.st_dev, status.st_ino
        if place in above:  # a link to a folder in which it lies
            return
        above = {**above, place: here}
        pictures, folders = find_photos(here), folders_in(here)
        self.unread += find_unread(here)
        self.linked |= linked_truths(here)
        pictures = self._without_written(here, pictures)
        folders = [one for one in folders if not self._is_written(one, here)]
        images = [one for one in folders if one.name.lower() in IMAGE_FOLDERS]
        truths = [one for one in folders if _holds_truths(one, bool(images))]
        folders = [one for one in folders if one not in truths]
        self.truths += truths
        at = len(self.photos)
        if images and truths:
            for one in images:
                self._enter(one, above)
            if len(self.photos) > at:
                self._leave(here, pictures, [one for one in folders if one not in images])
                return
            folders = [one for one in folders if one not in images]
        asked_for = self.named and here == self.root
        lone = _lone(here, pictures, folders, asked_for)
        if lone:
            self.photos.append(lone)
            self.lone.add(lone)
            others = [one for one in pictures if one != lone]
            self.beside += [one for one in others if is_truth_word(one.stem)]
            self._leave(here, [one for one in others if not is_truth_word(one.stem)], ())
            maps = [one for one in folders if one.name.lower() == OF_ONE_PHOTO[1]]
            self.beside += [file for one in maps for file in find_photos(one)]
            folders = [one for one in folders if one.name.lower() not in OF_ONE_PHOTO]
        elif _maps_alone(here, pictures) and not asked_for:
            self.beside += [] if here.name.lower() == OF_ONE_PHOTO[0] else pictures
        else:
            named = {*self.linked.values()}
            known = {one.stem for one in pictures}
            for one in pictures:
                truth = one in named or is_truth_beside(one.stem, known)
                (self.beside if truth else self.photos).append(one)
        for one in folders:
            self._enter(one, above)

    def _enter(self, folder: Path, above: Mapping[tuple[int, int], Path]) -> None:
        try:
            self._visit(folder, above)
        except OSError:
            return  # it may not be listed, or is gone

    def _leave(self, here: Path, pictures: Sequence[Path], folders: Iterable[Path]) -> None:
        """Count photos that are not taken."""
        known = {one.stem for one in pictures}
        counts = {here: sum(not is_truth_beside(one.stem, known) for one in pictures)}
        for one in folders:
            below = Tree(one, named=False)
            below._enter(one, {})
            counts[one] = len(below.photos)
        self.elsewhere.update({place: count for place, count in counts.items() if count})

    def _is_written(self, folder: Path, parent: Path) -> bool:
        """Whether one of our programs has made a folder; counts the pictures in it then."""
        own = [sign for sign in SIGNS if folder.name == "thumbnails" and _GALLERY & {*sign}]
        thumbnails = any(_all_in(parent, sign) for sign in own)
        if not (thumbnails or any(_all_in(folder, sign) for sign in SIGNS)):
            return False
        places = [Path(place) for place, _, _ in os.walk(folder)]
        if count := sum(len(find_photos(place)) for place in places):
            self.written[folder] += count
        return True

    def _without_written(self, here: Path, pictures: list[Path]) -> list[Path]:
        """Pictures but the results of our programs that lie among them."""
        results = any(_all_in(here, sign) for sign in SIGNS)
        known = {one.stem for one in pictures}

        def ours(file: Path) -> bool:
            overlay = file.stem.endswith(_OVERLAY)
            photo = file.stem.removesuffix(_OVERLAY)
            among = results and (overlay or file.stem in _FIGURES or file.stem.endswith("-mask"))
            return among or (overlay and photo in known)

        kept = [one for one in pictures if not ours(one)]
        if len(kept) < len(pictures):
            self.written[here] += len(pictures) - len(kept)
        return kept


def photos_below(folder: Path) -> Iterator[Path]:
    """Photos of a folder and of the folders in it.

    Raises:
        OSError: `folder` cannot be listed.
    """
    yield from Tree.of(folder).photos


def _all_in(folder: Path, names: Iterable[str]) -> bool:
    return all((folder / name).exists() for name in names)


def _holds_truths(folder: Path, beside_images: bool) -> bool:
    name = folder.name.lower()
    return name in TRUTH_FOLDERS or (beside_images and name == _SKY)


def is_truth_beside(stem: str, known: set[str]) -> bool:
    """Whether a picture among others is a truth, by its stem and all stems.

    >>> is_truth_beside("knife_edge", {"knife_edge"}), is_truth_beside("a_edge", {"a", "a_edge"})
    (False, True)
    """
    added = ADDED.search(stem)
    mask = added is not None and added[0].lower() in ("-mask", "_mask")
    return added is not None and (mask or bare_stem(stem) in known)


def _maps_alone(here: Path, pictures: list[Path]) -> bool:
    """Whether a folder holds nothing but label maps of GeoPose3K, whose photo is missing."""
    own = here.name.lower() not in IMAGE_FOLDERS
    return own and bool(pictures) and all(is_label_map(one.stem) for one in pictures)


def _lone(here: Path, pictures: list[Path], folders: list[Path], asked_for: bool) -> Path | None:
    """The photo that has a folder for itself; None where there is none."""
    if here.name.lower() in IMAGE_FOLDERS:
        return None
    named = {one.stem.lower(): one for one in reversed(pictures)}
    if "original" in named and not asked_for:
        return named["original"]
    photo = named.get("photo")
    if photo is None:
        return None
    pinhole = any(one.name.lower() == OF_ONE_PHOTO[1] and find_photos(one) for one in folders)
    maps = pinhole or any(is_label_map(one.stem) for one in pictures)
    alone = all(one == photo or is_truth_word(one.stem) for one in pictures)
    return photo if maps or (alone and not asked_for) else None
