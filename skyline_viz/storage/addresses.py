"""What an address is, and the file system behind it.

An address has a scheme: ``s3://bucket/key``, ``gs://bucket/key``, ``https://host/photo.jpg``,
``zip://folder::s3://bucket/archive.zip``, and whatever else fsspec knows. Everything without one is
a path. Credentials and servers are those that the environment gives to the library of the storage.
"""

from __future__ import annotations

import logging
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from types import MethodType
from typing import Any

EXTRA = "cluster"
"""The extra that brings the libraries."""

_SCHEME = re.compile(r"([a-z][a-z0-9+.-]+)(://|::)", re.ASCII)
_OURS = ("aiohttp", "gcsfs", "s3fs")
_NAMED = re.compile(r"[Ii]nstall (?:the )?['\"]?([\w-]+)|requires \"([\w-]+)\"")
_OTHERWISE = {"libarchive": "libarchive-c"}  # packages that are not called like their module
_LASTING = (
    FileNotFoundError,
    IsADirectoryError,
    NotADirectoryError,
    NotImplementedError,
    PermissionError,
)
_GONE, _FORBIDDEN = (404, 410), (401, 403)  # statuses of HTTP
_GOOGLE_TRIES = 2  # a second or two between them
_UNHEARD = logging.NullHandler()  # others that a program has set hear all
_PASSING = (408, 425, 429)  # of those that blame the one who asks


class StorageError(ValueError):
    """An address leads nowhere; the message is one sentence that names it and the reason."""


class UnseenError(StorageError):
    """Nothing can be said of what is there now: an outage, or no permission."""


def is_address(text: str | os.PathLike[str]) -> bool:
    """Whether a text is an address, and not a path.

    >>> is_address("s3://photos/alps"), is_address("photos/alps"), is_address("C:/photos")
    (True, False, False)
    """
    return isinstance(text, str) and _SCHEME.match(text) is not None


def needed(module: str, what: str) -> Any:  # noqa: ANN401 - a module's names are not known here
    """A module of the extra.

    Args:
        module: What is imported.
        what: What needs it, for the sentence.

    Raises:
        StorageError: The package is not installed.
    """
    try:
        return import_module(module)
    except ImportError as error:
        package = (error.name or module).split(".", maxsplit=1)[0]
        raise StorageError(
            f"{what} needs {package}; install it with: pip install 'skyline-viz[{EXTRA}]'"
        ) from error


def file_system(address: str) -> tuple[Any, str]:
    """The file system of an address, and the path in it.

    Raises:
        StorageError: Nothing knows the scheme, or what knows it is not installed.
    """
    fsspec = needed("fsspec.core", scheme(address))
    # Else gcsfs asks in another protocol what kind of bucket it is, which has a minute to answer.
    os.environ.setdefault("GCSFS_EXPERIMENTAL_ZB_HNS_SUPPORT", "false")
    try:
        found, path = fsspec.url_to_fs(address)
    except ImportError as error:
        raise StorageError(f"{address} needs {_installed(error)}") from error
    except ValueError as error:
        if "rotocol not known" in str(error):
            unknown = f"{address} cannot be read: nothing knows {scheme(address)}."
            raise StorageError(unknown) from error
        if "range requests" in str(error):
            raise StorageError(
                f"{address} cannot be read: the server gives whole files alone; download the "
                f"archive first."
            ) from error
        raise StorageError(f"{address} is no address of photos: {plain(error)}.") from error
    except TypeError as error:  # its library wants arguments
        raise StorageError(
            f"{address} cannot be read: {scheme(address)} needs more than an address."
        ) from error
    except IsADirectoryError as error:  # what an archive without a file is taken for
        kind = scheme(address)
        raise StorageError(
            f"{address} names no archive; those are named {kind}::FILE, or {kind}FOLDER::FILE."
        ) from error
    except Exception as error:  # each library has classes of its own
        with naming(address):
            raise error
        raise
    if type(found).__module__.startswith("gcsfs"):
        _bounded(found)
    return found, str(path)


def _bounded(found: Any) -> None:  # noqa: ANN401
    """Have gcsfs ask a few times, where it has six tries for each of ours, and log no traceback.

    It has no setting for either. Tables are read past our own tries, so that some are left.
    """
    logging.getLogger("gcsfs").addHandler(_UNHEARD)
    asking = getattr(type(found)._request, "__wrapped__", None)  # without its tries
    if asking is not None:
        again = needed("gcsfs.retry", "gs://").retry_request(retries=_GOOGLE_TRIES)
        found._request = MethodType(again(asking), found)


def scheme(address: str) -> str:
    """How an address begins.

    >>> scheme("s3://photos/alps")
    's3://'
    """
    found = _SCHEME.match(address)
    return found[0] if found else ""


def address_of(found: Any, path: str, below: str) -> str:  # noqa: ANN401 - file systems have no types
    """The address of a path that a listing gave.

    Args:
        found: The file system.
        path: The path in it.
        below: The address that was listed, whose outer archives and caches go along.
    """
    whole = str(found.unstrip_protocol(path))
    _, chain, around = below.partition("::")
    return f"{whole}{chain}{around}"


@contextmanager
def naming(address: str, done: str = "read") -> Iterator[None]:
    """Turn whatever a storage raises into a sentence about an address, and what was to be done."""
    try:
        yield
    except StorageError:
        raise
    except Exception as error:  # each library has classes of its own
        status = _status(error)
        if isinstance(error, FileNotFoundError) or status in _GONE:
            raise StorageError(f"{address} does not exist.") from error
        if isinstance(error, PermissionError) or status in _FORBIDDEN:
            raise UnseenError(f"{address} may not be {done}.") from error
        raise UnseenError(f"{address} cannot be {done}: {plain(error)}.") from error


def lasts(error: Exception) -> bool:
    """Whether a storage will say the same when it is asked again."""
    if isinstance(error, _LASTING) or "Credentials" in type(error).__name__:
        return True
    status = _status(error)
    return 400 <= status < 500 and status not in _PASSING


def plain(error: BaseException) -> str:
    """What a library said, on one line, short and without its names for things."""
    said = str(error)
    if type(error).__name__ == "TooManyRedirects":
        said = "it leads from place to place"
    elif isinstance(getattr(error, "status", None), int):
        said = f"{_status(error)} {getattr(error, 'message', '')}"
    text = " ".join(said.split()) or type(error).__name__
    text = re.sub(r"^An error occurred \((\w+)\).*?: *", r"\1, ", text)
    text = re.sub(r"<\w+: \d+, message='(.*?)'>", r"\1", text)
    text = re.sub(r" ssl:\S+ \[(.*)\]$", r", \1", text)
    return text.rstrip(". ")[:200]


def _status(error: BaseException) -> int:
    """The status of HTTP that a library tells of, each in its way, or 0."""
    told = getattr(error, "status" if hasattr(error, "status") else "code", None)
    if isinstance(told, int):
        return told
    return 403 if str(error).startswith("Forbidden") else 0


def _installed(error: ImportError) -> str:
    """The package that is missing, which fsspec says in a sentence, and how to get it."""
    said = _NAMED.search(str(error))
    module = (said[1] or said[2]) if said else getattr(error.__cause__ or error, "name", None)
    package = _OTHERWISE.get(module, module) if module else "a library that is not installed"
    ours = next((one for one in _OURS if one in str(error)), None)
    if ours:
        return f"{ours}; install it with: pip install 'skyline-viz[{EXTRA}]'"
    return f"{package}; install it with: pip install {package}"
