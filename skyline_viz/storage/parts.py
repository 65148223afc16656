"""What in an address names the file, and what leads to it."""

from __future__ import annotations

from inspect import signature

from skyline_viz.storage.addresses import StorageError, needed, scheme

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
