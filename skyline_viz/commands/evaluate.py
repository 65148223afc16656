"""``skyline-viz evaluate``: how good a detector is on a data set."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from skyline_viz import evaluation, methods
from skyline_viz.command_line.messages import (
    counted,
    listed,
    say,
    status_after,
    tell,
    tell_drawn,
)
from skyline_viz.command_line.on_truth import OnTruth
from skyline_viz.command_line.reporting import ReportFile, check_report, report_data_set
from skyline_viz.command_line.settings import OptionalFolder

if TYPE_CHECKING:
    from collections.abc import Sequence

    from skyline_viz.datasets import Dataset
    from skyline_viz.evaluation import Evaluation
    from skyline_viz.method import Method
    from skyline_viz.running.batch import Failure


@dataclass(frozen=True)
class Evaluate(OnTruth):
    """Compare detected skylines with the truth of a data set."""

    out: OptionalFolder = None
    """Folder for summary.json, photos.csv and histogram.png; made where it is missing."""

    report: ReportFile = None
    """Write a report to be mailed: one HTML file with figures, photos, causes and stages."""

    def run(self) -> int:
        """Evaluate all photos that have a truth; return the exit status."""
        check_report(self.report)
        dataset, items = self.open()
        workers, kept = self.begin("evaluate", dataset, items, self.out)
        chosen, how = self._methods(dataset.name)
        found = (
            evaluation.cross_validate(
                items, chosen, self.folds, seed=self.seed, workers=workers, kept=kept
            )
            if self.folds
            else evaluation.evaluate(items, chosen, workers=workers, kept=kept)
        )
        if done := kept.said("photo" if len(chosen) == 1 else "detection"):
            say(done)
        tested = max(len(results) for results in found.results.values())
        title = f"{dataset.name}: {counted(tested, 'photo')}, {how}"
        if self.out:
            about = {
                "dataset": dataset.name,
                "layout": dataset.layout,
                "problems": [*dataset.problems, *dataset.left_out],
            }
            evaluation.write_evaluation(self.out, found, about=about, title=title)
            kept.remove()
        _print(title, found)
        if self.out:
            tell(f"{listed(evaluation.FILES)} in {self.out}")
        late = self._report(dataset, how, found, workers) if self.report else []
        return status_after([*found.failures, *late])

    def _report(
        self, dataset: Dataset, how: str, found: Evaluation, workers: int
    ) -> Sequence[Failure]:
        """Write the report: photos as the first method finds them, with the figures of all."""
        assert self.report is not None
        first, *others = found.tasks
        notes = [f"Photos are shown as {first} finds them."] if others else []
        notes.append("What would mend them is tried by skyline-viz diagnose.")
        tested = {one.name for one in found.results[first]}
        tasks = [task for task in found.tasks[first] if task.name in tested]
        return report_data_set(
            self.report, dataset, how, tasks, found.failures,
            results=found.results, notes=notes, workers=workers,
        )  # fmt: skip

    def _methods(self, dataset: str) -> tuple[Sequence[Method], str]:
        """What is to be tested and how; says so where that was trained on these very photos."""
        folds = f"{self.folds}-fold cross-validation" if self.folds else ""
        chosen = self.methods.chosen(to_train=bool(self.folds))
        for one in chosen:
            learned = methods.learned_from(one)
            if not folds and dataset in (learned, *learned.split(", ")):
                say(f"{one.name} was trained on {dataset}, so this is no test; see --folds.")
            elif dataset in sky_learned_from(one).split(", "):
                say(
                    f"the sky model of {one.name} was trained on {dataset}, also on the photos "
                    f"that it is tested on; sky_weight=0 does without."
                )
        if len(chosen) > 1:
            return chosen, folds or "as they are"
        (one,) = chosen
        if self.methods.method or self.methods.network:
            return chosen, f"{one.name}, {folds or 'as it is'}"
        learned = methods.learned_from(one)
        return chosen, folds or f"filter bank trained on {learned or 'an unnamed data set'}"


def sky_learned_from(method: Method) -> str:
    """Names of the data sets that the sky model of a method was trained on; empty without one."""
    from skyline_viz.detector import Detector

    if isinstance(method, Detector) and method.config.sky_weight:
        return method.sky.learned_from
    return ""


def _print(title: str, found: Evaluation) -> None:
    """A method alone with its worst photos, several as a table."""
    if len(found.results) > 1:
        tell(f"{title}; A_err in px")
        tell_drawn(evaluation.methods_table(found.results), width=110)
        return
    for results in found.results.values():
        if results:
            tell(title)
            summary = evaluation.summary_table(evaluation.Summary.of(results))
            tell_drawn(summary, evaluation.worst_table(evaluation.worst(results)))
