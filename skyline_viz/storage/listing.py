"""The photos at an address: one file, or all below a folder, a prefix or in an archive."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from skyline_viz.picture_files.kinds import PHOTO_SUFFIXES
from skyline_viz.storage.addresses import StorageError, address_of, file_system
from skyline_viz.storage.fetching import persistent

_STAMPS = ("ETag", "etag", "md5Hash", "crc32c", "content_md5", "md5", "CRC")
"""What storages tell of a file's content, without its being read."""

_ARCHIVES = {"zip": (".zip",), "tar": (".tar", ".tar.gz", ".tgz")}


@dataclass(frozen=True, slots=True)
class Listed:
    """A file of a storage."""

    address: str
    """Where it is."""

    size: int | None = None
    """Its bytes, where the listing tells."""

    stamp: str = ""
    """What the storage says of its content, which changes with it; empty where it says nothing."""

    below: str = field(default="", compare=False)
    """Its path below what was listed; empty for that itself."""


def photos_at(address: str) -> Iterator[Listed]:
    """The photos at an address, folder by folder and by name.

    What ends like a photo is one, and nothing is asked about it. All else is a folder, in which
    names that end like photos count and hidden ones do not, as deep as it goes.

    Raises:
        StorageError: It holds no photo, is missing, or cannot be listed.
    """
    file_system(address)  # nothing knows it, perhaps
    if is_photo(address.partition("::")[0]):
        yield Listed(address)
        return
    some = False
    for own, one in files_at(address):
        if is_photo(own):
            some = True
            yield replace(one, below=own)
    if not some:
        raise StorageError(f"{address} holds no photograph.")


def files_at(address: str) -> Iterator[tuple[str, Listed]]:
    """All files below an address but for hidden ones, each with its path from there.

    A file itself has an empty path.

    Raises:
        StorageError: It is missing, or cannot be listed.
    """
    _refuse_archive(address)
    found, path = file_system(address)
    for name, about in files_below(found, path, address):
        own = name.strip("/").removeprefix(path.strip("/")).strip("/")
        yield own, Listed(address_of(found, name, address), _size(about), stamp_of(about))


def files_below(found: Any, path: str, address: str) -> Iterator[tuple[str, Mapping[str, Any]]]:  # noqa: ANN401
    """Names of all files below a path but for hidden ones, and what the storage says of each.

    Listed alone, a file is below itself; an empty one is what some storages put for a folder.

    Raises:
        StorageError: It is missing, or cannot be listed.
    """
    folders = [path]
    while folders:
        place = folders.pop()
        found.invalidate_cache()  # an earlier listing may be of other files, and takes a kB a file
        # Not fsspec's walk, which passes over folders that may not be read.
        listed = persistent(partial(found.ls, place, detail=True), address, "listed")
        inside = sorted(listed, key=lambda about: str(about["name"]))
        deeper = []
        for about in inside:
            name = str(about["name"]).rstrip("/")
            itself = name.strip("/") == place.strip("/")
            alone = about["type"] == "file" and len(inside) == 1 and about.get("size")
            if _is_hidden(name) or (itself and not alone):
                continue
            if about["type"] == "directory":
                deeper.append(str(about["name"]))  # web servers tell folders by the slash
            else:
                yield name, about
        folders += reversed(deeper)


def _refuse_archive(address: str) -> None:
    """Say how an archive is named where it is named as a file.

    Raises:
        StorageError: It is.
    """
    last = address.partition("::")[0].partition("?")[0].lower()
    kind = next((kind for kind, endings in _ARCHIVES.items() if last.endswith(endings)), None)
    if kind:
        raise StorageError(f"{address} is an archive; what is in it is {kind}://::{address}.")


def _is_hidden(name: str) -> bool:
    return posixpath.basename(name).startswith(".")


def is_photo(name: str) -> bool:
    """Whether an address, or a path in a storage, ends like a photo."""
    last = name.split("?", 1)[0].rsplit("/", 1)[-1]
    return posixpath.splitext(last)[1].lower() in PHOTO_SUFFIXES


def _size(about: Mapping[str, object]) -> int | None:
    size = about.get("size")
    return size if isinstance(size, int) else None


def stamp_of(about: Mapping[str, object]) -> str:
    """What is told of the content; an empty text rather than a time, which says little."""
    return next((f"{name} {about[name]}" for name in _STAMPS if about.get(name)), "")
