"""What a command line names by a path or an address, as a file or folder of this machine."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path

from skyline_viz.command_line.messages import UsageError
from skyline_viz.running.progress import ProgressBar
from skyline_viz.storage.addresses import is_address
from skyline_viz.storage.copies import copied
from skyline_viz.storage.copy_names import name_of

_ADDRESS = re.compile(r"([a-z][a-z0-9+.-]+):(?:[/\\\\]|:)+", re.ASCII)  # as a path spells it


def local(place: str | Path) -> Path:
    """A path as it is; of an address a copy, which is brought up to date and shows its progress.

    Raises:
        StorageError: The address leads nowhere, or cannot be copied.
    """
    return copied(str(place), ProgressBar) if is_address(place) else Path(place)


def called(place: str) -> str:
    """The last name in a path or an address.

    >>> called("photos/hills"), called("zip://::s3://datasets/hills.zip")
    ('hills', 'hills')
    """
    return name_of(place) if is_address(place) else Path(place).resolve().name


def spelt_as_address(path: Path) -> str:
    """The address that was given for a path; empty where it was one.

    >>> spelt_as_address(Path("s3://photos/alps")), spelt_as_address(Path("photos/alps"))
    ('s3://photos/alps', '')
    """
    text = os.fspath(path)
    found = _ADDRESS.match(text)
    if not found or path.exists():
        return ""
    return f"{found[1]}://{text[found.end() :]}"


def refuse_addresses(command: object) -> None:
    """Refuse addresses where a command takes paths of this machine.

    Raises:
        UsageError: There is one.
    """
    for name, path in _paths(command):
        if address := spelt_as_address(path):
            raise no_path(address, name.replace("_", "-"))


def no_path(address: str, option: str) -> UsageError:
    """What is said of an address where an option takes a path."""
    return UsageError(
        f"{address} is an address, and --{option} takes a path of this machine; copy from there "
        f"or to there, with aws s3 cp or the like."
    )


def _paths(options: object) -> Iterator[tuple[str, Path]]:
    """All paths among the options of a command, with their names."""
    if not is_dataclass(options):
        return
    for one in fields(options):
        value = getattr(options, one.name)
        if isinstance(value, Path):
            yield one.name, value
        else:
            yield from _paths(value)
