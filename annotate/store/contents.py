"""Which photo of a folder a label was made for: told by what is in the files, not by names."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from annotate.store.identity import Photo, file_digest, pixel_digest
from annotate.store.labels import Label
from skyline_viz.photo import PhotoError, photo_size, read_photo


class Contents:
    """The photos of a folder, to be found by their bytes or their pixels.

    Files are read only when they are asked for, and pixels only of photos with as many columns and
    rows as the label.
    """

    def __init__(self, folder: Path, names: Iterable[str], photos: Iterable[Photo] = ()) -> None:
        """Look at some photos.

        Args:
            folder: The folder.
            names: Names of the photos below it.
            photos: What is known of them; it holds now.
        """
        self._folder = folder
        self._names = dict.fromkeys(sorted(names))
        self._digests = {one.name: one.digest for one in photos}
        self._pixels = {one.name: one.pixels for one in photos if one.pixels}
        self._by_digest: dict[str, str] | None = None

    @classmethod
    def of(cls, folder: Path, photos: Iterable[Photo]) -> Contents:
        """The photos that `Store.find` has just found."""
        photos = list(photos)
        return cls(folder, [photo.name for photo in photos], photos)

    def name_of(self, label: Label) -> str | None:
        """Name of the photo that a label was made for; None where it is not here.

        A label without digests, as other programs write them, goes by its name.
        """
        if label.name in self._names and self.are(label.name, label):
            return label.name
        if label.digest and self._by_digest is None:
            self._by_digest = {self._digest(name): name for name in reversed(self._names)}
        if label.digest and self._by_digest and label.digest in self._by_digest:
            return self._by_digest[label.digest]
        size = label.height, label.width
        for name in self._names if label.pixels else []:
            if self._size(name) == size and self._pixels_of(name) == label.pixels:
                return name
        return None

    def copies(self, names: Iterable[str]) -> dict[str, str]:
        """Other names of these photos: of files of the folder with the same bytes as one of them.

        Args:
            names: Names of files that may be copies.
        """
        others = [name for name in names if name not in self._names]
        photos = {self._digest(name): name for name in reversed(self._names)} if others else {}
        photos.pop("", None)  # what cannot be read
        return {name: photos[one] for name in others if (one := self._digest(name)) in photos}

    def are(self, name: str, label: Label) -> bool:
        """Whether a photo is the one that a label was made for."""
        if not label.digest and not label.pixels:
            return name == label.name
        if label.digest and self._digest(name) == label.digest:
            return True
        return bool(label.pixels) and self._pixels_of(name) == label.pixels

    def _digest(self, name: str) -> str:
        if name not in self._digests:
            try:
                self._digests[name] = file_digest(self._folder / name)
            except OSError:
                self._digests[name] = ""
        return self._digests[name]

    def _pixels_of(self, name: str) -> str:
        if name not in self._pixels:
            try:
                self._pixels[name] = pixel_digest(read_photo(self._folder / name))
            except PhotoError:
                self._pixels[name] = ""
        return self._pixels[name]

    def _size(self, name: str) -> tuple[int, int] | None:
        try:
            return photo_size(self._folder / name)
        except PhotoError:
            return None
