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
from skyline_viz.storage.parts import file_part, refuse_odd_chain

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

    fault: str = ""
    """Why no address leads to it, in a sentence; empty where one does."""


def photos_at(address: str) -> Iterator[Listed]:
    """The photos at an address, folder by folder and by name.

    What ends like a photo is one, and nothing is asked about it. All else is a folder, in which
    names that end like photos count and hidden ones do not, as deep as it goes.

    Raises:
        StorageError: It holds no photo, is missing, or cannot be listed.
    """
    file_system(address)  # nothing knows it, perhaps
    refuse_odd_chain(address)
    if is_photo(file_part(address)):
        yield Listed(address)
        return
    some = False
    for own, one in files_at(address):
        if is_photo(own if one.fault else file_part(one.address)):
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
    refuse_odd_chain(address)
    found, path = file_system(address)
    for name, about in files_below(found, path, address):
        own = name.strip("/").removeprefix(path.strip("/")).removeprefix("/")
        whole = address_of(found, name, address)
        fault = _fault(found, name, whole)
        yield own, Listed(whole, _size(about), stamp_of(about), fault=fault)


def files_below(found: Any, path: str, address: str) -> Iterator[tuple[str, Mapping[str, Any]]]:  # noqa: ANN401
    """Names of all files below a path but for hidden ones, and what the storage says of each.

    Listed alone, a file is below itself; an empty one is what some storages put for a folder.

    Raises:
        StorageError: It is missing, or cannot be listed.
    """
    folders, seen = [path], set[str]()
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
            if itself and about["type"] == "directory" and hasattr(found, "split_path"):
                yield from _below_nameless(found, place, address)
            if _is_hidden(found, name) or (itself and not alone):
                continue
            if about["type"] == "directory":
                deeper.append(str(about["name"]))  # web servers tell folders by the slash
            else:
                if _members(found):
                    seen.add(name)
                yield name, about
        folders += reversed(deeper)
    # Of archives no listing of a folder shows ``./a.jpg``, or ``a//b.jpg``.
    start = f"{path.strip('/')}/".lstrip("/")
    for name, about in sorted(_members(found).items()):
        if name in seen or about["type"] != "file" or not name.startswith(start):
            continue
        if not any(_is_hidden(found, one) for one in name.removeprefix(start).split("/")):
            yield name, about


def _members(found: Any) -> Mapping[str, Any]:  # noqa: ANN401 - file systems have no types
    """All that an archive holds, when it has been listed; nothing of other storages."""
    return getattr(found, "dir_cache", None) or {}


def _below_nameless(found: Any, place: str, address: str) -> Iterator[tuple[str, Any]]:  # noqa: ANN401
    """Files of a bucket in folders without a name, ``place//``, which cannot be listed by that.

    Raises:
        StorageError: They cannot be listed.
    """
    start = place.rstrip("/")
    listed = persistent(partial(found.find, start, detail=True, prefix="/"), address, "listed")
    for name, about in sorted(listed.items()):
        below = name.removeprefix(start)
        if below.startswith("//") and not any(_is_hidden(found, one) for one in below.split("/")):
            yield name, about


def _has_keys(found: Any) -> bool:  # noqa: ANN401 - file systems have no types
    """Whether any text may be the name of a file, as in buckets and archives."""
    return hasattr(found, "split_path") or hasattr(found, "dir_cache")


def _fault(found: Any, name: str, address: str) -> str:  # noqa: ANN401
    """Why no address leads to a file, in a sentence; empty where one does."""
    if "::" in name:
        return f"{address} cannot be downloaded: a name that holds :: has no address."
    if hasattr(found, "split_path") and "/".join(found.split_path(name)[:2]) != name:
        return f"{address} cannot be downloaded: its address means another file."
    return ""


def _refuse_archive(address: str) -> None:
    """Say how an archive is named where it is named as a file.

    Raises:
        StorageError: It is.
    """
    last = file_part(address).lower()
    kind = next((kind for kind, endings in _ARCHIVES.items() if last.endswith(endings)), None)
    if kind:
        raise StorageError(f"{address} is an archive; what is in it is {kind}://::{address}.")


def _is_hidden(found: Any, name: str) -> bool:  # noqa: ANN401 - file systems have no types
    last = posixpath.basename(name)
    return last.startswith(".") and not (last in (".", "..") and _has_keys(found))


def is_photo(name: str) -> bool:
    """Whether a path in a storage, or an address as `file_part` gives it, ends like a photo."""
    last = name.rsplit("/", 1)[-1]
    return posixpath.splitext(last)[1].lower() in PHOTO_SUFFIXES


def _size(about: Mapping[str, object]) -> int | None:
    size = about.get("size")
    return size if isinstance(size, int) else None


def stamp_of(about: Mapping[str, object]) -> str:
    """What is told of the content; an empty text rather than a time, which says little."""
    return next((f"{name} {about[name]}" for name in _STAMPS if about.get(name)), "")
