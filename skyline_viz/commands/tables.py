"""``skyline-viz tables``: the paper's tables, measured, on one page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from skyline_viz.command_line.inputs import output_folder, with_truth
from skyline_viz.command_line.messages import SOME_FAILED, UsageError, say, status_after, tell
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.settings import Folder, Switch
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.command_line.truth_options import TruthOptions, Truths
from skyline_viz.methods.names import NAMES
from skyline_viz.system.memory import MAX_MEGAPIXELS

if TYPE_CHECKING:
    from skyline_viz.datasets.layouts import DatasetItem
    from skyline_viz.evaluation.comparing import Compared
    from skyline_viz.evaluation.tables import Table
    from skyline_viz.method import Method
    from skyline_viz.running.resume import Kept


@dataclass(frozen=True)
class Tables:
    """Measure the paper's Tables I to VI on data sets, with the published rows beside them."""

    datasets: Annotated[
        tuple[Path, ...],
        tyro.conf.Positional,
        tyro.conf.arg(metavar="DATASET [DATASET ...]", help_behavior_hint="(required)"),
    ]
    """Folders of data sets with truths, in a published layout or plain."""

    out: Folder = Path("skyline-tables")
    """Folder for tables.md, tables.tex, methods.csv and histograms; made where it is missing."""

    methods: MethodOptions = field(default_factory=Methods)
    """The methods; all that are known unless given."""

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

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Measure and write; return the exit status."""
        from skyline_viz.methods.registry import make_method  # noqa: PLC0415
        from skyline_viz.running.resume import Kept  # noqa: PLC0415

        if not self.datasets:
            raise UsageError("which data sets? Name at least one folder.")
        if self.folds < 2:
            raise UsageError(f"a cross-validation has 2 folds or more, not {self.folds}.")
        if self.seed < 0:
            raise UsageError(f"a seed is 0 or more, not {self.seed}.")
        methods: Sequence[Method] = [make_method(name) for name in NAMES]
        if self.methods.given:
            methods = self.methods.chosen(to_train=True)
        sets = {}
        for folder in self.datasets:
            dataset = self.truths.open(folder)
            if dataset.name in sets:
                raise UsageError(f"two data sets are called {dataset.name}; rename a folder.")
            output_folder(self.out, dataset)
            sets[dataset.name] = with_truth(dataset)
        workers = foresee([item for items in sets.values() for item in items], self.workers)
        kept = Kept.within(self.out, "tables")
        measured = self._measure(sets, methods, workers, kept)
        failures = [failure for one in measured.values() for failure in one.failures]
        if not any(one.results for one in measured.values()):
            return status_after(failures) or SOME_FAILED
        self._write_results(measured)  # first: it took long, and what follows may fail
        self._write_tables(self._tables(measured, workers, kept))
        kept.remove()
        return status_after(failures)

    def _measure(
        self,
        sets: Mapping[str, Sequence[DatasetItem]],
        methods: Sequence[Method],
        workers: int,
        kept: Kept,
    ) -> dict[str, Compared]:
        from skyline_viz.evaluation.comparing import compare_methods  # noqa: PLC0415

        measured = {
            name: compare_methods(
                items, methods, folds=self.folds, seed=self.seed, workers=workers, kept=kept
            )
            for name, items in sets.items()
        }
        if done := kept.said("detection"):
            say(done)
        return measured

    def _tables(self, measured: dict[str, Compared], workers: int, kept: Kept) -> list[Table]:
        from skyline_viz.evaluation import tables  # noqa: PLC0415
        from skyline_viz.evaluation.timing import time_methods  # noqa: PLC0415

        sets = {name: compared.items for name, compared in measured.items()}
        studies = []
        if not self.no_studies:
            say("filter sizes and training sets ...")
            studies = [
                tables.table_3(sets, self.folds, self.seed, workers, kept),
                tables.table_4(sets, self.seed, workers, kept),
            ]
        say("times ...")
        compared = max(measured.values(), key=lambda one: len(one.fitted))
        timings = time_methods(compared.fitted, compared.items[0].photo())
        return [
            tables.table_1(measured, self.folds),
            tables.table_2(measured),
            *studies,
            tables.table_5(measured, self.folds),
            tables.table_6(timings, compared.fitted),
        ]

    def _write_results(self, measured: dict[str, Compared]) -> None:
        from skyline_viz.evaluation.report import write_comparison, write_histogram  # noqa: PLC0415

        for name, compared in measured.items():
            folder = self.out / name if len(measured) > 1 else self.out
            folder.mkdir(exist_ok=True)
            about = {"dataset": name, "folds": self.folds, "seed": self.seed}
            write_comparison(folder, compared.results, about)
            for method in ("default", "paper"):
                if results := compared.results.get(method):
                    title = f"{name}: {len(results)} photos, {method}"
                    write_histogram(folder / f"histogram-{method}.png", results, title)

    def _write_tables(self, tables: list[Table]) -> None:
        from skyline_viz.evaluation.tables_report import latex, markdown  # noqa: PLC0415
        from skyline_viz.files import write_text  # noqa: PLC0415

        page = markdown(tables)
        write_text(self.out / "tables.md", page)
        write_text(self.out / "tables.tex", latex(tables))
        tell(*page.splitlines())
        tell(f"tables.md, tables.tex, methods.csv and histograms in {self.out}")
