"""``skyline-viz evaluate``: how good a detector is on a data set."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import tyro

from skyline_viz import evaluation, methods
from skyline_viz.command_line.clusters import on_cluster
from skyline_viz.command_line.lines import (
    LineFolders,
    about_lines,
    open_lines,
    status_after_lines,
)
from skyline_viz.command_line.messages import (
    GOOD,
    UsageError,
    counted,
    say,
    status_after,
    tell,
    tell_done,
    tell_drawn,
)
from skyline_viz.command_line.on_truth import OnTruth
from skyline_viz.command_line.reporting import ReportFile, check_report, report_data_set
from skyline_viz.command_line.settings import OptionalFolder
from skyline_viz.command_line.to_table import shard_of
from skyline_viz.system.names import listed

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from skyline_viz.datasets import Dataset, DatasetItem
    from skyline_viz.datasets.predictions import Predictions
    from skyline_viz.evaluation import Evaluation
    from skyline_viz.evaluation.cross_validation import Tested
    from skyline_viz.method import Method
    from skyline_viz.running import Kept
    from skyline_viz.running.batch import Failure
    from skyline_viz.running.shards import Shard


@dataclass(frozen=True)
class Evaluate(OnTruth):
    """Compare detected skylines with the truth of a data set.

    Examples:
        skyline-viz evaluate hills --out results
        skyline-viz evaluate hills --method default paper --folds 2
        skyline-viz evaluate hills --predictions mine --report mine.html
    """

    out: OptionalFolder = None
    """Folder for summary.json, photos.csv, histogram.png, error curves and the errors of columns;
    made where it is missing."""

    predictions: LineFolders = ()
    """Lines that exist as files, each [LABEL=]DIR, a path or an address: another method's, a
    network's, a person's. CSV, JSON or masks, called as their photos; instead of a method, or
    beside those of --method."""

    report: ReportFile = None
    """Write a report to be mailed: one HTML file with figures, photos, causes and stages."""

    shard: Annotated[str | None, tyro.conf.arg(metavar="I/N")] = None
    """Do only this part of the photos, such as 3/8, and keep what they come to in --out, for
    machines that share it; the same command without --shard sums up."""

    def run(self) -> int:
        """Evaluate all photos that have a truth; return the exit status."""
        check_report(self.report)
        shard = shard_of(self.shard)
        if shard is not None:
            self._check_shard()
        dataset, items = self.open()
        if shard is not None:
            return self._keep_shard(shard, dataset, items)
        lines = open_lines(self.predictions, items, self.truths)
        if self.report and lines and not self.methods.given:
            raise UsageError(
                "a report shows stages, which files of lines have not; name a --method."
            )
        workers, kept = self.begin("evaluate", dataset, items, self.out)
        with on_cluster(self.cluster, self.workers, self.out):
            return self._work(dataset, items, lines, workers, kept)

    def _check_shard(self) -> None:
        """Refuse what is of all photos.

        Raises:
            UsageError: It is asked for.
        """
        if not self.out:
            raise UsageError("--shard keeps what its photos come to in a folder: name it, --out.")
        others = {
            "--folds": self.folds.asked,
            "--predictions": bool(self.predictions),
            "--report": bool(self.report),
        }
        if asked := [option for option, given in others.items() if given]:
            raise UsageError(f"{asked[0]} is of all photos, and --shard does a part of them.")

    def _keep_shard(self, shard: Shard, dataset: Dataset, items: Sequence[DatasetItem]) -> int:
        own = [one for one in items if shard.holds(one.name)]
        if not own:
            tell(f"the shard {shard} has no photo of {dataset.name}")
            return GOOD
        workers, kept = self.begin("evaluate", dataset, own, self.out)
        with on_cluster(self.cluster, self.workers, self.out):
            found = evaluation.evaluate(own, self.methods.chosen(), workers=workers, kept=kept)
        done = max(len(results) for results in found.results.values())
        tell(
            f"{done} of {counted(len(items), 'photo')} of {dataset.name} are kept in {kept.folder}"
        )
        return status_after(found.failures)

    def _work(
        self,
        dataset: Dataset,
        items: Sequence[DatasetItem],
        lines: Sequence[Predictions],
        workers: int,
        kept: Kept,
    ) -> int:
        groups = self.folds.groups(items, workers)
        folds = self.folds.dealt(items, groups)
        said = self.folds.said(folds, groups)
        chosen, how = self._methods(said) if not lines or self.methods.given else ([], "")
        tested_ones: list[Tested] = [*chosen, *lines]
        if not chosen:
            how = f"lines of {listed([one.source for one in lines])}{said and f', {said}'}"
        found = (
            evaluation.cross_validate(
                items, tested_ones, folds, seed=self.seed, workers=workers, kept=kept
            )
            if folds is not None
            else evaluation.evaluate(items, tested_ones, workers=workers, kept=kept)
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
                "predictions": {one.name: about_lines(one) for one in lines},
            }
            evaluation.write_evaluation(self.out, found, about=about, title=title, groups=groups)
            kept.remove()
        _print(title, found, groups)
        for note in found.notes:
            say(note)
        tell(*(one.said for one in evaluation.all_paired(found.results, groups)))
        if self.out:
            tell_done(f"{listed(evaluation.FILES)} in {self.out}")
        late = self._report(dataset, how, found, workers) if self.report else []
        return status_after_lines([*found.failures, *late], lines, len(items))

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

    def _methods(self, folds: str) -> tuple[Sequence[Method], str]:
        """What is to be tested, and how in a few words."""
        chosen = self.methods.chosen(to_train=bool(folds))
        if len(chosen) > 1:
            return chosen, folds or "as they are"
        (one,) = chosen
        if self.methods.method or self.methods.network:
            return chosen, f"{one.name}, {folds or 'as it is'}"
        learned = methods.learned_from(one)
        return chosen, folds or f"filter bank trained on {learned or 'an unnamed data set'}"


def _print(title: str, found: Evaluation, groups: Mapping[str, str] | None) -> None:
    """A method alone with its worst photos, several as a table."""
    if len(found.results) > 1:
        tell(f"{title}; A_err in px")
        tell_drawn(evaluation.methods_table(found.results), width=110)
        return
    for results in found.results.values():
        if results:
            tell(title)
            interval = evaluation.mean_interval(results, groups)
            summary = evaluation.summary_table(evaluation.Summary.of(results), interval)
            tell_drawn(summary, evaluation.worst_table(evaluation.worst(results)))
