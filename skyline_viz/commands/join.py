"""``skyline-viz join``: the shards of a table as one file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from skyline_viz.command_line.local import local
from skyline_viz.command_line.messages import GOOD, UsageError, counted, tell
from skyline_viz.storage.copies import lost_in


@dataclass(frozen=True)
class Join:
    """Make one table of the shards of detect, or one detector of those of train.

    Examples:
        skyline-viz join shards --out all.parquet
        skyline-viz join bank-shards --out bank.npz
        skyline-viz join s3://results/lines.parquet --out s3://results/all.parquet
    """

    folder: Annotated[
        str, tyro.conf.Positional, tyro.conf.arg(metavar="DIR", help_behavior_hint="(required)")
    ]
    """Folder or address of all shards, the --out of the runs with --shard."""

    out: Annotated[str, tyro.conf.arg(metavar="FILE")]
    """FILE.parquet for the table, a path or an address; or FILE.npz for the detector, a path. What
    is there is replaced."""

    def run(self) -> int:
        """Join the shards; return the exit status."""
        from skyline_viz.command_line.to_table import table_at
        from skyline_viz.running.line_table import SUFFIX
        from skyline_viz.running.shards import join
        from skyline_viz.storage.addresses import is_address
        from skyline_viz.storage.parts import is_within

        remote, out, folder = is_address(self.out), Path(self.out), local(self.folder)
        if not folder.is_dir():
            raise UsageError(f"{self.folder} is no folder of shards.")
        if lost := lost_in(folder):
            raise UsageError(next(iter(lost.values())))
        if is_within(self.out, self.folder):
            raise UsageError(
                f"{self.out} is the folder of the shards or lies in it, and that is to hold shards "
                f"alone; name another --out."
            )
        if out.suffix.lower() == ".npz" and not remote and not out.is_dir():
            return self._train(folder)
        if out.suffix.lower() != SUFFIX or out.is_dir():
            raise UsageError(
                f"name a file that ends in {SUFFIX} for a table, or in .npz for a detector, not "
                f"{self.out}."
            )
        with table_at(self.out, None) as table:
            photos = join(folder, table)
        tell(f"{counted(photos, 'photo')} in {self.out}")
        return GOOD

    def _train(self, folder: Path) -> int:
        """Solve what shards of a training have gathered."""
        from skyline_viz.commands.train import save_trained
        from skyline_viz.detector import Detector
        from skyline_viz.evaluation.training_runs import solve_several
        from skyline_viz.methods.registry import find_method
        from skyline_viz.running.gram_shards import joined

        found = joined(folder)
        method = find_method(found.method)
        if not isinstance(method, Detector):
            raise UsageError(f"the shards of {self.folder} are of no detector of ours.")
        bank = solve_several(found.sets, found.training, found.seed)
        save_trained(Path(self.out), method, bank, found.photos, found.training)
        return GOOD
