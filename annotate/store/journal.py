"""The journal beside a file of labels: whether all that was kept in it is still read.

SQLite adds changed pages to a journal (``-wal``), as frames that each carry the two salts of the
journal and a checksum over all before them. It reads up to the first frame that does not fit, and
says nothing of what follows. Frames with other salts are left from before the journal was begun
anew, and are no damage. Neither is a last frame that is torn, as after a power failure, because
nothing was called saved on it. A frame that does not fit, with frames of this journal behind it, is
damage; and so is a journal with fewer frames than its index (``-shm``) says were on the disk.
"""

from __future__ import annotations

import shutil
import struct
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

_MAGIC = {0x377F0682: "<u4", 0x377F0683: ">u4"}
_HEADER, _FRAME = 32, 24  # bytes
_ENDS = ("", "-wal", "-journal")
_TRIES = 3  # of reading a journal that somebody may be writing
_Words: TypeAlias = npt.NDArray[np.uint32]


@dataclass(frozen=True, eq=False)
class _Frames:
    """Frames of a journal, as SQLite would check them."""

    numbers: npt.NDArray[np.int64]
    """``(N,)`` of the pages that they hold."""

    commits: npt.NDArray[np.int64]
    """``(N,)`` pages of the file after the transaction that ends here; 0 where none ends."""

    ours: npt.NDArray[np.bool_]
    """``(N,)`` whether they have the salts of the journal."""

    sound: npt.NDArray[np.bool_]
    """``(N,)`` whether they have also the right checksum, given that of the frame before."""

    pages: npt.NDArray[np.uint8]
    """``(N, page size)``."""

    salts: bytes

    @property
    def read(self) -> int:
        """How many SQLite reads."""
        bad = np.flatnonzero(~self.sound)
        return int(bad[0]) if len(bad) else len(self.sound)

    @property
    def last(self) -> int:
        """How many there are up to the last one of this journal."""
        ours = np.flatnonzero(self.ours)
        return int(ours[-1]) + 1 if len(ours) else 0


def fault(path: Path) -> str:
    """What is wrong with the journal of a file of labels, in words; empty where nothing is.

    Args:
        path: The file of labels.

    Raises:
        OSError: The journal cannot be read.
    """
    said = ""
    for _ in range(_TRIES):  # while somebody writes it, a frame is half there for a moment
        before, said = said, _fault(path)
        if said == before:
            break
    return said


def replay(path: Path, copy: Path) -> bool:
    """Copy a file of labels and its journal; pages behind damage in the journal count as well.

    They are written into the copy then, which may hold older pages beside them, and has no journal.

    Returns:
        Whether the journal is damaged, so that changes may be missing.

    Raises:
        OSError: They cannot be read, or the copy cannot be written.
    """
    damaged = fault(path)
    for end in _ENDS:
        file = path.with_name(path.name + end)
        if file.exists() and not (damaged and end == "-wal"):
            shutil.copyfile(file, copy.with_name(copy.name + end))
    content = _beside(path, "-wal") if damaged else b""
    frames = _frames(content) or _headless(content)
    if frames is None:
        return bool(damaged)
    size = frames.pages.shape[1]
    ends = np.flatnonzero(frames.sound & (frames.commits > 0))
    with copy.open("r+b") as target:
        for at in np.flatnonzero(frames.sound[: ends[-1] + 1] if len(ends) else []):
            target.seek((int(frames.numbers[at]) - 1) * size)
            target.write(frames.pages[at].tobytes())
        if len(ends):
            target.truncate(int(frames.commits[ends[-1]]) * size)
    return True


def _fault(path: Path) -> str:
    known = _indexed(_beside(path, "-shm"))  # read first: meanwhile the journal can only grow
    content = _beside(path, "-wal")
    frames = _frames(content)
    if frames is None:
        if len(content) > _HEADER:
            return "is damaged at its beginning, and nothing in it is read"
        if known and known[0] > known[1]:
            return "is missing or cut off, and what was kept in it is not read"
        return ""
    last = frames.last
    if known and known[2] == frames.salts:
        last = max(last, known[0])
    elif last == frames.read + 1:
        return ""  # torn, and nothing was called saved on it
    if last <= frames.read:
        return ""
    return f"is damaged at frame {frames.read + 1} of {last}, and nothing from there on is read"


def _beside(path: Path, end: str) -> bytes:
    try:
        return path.with_name(path.name + end).read_bytes()
    except FileNotFoundError:
        return b""


def _indexed(content: bytes) -> tuple[int, int, bytes] | None:
    """Frames that were on the disk, how many of them are in the file of labels, and the salts."""
    if len(content) < 100 or content[:48] != content[48:96] or not content[12]:
        return None
    order = "<" if sys.byteorder == "little" else ">"
    frames, done = (
        struct.unpack_from(f"{order}I", content, 16),
        struct.unpack_from(f"{order}I", content, 96),
    )
    return frames[0], done[0], content[32:40]


def _frames(content: bytes) -> _Frames | None:
    """Frames of a journal; None where it has no sound beginning."""
    if len(content) < _HEADER:
        return None
    magic, _, size = struct.unpack_from(">3I", content)
    order = _MAGIC.get(magic)
    if order is None or not 512 <= size <= 65536 or size & (size - 1):
        return None
    words = np.frombuffer(content, order, 6).astype(np.uint32)
    zero = np.zeros((1, 2), np.uint32)
    if not (_summed(words[None], zero) == np.frombuffer(content, ">u4", 2, 24)).all():
        return None
    return _checked(content, order, size)


def _headless(content: bytes) -> _Frames | None:
    """Frames of a journal whose beginning is damaged, by their own salts; None where none is sound.

    The first one is lost, whose checksum depends on the beginning.
    """
    best = None
    for order in _MAGIC.values():
        for size in (2**power for power in range(9, 17)):
            salts = content[_HEADER + _FRAME + size :][8:16]  # of the second frame
            if len(salts) < 8:
                continue
            frames = _checked(content[:16] + salts + content[24:], order, size)
            if frames.sound.any() and (best is None or frames.sound.sum() > best.sound.sum()):
                best = frames
    return best


def _checked(content: bytes, order: str, size: int) -> _Frames:
    """Frames with pages of a size, checked."""
    count = max(len(content) - _HEADER, 0) // (_FRAME + size)
    whole = np.frombuffer(content, np.uint8, count * (_FRAME + size), _HEADER)
    whole = whole.reshape(count, _FRAME + size)
    heads = np.ascontiguousarray(whole[:, :_FRAME]).view(">u4")
    first = np.frombuffer(content, ">u4", 2, 24).astype(np.uint32)[None]
    before = np.concatenate([first, heads[:, 4:].astype(np.uint32)])[:count]
    summed = np.ascontiguousarray(np.hstack([whole[:, :8], whole[:, _FRAME:]])).view(order)
    ours = (heads[:, 2:4] == np.frombuffer(content, ">u4", 2, 16)).all(axis=1)
    right = (_summed(summed.astype(np.uint32), before) == heads[:, 4:]).all(axis=1)
    return _Frames(
        numbers=heads[:, 0].astype(np.int64),
        commits=heads[:, 1].astype(np.int64),
        ours=ours,
        sound=ours & right & (heads[:, 0] > 0),
        pages=whole[:, _FRAME:],
        salts=content[16:24],
    )


def _summed(words: _Words, before: _Words) -> _Words:
    """Checksums ``(N, 2)`` of words ``(N, K)``, begun with those ``(N, 2)`` of what came before."""
    one, other = before[:, 0].copy(), before[:, 1].copy()
    for at in range(0, words.shape[1], 2):
        one += words[:, at] + other
        other += words[:, at + 1] + one
    return np.stack([one, other], axis=1)
