"""``skyline-viz train``: photos with truth in, a filter bank out."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import tyro

from skyline_viz import evaluation
from skyline_viz.command_line.inputs import output_folder, with_truth
from skyline_viz.command_line.messages import GOOD, UsageError, counted, status_after, tell
from skyline_viz.command_line.settings import Folder, Preset
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.command_line.truth_options import TruthOptions, Truths
from skyline_viz.config import TrainingConfig
from skyline_viz.methods.names import MethodName
from skyline_viz.system.memory import MAX_MEGAPIXELS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from skyline_viz.datasets.layouts import DatasetItem
    from skyline_viz.method import LearnedMethod

MethodToTrain: TypeAlias = Annotated[MethodName, tyro.conf.arg(metavar="METHOD")]


@dataclass(frozen=True)
class Train:
    """Learn a filter bank, or one of the earlier methods, from photos with truth."""

    dataset: tyro.conf.Positional[Folder]
    """Folder of a data set, in a published layout or plain."""

    out: Annotated[Path, tyro.conf.arg(metavar="FILE")]
    """File for the filter bank, usually .npz; a file that is there is replaced."""

    method: MethodToTrain = "default"
    """What to train: our filter bank, or one of the earlier methods that learn."""

    pretrained: Annotated[Path | None, tyro.conf.arg(metavar="FILE.pth")] = None
    """Pretrained VGG-16 weights for the FCNs and SegNet, which then have its full width."""

    truths: TruthOptions = field(default_factory=Truths)
    """How to read masks that leave a choice."""

    seed: int = 0
    """Seed of the negative samples; the same seed and photos give the same bank."""

    preset: Preset = "default"
    """Where training.detector starts from: the best that is known, or the published method."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos, their size and the free memory."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    training: TrainingConfig = field(default_factory=TrainingConfig)
    """Single settings of the training."""

    def run(self) -> int:
        """Train on all photos that have a truth; return the exit status."""
        dataset = self.truths.open(self.dataset)
        if self.out.is_dir():
            raise UsageError(f"{self.out} is a folder; name a file for the filter bank.")
        if self.seed < 0:
            raise UsageError(f"a seed is 0 or more, not {self.seed}.")
        items = with_truth(dataset)
        output_folder(self.out.parent, ())
        if self.method == "paper":
            raise UsageError(
                "the filters of paper are trained by --preset paper, without --method."
            )
        if self.method != "default":
            return self._train_method(dataset.name, items)
        if self.pretrained is not None:
            raise UsageError("--pretrained is for FCNs and SegNet, not for our filter bank.")
        bank, failures = evaluation.train_on(
            items,
            self.training,
            seed=self.seed,
            dataset=dataset.name,
            workers=foresee(items, self.workers),
        )
        bank.save(self.out)
        tell(f"photos used   {bank.provenance.images} of {len(dataset)} in {dataset.name}")
        tell(f"samples       {bank.samples.sum():,}, flipped ones included")
        tell(f"starved bins  {bank.starved.sum()} of {counted(bank.bins.count, 'bin')}")
        tell(f"filters       {bank.size} x {bank.size} pixels")
        tell(f"written       {self.out}, {self.out.stat().st_size:,} bytes")
        return status_after(failures)

    def _pretrained(self, method: LearnedMethod) -> LearnedMethod:
        from skyline_viz.methods.parsing import SceneParsing  # noqa: PLC0415

        if not isinstance(method, SceneParsing):
            raise UsageError(f"--pretrained is for FCNs and SegNet, not for {method.name}.")
        return replace(method, width=1.0, pretrained=self.pretrained)

    def _train_method(self, dataset: str, items: Sequence[DatasetItem]) -> int:
        from skyline_viz.method import LearnedMethod  # noqa: PLC0415
        from skyline_viz.methods.registry import Trained, make_method, save_method  # noqa: PLC0415

        if self.training != TrainingConfig():
            raise UsageError(f"--preset and --training are for our filter bank, not {self.method}.")
        foresee(items)
        method = make_method(self.method)
        if not isinstance(method, LearnedMethod):
            raise UsageError(f"the method {self.method} has nothing to learn.")
        if self.pretrained is not None:
            method = self._pretrained(method)
        fitted = method.fit(items, self.seed)
        save_method(fitted, self.out, Trained(dataset, len(items), self.seed))
        tell(f"{self.method}, trained on {counted(len(items), 'photo')} of {dataset}")
        tell(f"written  {self.out}, {self.out.stat().st_size:,} bytes")
        return GOOD
