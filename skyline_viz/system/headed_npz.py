"""Files of arrays with a JSON header: writing them, and reading what may be made to do damage.

Filter banks, detectors and trained methods are such files: a ZIP of arrays, an ``.npz`` of NumPy,
of which ``header`` holds JSON. It begins with `FORMAT` and `VERSION`; what it says besides is up
to whoever writes it:

============  ============================================================================
``bank``      bins and provenance of a filter bank, whose arrays are in the file
``method``    what detects with the settings: ``filters`` for our detector, or a name
``settings``  the settings, by name
``label``     what it is called, where that is not told by method and settings
``trained``   what a method was trained on; a bank has its provenance
============  ============================================================================

Arrays of further models are called ``MODEL__PART``. Earlier formats had a header each.

`opened` looks at the directory of the ZIP and at the first bytes of each array, which say its type
and shape, before anything else; whoever reads says what is expected, and only then are bytes
unpacked, as many as that takes. Nothing is ever unpickled. What is wrong is one `NpzError`.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
import struct
import tokenize
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from math import prod
from pathlib import Path
from typing import IO, Any

import numpy as np
import numpy.typing as npt

FORMAT, VERSION = "skyline-viz", 2
"""How the header begins: under ``format`` and ``version``."""

MOST_BYTES = 1 << 30
"""Bytes that the arrays of a file may take together; the largest published network takes half."""

_MOST_ARRAYS = 64
_MOST_DIRECTORY = 1 << 16  # bytes
_MOST_HEADER = 1 << 20  # bytes of JSON
_MOST_PREAMBLE = 4096  # bytes that say the type and the shape of an array
_PIECE = 1 << 20
_KINDS = "biuf"
_END = struct.Struct("<4s6xHL4xH")  # the last record of a ZIP: entries, bytes of the directory
_LOCATOR = 20  # bytes before it that are there in archives too large for it
_PREAMBLES = {
    (1, 0): ("<H", np.lib.format.read_array_header_1_0),
    (2, 0): ("<I", np.lib.format.read_array_header_2_0),
}

_DAMAGE = (
    *(OSError, ValueError, TypeError, LookupError, EOFError, RuntimeError, ArithmeticError),
    *(AttributeError, AssertionError, MemoryError, SyntaxError, NotImplementedError),
    *(zipfile.BadZipFile, zipfile.LargeZipFile, zlib.error, struct.error, tokenize.TokenError),
)  # all that zipfile, numpy's parser of types and json have been seen to raise on damaged bytes


class NpzError(ValueError):
    """A file is damaged or holds something else; the message says what, without the file's name."""


@dataclass(frozen=True)
class Stored:
    """An array as the file announces it."""

    dtype: np.dtype[Any]
    """Type of its numbers."""

    shape: tuple[int, ...]
    """Its shape."""

    columns_first: bool
    """Whether it lies column after column, as Fortran does."""

    start: int
    """Bytes before the numbers."""

    @property
    def nbytes(self) -> int:
        """Bytes of its numbers."""
        return prod(self.shape) * self.dtype.itemsize


class HeadedNpz:
    """An open file whose directory has been checked."""

    def __init__(self, archive: zipfile.ZipFile, stored: dict[str, Stored]) -> None:
        self._archive, self._stored = archive, stored
        self.header = self._header()
        """The JSON of the header, an object."""

    @property
    def arrays(self) -> Mapping[str, Stored]:
        """What the file announces besides the header, by name."""
        return {name: one for name, one in self._stored.items() if name != "header"}

    def read(self, name: str) -> npt.NDArray[Any]:
        """Unpack an array.

        Raises:
            NpzError: There is none of that name, or it is damaged.
        """
        if name not in self._stored:
            raise NpzError(f"its {name} is missing")
        one = self._stored[name]
        try:
            flat = np.empty(prod(one.shape), one.dtype)
        except MemoryError:
            raise NpzError(f"its {name} does not fit into memory") from None
        room = flat.view(np.uint8)
        with _damage_told(), self._archive.open(f"{name}.npy") as file:
            file.read(one.start)
            at = 0
            while piece := file.read(_PIECE):  # up to the end, where the checksum is compared
                if at + len(piece) > len(room):
                    raise NpzError(f"its {name} is longer than it says")
                room[at : at + len(piece)] = np.frombuffer(piece, np.uint8)
                at += len(piece)
        if at != len(room):
            raise NpzError(f"its {name} is shorter than it says")
        return flat.reshape(one.shape, order="F" if one.columns_first else "C")

    def _header(self) -> dict[str, Any]:
        one = self._stored.get("header")
        if one is None or one.dtype != np.uint8 or len(one.shape) != 1:
            raise NpzError("it has no header")
        if one.nbytes > _MOST_HEADER:
            raise NpzError(f"its header takes {one.nbytes:,} bytes")
        document = json.loads(self.read("header").tobytes())
        if not isinstance(document, dict):
            raise NpzError("its header is no JSON")
        return document


def write(
    file: IO[bytes], header: Mapping[str, Any], arrays: Mapping[str, npt.NDArray[Any]]
) -> None:
    """Write a file; the same header and arrays give the same bytes.

    Args:
        file: Where to.
        header: What is said besides format and version, as JSON takes it.
        arrays: The arrays, by names that are identifiers.
    """
    said = json.dumps({"format": FORMAT, "version": VERSION, **header}).encode()
    whole = {"header": np.frombuffer(said, np.uint8), **arrays}
    np.savez_compressed(file, **whole)  # type: ignore[arg-type]  # ** reaches allow_pickle


def packed(header: Mapping[str, Any], arrays: Mapping[str, npt.NDArray[Any]]) -> bytes:
    """What `write` writes."""
    file = io.BytesIO()
    write(file, header, arrays)
    return file.getvalue()


def digest(header: Mapping[str, Any], arrays: Mapping[str, npt.NDArray[Any]]) -> str:
    """SHA-256 of what a file says and holds, however it is packed."""
    found = hashlib.sha256(json.dumps(header, sort_keys=True).encode())
    for name, array in sorted(arrays.items()):
        found.update(f"\n{name} {array.dtype.str} {array.shape}\n".encode())
        found.update(np.ascontiguousarray(array).tobytes())
    return found.hexdigest()


@contextmanager
def opened(path: str | os.PathLike[str] | bytes, most: int = MOST_BYTES) -> Iterator[HeadedNpz]:
    """Open a file, and check all that it announces.

    Args:
        path: The file, or its content.
        most: Bytes that its arrays may take in memory together.

    Raises:
        FileNotFoundError: There is none.
        NpzError: It is damaged, too large, or something else; in a sentence without a full stop.
    """
    with ExitStack() as around:
        with _damage_told():
            file: IO[bytes]
            if isinstance(path, bytes):
                file = io.BytesIO(path)
            elif Path(path).is_file():
                file = around.enter_context(Path(path).open("rb"))
            elif Path(path).exists():
                raise NpzError("it is no file")
            else:
                raise FileNotFoundError(2, "No such file or directory", str(path))
            archive = around.enter_context(zipfile.ZipFile(_checked(file)))
            headed = HeadedNpz(archive, _directory(archive, most))
        yield headed


@contextmanager
def _damage_told() -> Iterator[None]:
    """Turn whatever damaged bytes raise into an `NpzError`."""
    try:
        yield
    except (NpzError, FileNotFoundError):
        raise
    except _DAMAGE as error:
        raise NpzError("it is damaged") from error


def _checked(file: IO[bytes]) -> IO[bytes]:
    """The file, if it ends as NumPy ends one, and its directory is small.

    `ZipFile` leaves others open, and reads whole directories, however long they are.
    """
    size = file.seek(0, os.SEEK_END)
    file.seek(max(size - _LOCATOR - _END.size, 0))
    end = file.read()
    if len(end) < _END.size or end[: -_END.size].startswith(b"PK\6\7"):
        raise NpzError("it is no archive of arrays")
    mark, count, length, comment = _END.unpack(end[-_END.size :])
    if mark != b"PK\5\6" or comment:
        raise NpzError("it is no archive of arrays")
    if count > _MOST_ARRAYS or length > _MOST_DIRECTORY:
        raise NpzError(f"it holds {count:,} arrays")
    return file


def _directory(archive: zipfile.ZipFile, most: int) -> dict[str, Stored]:
    members = archive.infolist()
    taken = sum(one.file_size for one in members)
    if taken > most + _MOST_ARRAYS * _MOST_PREAMBLE:
        raise NpzError(f"its arrays take {taken:,} bytes, and {most:,} are the limit")
    stored: dict[str, Stored] = {}
    for member in members:
        name = member.filename.removesuffix(".npy")
        if name == member.filename or not name.isidentifier():
            raise NpzError("it holds something besides arrays")
        if name in stored:
            raise NpzError(f"it holds two arrays called {name}")
        if member.flag_bits & 1 or member.compress_type not in (
            zipfile.ZIP_STORED,
            zipfile.ZIP_DEFLATED,
        ):
            raise NpzError(f"its {name} is encrypted, or packed in an unusual way")
        with archive.open(member) as file:
            stored[name] = _announced(file, name, member.file_size)
    return stored


def _announced(file: IO[bytes], name: str, size: int) -> Stored:
    """What the first bytes of a member of `size` bytes say about its array."""
    version = np.lib.format.read_magic(file)
    if version not in _PREAMBLES:
        raise NpzError(f"its {name} is in a form of another version of NumPy")
    how, parse = _PREAMBLES[version]
    packed = file.read(struct.calcsize(how))
    (length,) = struct.unpack(how, packed)
    if length > _MOST_PREAMBLE:
        raise NpzError(f"its {name} has a description of {length:,} bytes")
    shape, columns_first, dtype = parse(io.BytesIO(packed + file.read(length)))
    # objects would be unpickled; texts, dates and records are nothing that is learned
    if dtype.kind not in _KINDS or dtype.names or dtype.subdtype:
        raise NpzError(f"its {name} holds what is no finite number")
    if not all(isinstance(side, int) and side >= 0 for side in shape):
        raise NpzError(f"its {name} has the shape {shape}")
    start = len(np.lib.format.MAGIC_PREFIX) + 2 + len(packed) + length
    one = Stored(dtype.newbyteorder("="), tuple(shape), columns_first, start)
    if dtype.byteorder not in ("=", "|") and dtype != one.dtype:
        raise NpzError(f"its {name} has its bytes in another order")
    if start + one.nbytes != size:
        raise NpzError(f"its {name} takes {size - start:,} bytes and says {one.nbytes:,}")
    return one
