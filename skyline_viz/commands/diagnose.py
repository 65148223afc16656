"""``skyline-viz diagnose``: why skylines went wrong, photo by photo and all together."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING

import tyro

from skyline_viz.command_line.inputs import output_folder, with_truth
from skyline_viz.command_line.messages import UsageError, counted, say, status_after, tell
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.settings import Folder, OptionalFolder, Switch
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.command_line.truth_options import TruthOptions, Truths
from skyline_viz.running.batch import Failure
from skyline_viz.system.memory import MAX_MEGAPIXELS, RECORDING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from skyline_viz.datasets.layouts import DatasetItem
    from skyline_viz.diagnosis.report import Diagnosed
    from skyline_viz.method import Method
    from skyline_viz.running.resume import Kept


@dataclass(frozen=True)
class Diagnose:
    """Say why skylines went wrong, and prove it by changing one thing and searching again."""

    dataset: tyro.conf.Positional[Folder]
    """Folder of a data set with truths, in a published layout or plain."""

    photo: str = ""
    """Name of one photo, to print its diagnosis in full; --out gets NAME.json and NAME.md then."""

    tolerance: float = 0.0
    """Error up to which a column is right, in pixels; 0 takes 4, more for large photos."""

    folds: int = 0
    """Folds of a cross-validation, which trains on all folds but the diagnosed one; 0 is none."""

    no_remedies: Switch = False
    """Do not try what would help most: other settings, on all photos."""

    out: OptionalFolder = None
    """Folder for segments.csv and diagnosis.json; made where it is missing."""

    methods: MethodOptions = field(default_factory=Methods)
    """Another method than ours; with --folds it is trained on the other folds."""

    truths: TruthOptions = field(default_factory=Truths)
    """How to read masks that leave a choice."""

    seed: int = 0
    """Seed of the negative samples in a cross-validation."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos, their size and the free memory."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Diagnose all photos that have a truth; return the exit status."""
        from skyline_viz.diagnosis.diagnosing import checked_tolerance  # noqa: PLC0415

        checked_tolerance(self.tolerance)
        dataset = self.truths.open(self.dataset)
        items = with_truth(dataset)
        if self.photo and self.photo not in {item.name for item in items}:
            raise UsageError(f"{dataset.name} has no photo {self.photo} with a truth.")
        if self.out:
            output_folder(self.out, dataset)
        from skyline_viz.running.resume import Kept  # noqa: PLC0415

        workers = foresee(items, self.workers, RECORDING)
        kept = Kept.within(self.out, "diagnose")
        detectors, failures = self._detectors(items, workers, kept)
        if self.photo:
            items = [item for item in items if item.name == self.photo]
        found, failed = self._diagnose(items, detectors, workers, kept)
        if done := kept.said():
            say(done)
        self._tell(dataset.name, found)
        kept.remove()
        return status_after([*failures, *failed])

    def _detectors(
        self, items: Sequence[DatasetItem], workers: int, kept: Kept
    ) -> tuple[Mapping[str, Method], list[Failure]]:
        """The detector of each photo, by its name."""
        from skyline_viz.evaluation.comparing import fold_method  # noqa: PLC0415
        from skyline_viz.evaluation.cross_validation import fold_detectors  # noqa: PLC0415

        method = self.methods.one(to_train=bool(self.folds))
        if self.methods.method or self.methods.network or not self.folds:
            return fold_method(items, method, self.folds, self.seed, workers, kept)
        return fold_detectors(
            items,
            self.folds,
            config=self.methods.config,
            seed=self.seed,
            workers=workers,
            kept=kept,
        )

    def _diagnose(
        self,
        items: Sequence[DatasetItem],
        detectors: Mapping[str, Method],
        workers: int,
        kept: Kept,
    ) -> tuple[list[Diagnosed], list[Failure]]:
        from skyline_viz.diagnosis import record as diagnosis_record  # noqa: PLC0415
        from skyline_viz.diagnosis.report import diagnose_item  # noqa: PLC0415
        from skyline_viz.evaluation.cross_validation import key_of, tests_of  # noqa: PLC0415
        from skyline_viz.running.resume import Codec  # noqa: PLC0415

        remedies = not (self.no_remedies or self.photo)
        work = partial(diagnose_item, self.tolerance or None, remedies=remedies)
        key = partial(key_of, f"diagnosis {self.tolerance} {remedies}")
        codec = Codec(diagnosis_record.pack, diagnosis_record.unpack)
        tasks = tests_of(items, detectors, kept)
        found, failures = [], []
        outcomes = kept.run(work, tasks, key, codec, workers=workers, title="diagnosing")
        for outcome in outcomes:
            if isinstance(outcome, Failure):
                failures.append(outcome)
            else:
                found.append(outcome)
        return found, failures

    def _tell(self, name: str, found: list[Diagnosed]) -> None:
        from skyline_viz.diagnosis import report  # noqa: PLC0415

        if self.photo:
            for one in found:
                tell(*report.in_full(one).splitlines())
                if self.out:
                    document, text = report.write_photo(self.out, name, one)
                    tell(f"{document.name} and {text.name} in {document.parent}")
        else:
            self._tell_all(name, found)
        if not found:
            say("nothing was diagnosed.")

    def _tell_all(self, name: str, found: list[Diagnosed]) -> None:
        from skyline_viz.diagnosis import report  # noqa: PLC0415

        if found:
            tell(f"{name}: {counted(len(found), 'photo')}")
            tell(*report.table(found).splitlines())
            if helps := report.remedies_table(found):
                tell(*helps.splitlines())
        if self.out:
            report.write_csv(self.out / "segments.csv", found)
            report.write_json(self.out / "diagnosis.json", name, found)
            tell(f"segments.csv and diagnosis.json in {self.out}")
