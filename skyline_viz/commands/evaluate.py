"""``skyline-viz evaluate``: how good a detector is on a data set."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING

import tyro

from skyline_viz.command_line.inputs import output_folder, with_truth
from skyline_viz.command_line.messages import (
    UsageError,
    counted,
    say,
    status_after,
    tell,
    tell_drawn,
)
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.settings import Folder, OptionalFolder
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.command_line.truth_options import TruthOptions, Truths
from skyline_viz.system.memory import MAX_MEGAPIXELS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from skyline_viz.datasets.layouts import Dataset, DatasetItem
    from skyline_viz.evaluation.results import PhotoResult
    from skyline_viz.running.batch import Failure
    from skyline_viz.running.resume import Kept


@dataclass(frozen=True)
class Evaluate:
    """Compare detected skylines with the truth of a data set."""

    dataset: tyro.conf.Positional[Folder]
    """Folder of a data set, in a published layout or plain."""

    folds: int = 0
    """Folds of a cross-validation, which trains on all folds but the one it tests; 0 is none."""

    out: OptionalFolder = None
    """Folder for summary.json, photos.csv and histogram.png; made where it is missing."""

    methods: MethodOptions = field(default_factory=Methods)
    """Methods to compare; the detector with the settings below unless given."""

    truths: TruthOptions = field(default_factory=Truths)
    """How to read masks that leave a choice."""

    seed: int = 0
    """Seed of the negative samples in a cross-validation."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos, their size and the free memory."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Evaluate all photos that have a truth; return the exit status."""
        if self.seed < 0:
            raise UsageError(f"a seed is 0 or more, not {self.seed}.")
        dataset = self.truths.open(self.dataset)
        items = with_truth(dataset)
        if self.out:
            output_folder(self.out, dataset)
        from skyline_viz.running.resume import Kept  # noqa: PLC0415

        workers = foresee(items, self.workers)
        kept = Kept.within(self.out, "evaluate")
        if self.methods.method or self.methods.network:
            return self._compare(dataset, items, workers, kept)
        from skyline_viz.detector import Detector  # noqa: PLC0415
        from skyline_viz.evaluation.cross_validation import cross_validate, evaluate  # noqa: PLC0415

        if self.folds:
            self.methods.one(to_train=True)
            how = f"{self.folds}-fold cross-validation"
            about: dict[str, object] = {"folds": self.folds, "seed": self.seed}
            results, failures = cross_validate(
                items,
                self.folds,
                config=self.methods.config,
                seed=self.seed,
                workers=workers,
                kept=kept,
            )
        else:
            detector = self.methods.one()
            assert isinstance(detector, Detector)
            provenance = detector.bank.provenance
            how = f"filter bank trained on {provenance.dataset or 'an unnamed data set'}"
            about = {"bank": asdict(provenance)}
            if provenance.dataset == dataset.name:
                say(f"the bank was trained on {dataset.name}, so this is no test; see --folds.")
            results, failures = evaluate(items, detector, workers=workers, kept=kept)
        title = f"{dataset.name}: {counted(len(results), 'photo')}, {how}"
        if done := kept.said():
            say(done)
        if self.out:
            self._write(dataset, title, about, results, failures)
            kept.remove()
        if results:
            _print(title, results)
        if self.out:
            tell(f"summary.json, photos.csv and histogram.png in {self.out}")
        return status_after(failures)

    def _compare(
        self, dataset: Dataset, items: Sequence[DatasetItem], workers: int, kept: Kept
    ) -> int:
        """Evaluate the methods that were named."""
        from skyline_viz.evaluation import report  # noqa: PLC0415
        from skyline_viz.evaluation.comparing import compare_methods  # noqa: PLC0415
        from skyline_viz.methods.registry import learned_from  # noqa: PLC0415

        methods = self.methods.chosen(to_train=bool(self.folds))
        for text in self.methods.method:
            if not self.folds and learned_from(text) == dataset.name:
                say(f"{text} was trained on {dataset.name}, so this is no test; see --folds.")
        found = compare_methods(
            items, methods, folds=self.folds, seed=self.seed, workers=workers, kept=kept
        )
        if done := kept.said("detection"):
            say(done)
        how = f"{self.folds}-fold cross-validation" if self.folds else "as they are"
        tell(f"{dataset.name}: {counted(len(items), 'photo')}, {how}; A_err in px")
        tell_drawn(report.methods_table(found.results), width=110)
        if self.out:
            about = {
                "dataset": dataset.name,
                "folds": self.folds,
                "seed": self.seed,
                "failed": [asdict(failure) for failure in found.failures],
            }
            report.write_comparison(self.out, found.results, about)
            kept.remove()
            tell(f"methods.json and methods.csv in {self.out}")
        return status_after(found.failures)

    def _write(
        self,
        dataset: Dataset,
        title: str,
        about: dict[str, object],
        results: list[PhotoResult],
        failures: list[Failure],
    ) -> None:
        from skyline_viz.evaluation import report  # noqa: PLC0415
        from skyline_viz.evaluation.results import Summary  # noqa: PLC0415

        assert self.out is not None
        about = {
            "dataset": dataset.name,
            "layout": dataset.layout,
            **about,
            "config": asdict(self.methods.config),
            "failed": [asdict(failure) for failure in failures],
            "problems": [*dataset.problems, *dataset.left_out],
        }
        report.write_summary(self.out / "summary.json", Summary.of(results), about)
        report.write_results(self.out / "photos.csv", results)
        report.write_histogram(self.out / "histogram.png", results, title)


def _print(title: str, results: list[PhotoResult]) -> None:
    from skyline_viz.evaluation.report import summary_table, worst_table  # noqa: PLC0415
    from skyline_viz.evaluation.results import Summary, worst  # noqa: PLC0415

    tell(title)
    tell_drawn(summary_table(Summary.of(results)), worst_table(worst(results)))
