"""The options that say how to read truths whose masks leave a choice."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import tyro

if TYPE_CHECKING:
    from skyline_viz.datasets.dataset import Dataset

Value: TypeAlias = Annotated[str | None, tyro.conf.arg(metavar="VALUE")]


@dataclass(frozen=True)
class Truths:
    """Which value of a mask is which."""

    sky: Value = None
    """What is sky in masks: a grey level, palette index, colour, transparent or opaque; several
    with commas between. Told by the masks unless given."""

    terrain: Value = None
    """What is terrain in masks, instead of --sky."""

    def __post_init__(self) -> None:
        """Refuse both at once."""
        if self.sky is not None and self.terrain is not None:
            raise ValueError("--sky and --terrain exclude each other: what is not one is the other")

    def open(self, folder: str | Path) -> Dataset:
        """Open a data set, a folder, an address or a table, whose truths are read in this way.

        Raises:
            StorageError: The address leads nowhere, or cannot be copied.
            DatasetError: As `skyline_viz.open_dataset`.
        """
        from skyline_viz.command_line.local import local
        from skyline_viz.datasets.layouts import open_dataset
        from skyline_viz.datasets.tables.parquet_files import is_label_table

        place = folder if is_label_table(folder) else local(folder)
        return open_dataset(place, sky=self.sky, terrain=self.terrain)

    def open_all(self, folder: str | Path) -> list[Dataset]:
        """Open the data sets of a folder, where it holds several; or a table.

        Raises:
            DatasetError: As `skyline_viz.datasets.layouts.open_datasets`.
        """
        from skyline_viz.datasets.layouts import open_datasets

        return open_datasets(folder, sky=self.sky, terrain=self.terrain)


TruthOptions: TypeAlias = Annotated[Truths, tyro.conf.arg(name="")]
"""`Truths` without a prefix of their own."""
