"""``skyline-viz diagnose``: why skylines went wrong, photo by photo and all together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import tyro

from skyline_viz import diagnosis, evaluation
from skyline_viz.command_line.clusters import on_cluster
from skyline_viz.command_line.messages import (
    UsageError,
    counted,
    say,
    status_after,
    tell,
    tell_done,
)
from skyline_viz.command_line.on_truth import OnTruth
from skyline_viz.command_line.reporting import ReportFile, check_report, report_data_set
from skyline_viz.command_line.settings import OptionalFolder, Switch
from skyline_viz.system.memory import RECORDING
from skyline_viz.system.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from skyline_viz.datasets import Dataset, DatasetItem
    from skyline_viz.diagnosis import Diagnosed
    from skyline_viz.method import Method
    from skyline_viz.running import Kept


@dataclass(frozen=True)
class Diagnose(OnTruth):
    """Say why skylines went wrong, and prove it by changing one thing and searching again.

    Examples:
        skyline-viz diagnose hills --out causes
        skyline-viz diagnose hills --photo tor
        skyline-viz diagnose hills --report causes.html --no-remedies
    """

    photo: Annotated[str, tyro.conf.arg(metavar="NAME")] = ""
    """Name of one photo, to print its diagnosis in full; --out gets NAME.json and NAME.md then."""

    tolerance: float = 0.0
    """Error up to which a column is right, in pixels; 0 takes 4, more for large photos."""

    no_remedies: Switch = False
    """Do not try what would help most: other settings on wrong photos, and those that help there on
    all others."""

    out: OptionalFolder = None
    """Folder for segments.csv, diagnosis.json and causes.png; made where it is missing."""

    report: ReportFile = None
    """Write a report to be mailed: one HTML file with photos, causes, remedies and stages."""

    def run(self) -> int:
        """Diagnose all photos that have a truth; return the exit status."""
        diagnosis.checked_tolerance(self.tolerance)
        check_report(self.report)
        dataset, items = self.open()
        if self.photo and self.photo not in {item.name for item in items}:
            near = nearest(self.photo, [item.name for item in items])
            better = f"; did you mean {near}?" if near else "."
            raise UsageError(f"{dataset.name} has no photo {self.photo} with a truth{better}")
        workers, kept = self.begin("diagnose", dataset, items, self.out, RECORDING)
        with on_cluster(self.cluster, self.workers, self.out):
            return self._work(dataset, items, workers, kept)

    def _work(
        self, dataset: Dataset, items: Sequence[DatasetItem], workers: int, kept: Kept
    ) -> int:
        from skyline_viz.evaluation.seen import notes as seen_notes

        groups = self.folds.groups(items, workers) if self.folds.asked else None
        folds = self.folds.dealt(items, groups)
        assigned = evaluation.assign(
            items, [self._method()], folds,
            seed=self.seed, workers=workers, kept=kept,
        )  # fmt: skip
        ((name, tasks),) = assigned.tasks.items()
        if self.photo:
            tasks = [task for task in tasks if task.name == self.photo]
        found, failed = diagnosis.diagnose_photos(
            tasks,
            self.tolerance,
            remedies=not self.no_remedies,
            workers=workers,
            kept=kept,
        )
        if done := kept.said():
            say(done)
        for note in seen_notes(name, {one.name: one.seen for one in found}, folds=bool(folds)):
            say(note)
        self._tell(dataset.name, found)
        failures = [*assigned.failures[name], *failed]
        if self.report:
            how = f"{name}, {self.folds.said(folds, groups) or 'as it is'}"
            failures += report_data_set(
                self.report, dataset, how, tasks, failures, diagnosed=found, workers=workers
            )
        kept.remove()
        return status_after(failures)

    def _method(self) -> Method:
        return self.methods.one(to_train=self.folds.asked)

    def _tell(self, name: str, found: Sequence[Diagnosed]) -> None:
        if self.photo:
            for one in found:
                tell(*diagnosis.in_full(one).splitlines())
                if self.out:
                    document, text = diagnosis.write_photo(self.out, name, one)
                    tell_done(f"{document.name} and {text.name} in {document.parent}")
        else:
            self._tell_all(name, found)
        if not found:
            say("nothing was diagnosed.")

    def _tell_all(self, name: str, found: Sequence[Diagnosed]) -> None:
        if found:
            tell(f"{name}: {counted(len(found), 'photo')}")
            tell(*diagnosis.table(found).splitlines())
            if not self.no_remedies and (helps := diagnosis.remedies_table(found)):
                tell(*helps.splitlines())
        if self.out:
            diagnosis.write_csv(self.out / "segments.csv", found)
            diagnosis.write_json(self.out / "diagnosis.json", name, found)
            diagnosis.write_picture(self.out / "causes.png", name, found)
            tell_done(f"segments.csv, diagnosis.json and causes.png in {self.out}")
