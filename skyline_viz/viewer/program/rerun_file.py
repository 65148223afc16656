"""Writing what Rerun records to a file ourselves, so that a full disk is an error like any other.

Rerun writes in a thread of its own. When the disk is full, that thread keeps it to itself, and the
program that waits for it may wait for ever. So Rerun writes into a pipe, which is never full for
long, and what comes out is written here.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import rerun as rr

from skyline_viz.system.aftermath import passing_folder

_PART = 1 << 18  # bytes that are written at a time


@contextmanager
def saved(recording: rr.RecordingStream, path: Path) -> Iterator[None]:
    """Save what is logged in the block, and complete the file at its end.

    Args:
        recording: The recording; it is disconnected after the block.
        path: The file, which exists.

    Raises:
        OSError: It cannot be written.
    """
    if not hasattr(os, "mkfifo"):  # on Windows Rerun writes by itself
        recording.save(path)
        try:
            yield
        finally:
            recording.disconnect()
        return
    with passing_folder() as folder:
        pipe = folder / "recording.rrd"
        os.mkfifo(pipe)
        reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)  # before Rerun opens the other end
        copying = _Copying(reader, path)
        try:
            recording.save(pipe)
            os.set_blocking(reader, True)
            copying.start()
            yield
        finally:
            recording.disconnect()  # writes the footer, without which the file is not whole
            if copying.is_alive():
                copying.join()
            os.close(reader)
    if copying.error:
        raise copying.error


class _Copying(threading.Thread):
    """Writes what comes out of a pipe into a file, and swallows it once that fails."""

    def __init__(self, reader: int, path: Path) -> None:
        super().__init__(name="recording", daemon=True)
        self._reader, self._path = reader, path
        self.error: OSError | None = None

    def run(self) -> None:
        """Copy until the other end is closed."""
        try:
            with self._path.open("wb", buffering=0) as file:
                while part := os.read(self._reader, _PART):
                    whole = memoryview(part)
                    while whole:
                        whole = whole[file.write(whole) :]
        except OSError as error:
            self.error = error
            while os.read(self._reader, _PART):  # so that Rerun never waits
                pass
