"""What a command line names by a path or an address, as a file or folder of this machine."""

from __future__ import annotations

from pathlib import Path

from skyline_viz.running.progress import ProgressBar
from skyline_viz.storage.addresses import is_address
from skyline_viz.storage.copies import copied


def local(place: str | Path) -> Path:
    """A path as it is; of an address a copy, which is brought up to date and shows its progress.

    Raises:
        StorageError: The address leads nowhere, or cannot be copied.
    """
    return copied(str(place), ProgressBar) if is_address(place) else Path(place)
