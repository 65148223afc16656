"""``skyline-viz join``: the shards of a table as one file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from skyline_viz.command_line.messages import GOOD, UsageError, counted, tell


@dataclass(frozen=True)
class Join:
    """Make one table of the shards that several runs of detect wrote.

    Examples:
        skyline-viz join shards --out all.parquet
        skyline-viz join /mnt/results/alps --out alps.parquet
        skyline-viz join . --out ../all.parquet
    """

    folder: Annotated[
        Path, tyro.conf.Positional, tyro.conf.arg(metavar="DIR", help_behavior_hint="(required)")
    ]
    """Folder of all shards, the --out of the runs with --shard."""

    out: Annotated[Path, tyro.conf.arg(metavar="FILE.parquet")]
    """File for the table; a file that is there is replaced."""

    def run(self) -> int:
        """Join the shards; return the exit status."""
        from skyline_viz.running.line_table import SUFFIX
        from skyline_viz.running.shards import join

        if not self.folder.is_dir():
            raise UsageError(f"{self.folder} is no folder of shards.")
        if self.out.suffix.lower() != SUFFIX or self.out.is_dir():
            raise UsageError(f"name a file that ends in {SUFFIX} for the table, not {self.out}.")
        tell(f"{counted(join(self.folder, self.out), 'photo')} in {self.out}")
        return GOOD
