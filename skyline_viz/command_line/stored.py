"""Photos of a command line that are named by paths, addresses, or both."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePosixPath

from skyline_viz.command_line.inputs import collect, output_names
from skyline_viz.command_line.messages import counted, say
from skyline_viz.command_line.sources import Missing, spelt_out
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.datasets.listed_names import told_apart
from skyline_viz.datasets.named_item import NamedItem
from skyline_viz.datasets.stored_item import StoredItem
from skyline_viz.datasets.tables.parquet_files import is_label_table
from skyline_viz.storage.addresses import StorageError, is_address
from skyline_viz.storage.listing import Listed, photos_at
from skyline_viz.storage.stored_photo import StoredPhoto
from skyline_viz.system.names import listed


def collect_stored(words: Sequence[str], taken: Sequence[str] = ()) -> list[NamedItem]:
    """`inputs.collect`, also of addresses, which come after the paths.

    Args:
        words: Paths, patterns, addresses and lists of these.
        taken: Names that no photo's outputs may have.

    Raises:
        DatasetError: A folder holds no photo, or several data sets.
        StorageError: An address leads nowhere, or to no photo.
    """
    paths, addresses = _sorted(words)
    found = collect(paths, taken=taken) if paths else []
    stored = _listed(addresses)
    items = [StoredItem(one.stem, Path(one.name), stored=one) for one in stored]
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
    paths, addresses = _sorted(words)
    files = [one.item for one in collect(paths)] if paths else []
    return [*map(stored_photo, files), *_listed(addresses)], files


def _sorted(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """Paths and tables of labels; and addresses of photos and of what holds them."""
    paths: list[str] = []
    addresses: list[str] = []
    for word in spelt_out(words):
        stored = is_address(word) and not is_label_table(word)
        (addresses if stored else paths).append(word)
    return paths, addresses


def _listed(addresses: Sequence[str]) -> list[StoredPhoto]:
    """The photos at addresses, each once."""
    found: dict[str, StoredPhoto] = {}
    for word in addresses:
        for one in _photos(word):
            found.setdefault(one.address, _travelling(one))
    return [*found.values()]


def _travelling(one: Listed) -> StoredPhoto:
    return StoredPhoto(one.address, one.size, one.stamp, one.fault)


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
