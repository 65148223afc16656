"""What in an address names the file, and what leads to it."""

from __future__ import annotations

from inspect import signature
from pathlib import Path

from skyline_viz.storage.addresses import StorageError, file_system, is_address, needed, scheme

WEB = ("http://", "https://")
"""Addresses of web servers, the only ones that have queries."""

_VERSION, _VERSIONED = "?versionId=", ("s3://", "s3a://")
_AROUND = {"fo", "target_protocol"}  # what takes a file of another storage says so


def file_part(address: str) -> str:
    """An address without the archives around the file, the query of a web server, or a version.

    >>> file_part("https://host/a.jpg?raw=1"), file_part("zip://q?.jpg::https://host/b.zip?raw=1")
    ('https://host/a.jpg', 'zip://q?.jpg')
    """
    inner = address.partition("::")[0]
    if scheme(inner) in WEB:
        return inner.partition("?")[0]
    return inner.partition(_VERSION)[0] if scheme(inner) in _VERSIONED else inner


def is_within(inner: str, outer: str) -> bool:
    """Whether a path or an address leads below another one, or to it.

    >>> is_within("s3://b/t.parquet/all.parquet", "s3://b/t.parquet/"), is_within("a/b", "c")
    (True, False)
    """
    within, folder = _place(inner), _place(outer)
    return within[: len(folder)] == folder


def _place(text: str) -> tuple[str, ...]:
    """What leads to a path or an address, part by part, however it is spelt."""
    if is_address(text):
        found, path = file_system(text)
        names = (found.protocol,) if isinstance(found.protocol, str) else tuple(found.protocol)
        if "file" not in names:
            _, chain, around = text.partition("::")
            return (names[0], chain + around, *filter(None, path.split("/")))
        text = path
    return ("file", "", *Path(text).resolve().parts)


def refuse_odd_chain(address: str) -> None:
    """Refuse what holds ``::`` and does not begin with what reads from another storage.

    Raises:
        StorageError: It is such an address, or fsspec is not installed.
    """
    if "::" not in address:
        return
    fsspec = needed("fsspec", scheme(address))
    try:
        kind = fsspec.get_filesystem_class(scheme(address).rstrip(":/"))
    except (ImportError, ValueError):  # whoever opens it says so
        return
    taken = {name for one in kind.__mro__ for name in signature(one.__init__).parameters}
    if not taken & _AROUND:
        raise StorageError(
            f"{address} cannot be read: what stands before :: is no archive, and a name that "
            f"holds :: has no address."
        )
