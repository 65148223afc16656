"""A photo to work on, under a name that no other one has."""

from __future__ import annotations

from dataclasses import dataclass

from skyline_viz.datasets.dataset import DatasetItem


@dataclass(frozen=True)
class NamedItem:
    """A photo to work on."""

    name: str
    """What its outputs are called: unique among them, and fit for a file name."""

    item: DatasetItem
    """The photo, and its truth where there is one."""
