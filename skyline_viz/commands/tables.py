"""``skyline-viz tables``: the paper's tables, measured, on one page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from skyline_viz import evaluation, methods, running
from skyline_viz.command_line.clusters import on_cluster
from skyline_viz.command_line.inputs import output_folder, with_truth
from skyline_viz.command_line.messages import (
    SOME_FAILED,
    UsageError,
    counted,
    say,
    status_after,
    tell,
    tell_done,
    tell_drawn,
)
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.settings import ClusterAddress, Folder, Switch
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.command_line.truth_options import TruthOptions, Truths
from skyline_viz.files import write_text
from skyline_viz.methods.names import NAMES
from skyline_viz.system.memory import MAX_MEGAPIXELS
from skyline_viz.system.names import listed

if TYPE_CHECKING:
    from skyline_viz.datasets import DatasetItem
    from skyline_viz.evaluation import Evaluation, Table
    from skyline_viz.method import Method
    from skyline_viz.running import Kept


@dataclass(frozen=True)
class Tables:
    """Measure the paper's Tables I to VI on data sets, with the published rows beside them.

    Examples:
        skyline-viz tables hills
        skyline-viz tables hills dunes --out tables --no-studies
        skyline-viz tables hills --method default edges --folds 5
    """

    datasets: Annotated[
        tuple[str, ...],
        tyro.conf.Positional,
        tyro.conf.arg(metavar="DATASET"),
    ]
    """Folders or addresses of data sets with truths, in a published layout or plain; or tables of
    labels, FILE.parquet."""

    out: Folder = Path("skyline-tables")
    """Folder for tables.md, tables.tex and the files of `evaluate`; made where it is missing."""

    methods: MethodOptions = field(default_factory=Methods)
    """The methods; all that are known unless given. They are trained anew, so no trained file."""

    truths: TruthOptions = field(default_factory=Truths)
    """How to read masks that leave a choice."""

    folds: int = 2
    """Folds of the cross-validation, which trains on all folds but the one it tests."""

    no_studies: Switch = False
    """Leave out Tables III and IV: filter size and training set."""

    seed: int = 0
    """Seed of all that is drawn."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos, their size and the free memory."""

    cluster: ClusterAddress = None
    """Work on a cluster instead: tcp://HOST:PORT, the address of a dask scheduler, or local:N for
    one of N processes on this machine. Its machines share the folders of photos and of --out. Times
    are still those of this machine."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Measure and write; return the exit status."""
        if not self.datasets:
            raise UsageError("which data sets? Name at least one folder.")
        if self.folds < 2:
            raise UsageError(f"a cross-validation has 2 folds or more, not {self.folds}.")
        if self.seed < 0:
            raise UsageError(f"a seed is 0 or more, not {self.seed}.")
        chosen: Sequence[Method] = [methods.make_method(name) for name in NAMES]
        if self.methods.given:
            chosen = self.methods.chosen(to_train=True)
        sets = {}
        for folder in self.datasets:
            dataset = self.truths.open(folder)
            if dataset.name in sets:
                raise UsageError(f"two data sets are called {dataset.name}; rename a folder.")
            output_folder(self.out, dataset)
            sets[dataset.name] = with_truth(dataset)
        workers = self.workers
        if self.cluster is None:
            workers = foresee([item for items in sets.values() for item in items], workers)
        kept = running.Kept.within(self.out, "tables")
        with on_cluster(self.cluster, self.workers, self.out):
            measured = {
                name: evaluation.cross_validate(
                    items, chosen, self.folds, seed=self.seed, workers=workers, kept=kept
                )
                for name, items in sets.items()
            }
            if done := kept.said("detection"):
                say(done)
            failures = [failure for one in measured.values() for failure in one.failures]
            if not any(found for one in measured.values() for found in one.results.values()):
                return status_after(failures) or SOME_FAILED
            self._write_results(measured)  # first: it took long, and what follows may fail
            studies = self._studies(sets, workers, kept)
        self._write_tables(self._tables(sets, measured, studies))
        kept.remove()
        return status_after(failures)

    def _studies(
        self, sets: Mapping[str, Sequence[DatasetItem]], workers: int, kept: Kept
    ) -> list[Table]:
        if self.no_studies:
            return []
        say("filter sizes and training sets ...")
        return [
            evaluation.table_3(sets, self.folds, self.seed, workers, kept),
            evaluation.table_4(sets, self.seed, workers, kept),
        ]

    def _tables(
        self,
        sets: Mapping[str, Sequence[DatasetItem]],
        measured: Mapping[str, Evaluation],
        studies: Sequence[Table],
    ) -> list[Table]:
        say("times ...")
        name, found = max(measured.items(), key=lambda one: len(one[1].methods))
        tested = {one.name for results in found.results.values() for one in results}
        photo = next(item for item in sets[name] if item.name in tested).photo()
        timings = evaluation.time_methods(found.methods, photo)
        return [
            evaluation.table_1(measured, self.folds),
            evaluation.table_2(measured),
            *studies,
            evaluation.table_5(measured, self.folds),
            evaluation.table_6(timings, found.methods),
        ]

    def _write_results(self, measured: Mapping[str, Evaluation]) -> None:
        for name, found in measured.items():
            folder = self.out / name if len(measured) > 1 else self.out
            folder.mkdir(exist_ok=True)
            tested = max(len(results) for results in found.results.values())
            title = f"{name}: {counted(tested, 'photo')}, {self.folds}-fold cross-validation"
            evaluation.write_evaluation(folder, found, about={"dataset": name}, title=title)
            for note in found.notes:
                say(f"{name}: {note}")

    def _write_tables(self, tables: list[Table]) -> None:
        write_text(self.out / "tables.md", evaluation.markdown(tables))
        write_text(self.out / "tables.tex", evaluation.latex(tables))
        tell_drawn(*evaluation.measured_only(tables), width=110)
        tell(f"Published rows and notes are beside them in {self.out / 'tables.md'}.")
        tell_done(f"tables.md, tables.tex, {listed(evaluation.FILES)} in {self.out}")
