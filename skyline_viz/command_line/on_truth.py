"""What commands have in common that test methods on photos with truth: options, and first steps."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from skyline_viz import running
from skyline_viz.command_line.folds import FoldOptions, Folds
from skyline_viz.command_line.inputs import output_folder, with_truth
from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.settings import ClusterAddress
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.command_line.truth_options import TruthOptions, Truths
from skyline_viz.system.memory import DETECTING, MAX_MEGAPIXELS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from skyline_viz.datasets import Dataset, DatasetItem
    from skyline_viz.running import Kept


@dataclass(frozen=True)
class OnTruth:
    """Options of a command that tests methods on photos with truth."""

    dataset: Annotated[str, tyro.conf.Positional, tyro.conf.arg(metavar="DATASET")]
    """Folder or address of a data set with truths, in a published layout or plain; or a table of
    labels, FILE.parquet."""

    folds: FoldOptions = field(default_factory=Folds)
    """Whether photos are cross-validated, and how they are dealt into folds."""

    methods: MethodOptions = field(default_factory=Methods)
    """What is tested; the detector with the settings below unless given."""

    truths: TruthOptions = field(default_factory=Truths)
    """How to read masks that leave a choice."""

    seed: int = 0
    """Seed of the negative samples in a cross-validation."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos, their size and the free memory."""

    cluster: ClusterAddress = None
    """Work on a cluster instead: tcp://HOST:PORT, the address of a dask scheduler, or local:N for
    one of N processes on this machine. Its machines share the folders of photos and of --out."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def open(self) -> tuple[Dataset, list[DatasetItem]]:
        """The data set, and its photos that have a truth.

        Raises:
            UsageError: Options contradict each other, or no photo has a truth.
            DatasetError: The folder is no data set.
        """
        if self.seed < 0:
            raise UsageError(f"a seed is 0 or more, not {self.seed}.")
        if self.seed and not self.folds.asked:
            raise UsageError("--seed is that of a cross-validation, and --folds asks for none.")
        dataset = self.truths.open(self.dataset)
        return dataset, with_truth(dataset)

    def begin(
        self,
        command: str,
        dataset: Dataset,
        items: Sequence[DatasetItem],
        out: Path | None,
        bytes_a_pixel: int = DETECTING,
    ) -> tuple[int, Kept]:
        """Make the folder of outputs; return the number of processes, and what an earlier run kept.

        Args:
            command: Its name.
            dataset: The data set.
            items: Its photos to work on.
            out: The folder, or None.
            bytes_a_pixel: What the work takes, see `skyline_viz.system.memory`.

        Raises:
            UsageError: The folder cannot be made, or is one of photos.
        """
        if out:
            output_folder(out, dataset)
        workers = self.workers
        if self.cluster is None:
            workers = foresee(items, workers, bytes_a_pixel)
        return workers, running.Kept.within(out, command)
