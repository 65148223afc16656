"""Photos of a command line that are named by paths, addresses, or both."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from skyline_viz.arrays import U8
from skyline_viz.command_line.inputs import collect, output_names
from skyline_viz.command_line.messages import counted, say
from skyline_viz.command_line.sources import Missing, spelt_out
from skyline_viz.datasets.layouts import DatasetItem
from skyline_viz.datasets.listed_names import told_apart
from skyline_viz.datasets.named_item import NamedItem
from skyline_viz.storage.addresses import StorageError, is_address
from skyline_viz.storage.listing import Listed, photos_at
from skyline_viz.storage.stored_photo import StoredPhoto
from skyline_viz.system.names import listed


@dataclass(frozen=True)
class StoredItem(DatasetItem):
    """A photo at an address. Its path is made from that, and names no file."""

    stored: StoredPhoto = field(default_factory=lambda: StoredPhoto(""))
    """The photo."""

    def photo(self) -> U8:
        """Download and decode the photo, ``(H, W, 3)`` uint8 RGB.

        Raises:
            PhotoError: It cannot be read.
            StorageError: It cannot be downloaded.
        """
        pixels = self.stored.read()[1]
        assert pixels is not None
        return pixels


def collect_stored(words: Sequence[str], taken: Sequence[str] = ()) -> list[NamedItem]:
    """`inputs.collect`, also of addresses, which come after the paths.

    Args:
        words: Paths, patterns, addresses and lists of these.
        taken: Names that no photo's outputs may have.

    Raises:
        DatasetError: A folder holds no photo, or several data sets.
        StorageError: An address leads nowhere, or to no photo.
    """
    words = [*spelt_out(words)]
    paths = [Path(word) for word in words if not is_address(word)]
    found = collect(paths, taken=taken) if paths else []
    stored = _listed(words)
    items = [StoredItem(_stem(one.name), Path(one.name), stored=one) for one in stored]
    names = output_names(items, [*taken, *(one.name for one in found)])
    return found + [NamedItem(name, item) for name, item in zip(names, items, strict=True)]


def stored_photo(item: DatasetItem) -> StoredPhoto:
    """A photo as it travels."""
    if isinstance(item, StoredItem):
        return item.stored
    reason = item.reason if isinstance(item, Missing) else ""
    return StoredPhoto(str(item.photo_path), missing=reason)


def photos_named(words: Sequence[str]) -> tuple[list[StoredPhoto], list[DatasetItem]]:
    """All photos as they travel, each once; and those of them that are files.

    Args:
        words: Paths, patterns, addresses and lists of these.

    Raises:
        DatasetError: A folder holds no photo, or several data sets.
        StorageError: An address leads nowhere, or to no photo.
    """
    words = [*spelt_out(words)]
    paths = [Path(word) for word in words if not is_address(word)]
    files = [one.item for one in collect(paths)] if paths else []
    return [*map(stored_photo, files), *_listed(words)], files


def _listed(words: Sequence[str]) -> list[StoredPhoto]:
    """The photos at addresses, each once."""
    found: dict[str, StoredPhoto] = {}
    for word in filter(is_address, words):
        for one in _photos(word):
            found.setdefault(one.address, StoredPhoto(one.address, one.size, one.stamp))
    return [*found.values()]


def _photos(address: str) -> Iterator[Listed]:
    """The photos at an address, without their truths; says how many of these there are.

    Raises:
        StorageError: It leads nowhere, or to no photo.
    """
    truths: Counter[str] = Counter()
    some = False
    for name, one, is_own in told_apart((one.below, one) for one in photos_at(address)):
        if is_own:
            some = True
            yield one
        else:
            truths[str(PurePosixPath(name).parent)] += 1
    where = listed([place if place != "." else "the folder itself" for place in truths])
    left = f"{counted(truths.total(), 'picture')} in {where}"
    if not some:
        raise StorageError(f"{address} holds no photograph but truths of others: {left}.")
    if truths:
        say(f"{address}: truths are no photos: {left}.")


def _stem(address: str) -> str:
    """The photo's name without its ending.

    >>> _stem("zip://alps/eiger.jpg::s3://photos/all.zip"), _stem("https://host/a.b.png?raw=1")
    ('eiger', 'a.b')
    """
    return Path(address.partition("::")[0].partition("?")[0]).stem
