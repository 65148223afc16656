"""``skyline-viz train``: photos with truth in, a detector out."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from skyline_viz import evaluation
from skyline_viz.command_line.clusters import on_cluster
from skyline_viz.command_line.inputs import output_folder, with_truth
from skyline_viz.command_line.messages import (
    UsageError,
    counted,
    status_after,
    tell,
    tell_done,
)
from skyline_viz.command_line.settings import ClusterAddress, Preset, RunFile
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.command_line.to_table import shard_of
from skyline_viz.command_line.truth_options import TruthOptions, Truths
from skyline_viz.config import DetectorConfig, TrainingConfig
from skyline_viz.files import replacing
from skyline_viz.sky_training.sizes import STEPS, SizeName
from skyline_viz.system.memory import MAX_MEGAPIXELS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from skyline_viz.datasets.dataset import DatasetItem
    from skyline_viz.detector import Detector
    from skyline_viz.filter_bank import FilterBank
    from skyline_viz.method import Configurable
    from skyline_viz.running.shards import Shard


@dataclass(frozen=True)
class Train:
    """Learn our filters, or another method, from photos with truth.

    Examples:
        skyline-viz train hills --out bank.npz
        skyline-viz train hills dunes --out bank.npz --training.filter-size 9
        skyline-viz train hills --method svm-dcsi --out svm.npz
    """

    datasets: Annotated[
        tuple[str, ...],
        tyro.conf.Positional,
        tyro.conf.arg(metavar="DATASET"),
    ]
    """Folders or addresses of data sets with truths, in a published layout or plain, or tables of
    labels, FILE.parquet; each counts alike, whatever the number of its photos."""

    out: Annotated[Path, tyro.conf.arg(metavar="FILE")]
    """File for the detector, usually .npz; a file that is there is replaced."""

    method: Annotated[str, tyro.conf.arg(metavar="METHOD")] = "default"
    """What to train: our detector, with settings such as paper:delta=4, one of the earlier methods
    that learn, or a class of yours, package.module:Class."""

    learn_sky: SizeName | None = None
    """Learn a sky model of this size instead of filters: a FILE.onnx for --sky; the small one takes
    half an hour."""

    teacher: Annotated[Path | None, tyro.conf.arg(metavar="FILE.onnx")] = None
    """Sky network that says what is sky in photos without a truth, for --learn-sky."""

    steps: int = STEPS
    """How many batches of 16 photos a sky model sees; of more photos than are in them so many are
    chosen, and read."""

    pretrained: Annotated[Path | None, tyro.conf.arg(metavar="FILE.pth")] = None
    """Pretrained VGG-16 weights for the FCNs and SegNet, which then have its full width."""

    truths: TruthOptions = field(default_factory=Truths)
    """How to read masks that leave a choice."""

    seed: int = 0
    """Seed of the negative samples; the same seed and photos give the same bank."""

    preset: Preset = "default"
    """Where training starts from: the best that is known, or the published method."""

    earlier: RunFile = None
    """Settings of the detector of an earlier run: its run.json or summary.json."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos, their size and the free memory."""

    cluster: ClusterAddress = None
    """Read photos on a cluster instead: tcp://HOST:PORT, the address of a dask scheduler, or
    local:N for one of N processes on this machine. For our filters and sky models; the file is the
    same to the bit."""

    shard: Annotated[str | None, tyro.conf.arg(metavar="I/N")] = None
    """Gather from this part of the photos only, such as 3/8; FILE is then a folder of parts, of
    which join makes the detector, the same to the bit. For our filters."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    training: TrainingConfig = field(default_factory=TrainingConfig)
    """Single settings of the training."""

    def run(self) -> int:
        """Train on all photos that have a truth; return the exit status."""
        if not self.datasets:
            raise UsageError("which data sets? Name at least one folder.")
        shard = shard_of(self.shard)
        if shard is None and self.out.is_dir():
            raise UsageError(f"{self.out} is a folder; name a file for the detector.")
        if shard is not None and (self.out.is_file() or self.learn_sky is not None):
            raise UsageError(
                f"--shard is for filters, and shards go into a folder, not into {self.out}."
            )
        if self.seed < 0:
            raise UsageError(f"a seed is 0 or more, not {self.seed}.")
        if self.cluster is not None and self.workers:
            raise UsageError("--cluster is instead of --workers; leave one of them out.")
        if self.learn_sky is not None:
            return self._train_sky(self.learn_sky)
        if self.teacher is not None or self.steps != STEPS:
            raise UsageError(
                "--teacher and --steps are for a sky model; name its size, --learn-sky."
            )
        sets, photos = self._sets()
        output_folder(self.out.parent, ())
        from skyline_viz.detector import Detector
        from skyline_viz.methods.registry import find_method, has_learned

        if has_learned(self.method):
            raise UsageError(
                f"{self.method} has learned already, and would be trained anew; name a method."
            )
        method = find_method(self.method)
        if isinstance(method, Detector):
            return self._train_ours(sets, photos, method, shard)
        if shard is not None:
            raise UsageError(f"--shard is for our filter bank, not {self.method}.")
        return self._train_method(sets, method)

    def _sets(self, *, all_photos: bool = False) -> tuple[dict[str, list[DatasetItem]], int]:
        """The photos with a truth of each data set by its name, and the number of all photos.

        Or all photos, with a truth or without.
        """
        sets: dict[str, list[DatasetItem]] = {}
        photos = 0
        for folder in self.datasets:
            dataset = self.truths.open(folder)
            if dataset.name in sets:
                raise UsageError(f"two data sets are called {dataset.name}; rename a folder.")
            sets[dataset.name] = list(dataset) if all_photos else with_truth(dataset)
            photos += len(dataset)
        if len(sets) > 1:  # names are those of one data set only
            for name, items in sets.items():
                sets[name] = [replace(item, name=f"{name}/{item.name}") for item in items]
        return sets, photos

    def _train_sky(self, size: SizeName) -> int:
        """Train a sky model; photos without a truth count where there is a teacher."""
        if self.training != TrainingConfig() or self.method != "default":
            raise UsageError("--method, --preset and --training are for filters, not sky models.")
        if self.steps < 1:
            raise UsageError(f"a sky model sees 1 batch or more, not {self.steps}.")
        from skyline_viz.sky_model import SkyModel
        from skyline_viz.sky_training.choosing import chosen

        teacher = SkyModel.load(self.teacher) if self.teacher else None
        sets, photos = self._sets(all_photos=teacher is not None)
        output_folder(self.out.parent, ())
        read = [one for items in chosen(sets, self.steps, self.seed).values() for one in items]
        model, failures = evaluation.learn_sky(
            sets,
            size,
            teacher=teacher,
            steps=self.steps,
            seed=self.seed,
            workers=foresee(read, self.workers) if self.cluster is None else 1,
            reading=on_cluster(self.cluster),
        )
        with replacing(self.out) as temporary:
            temporary.write_bytes(model.network)
        used = sum(model.photos_learned.values())
        tell(f"photos used  {used} of {photos}")
        if unread := sum(map(len, sets.values())) - len(read):
            steps = counted(self.steps, "step")
            tell(f"not read     {counted(unread, 'photo')}: {steps} see {len(read):,} at the most")
        if nothing := len(read) - len(failures) - used:
            tell(f"left out     {counted(nothing, 'photo')} whose truth shows no line")
        tell_done(f"written      {self.out}, {self.out.stat().st_size:,} bytes")
        return status_after(failures)

    def _train_ours(
        self,
        sets: Mapping[str, Sequence[DatasetItem]],
        photos: int,
        method: Detector,
        shard: Shard | None,
    ) -> int:
        if self.pretrained is not None:
            raise UsageError("--pretrained is for FCNs and SegNet, not for our filter bank.")
        from skyline_viz.evaluation.training_runs import gather_several
        from skyline_viz.running.gram_shards import Gathered, write_gathered

        training = self.training
        if method.config != DetectorConfig() and (
            self.preset != "default" or training.detector != method.config
        ):
            raise UsageError(
                f"settings are given twice; leave out --preset and --training.detector, or "
                f"name default instead of {self.method}."
            )
        workers = self.workers
        if shard is not None:
            sets = {
                name: [one for one in items if shard.holds(one.name)]
                for name, items in sets.items()
            }
        if self.cluster is None:
            workers = foresee([item for items in sets.values() for item in items], workers)
        with on_cluster(self.cluster, self.workers):
            if shard is None:
                bank, failures = evaluation.train_on_several(
                    sets, training, seed=self.seed, workers=workers
                )
            else:
                sums, failures = gather_several(sets, training, seed=self.seed, workers=workers)
        if shard is None:
            save_trained(self.out, method, bank, photos, training)
            return status_after(failures)
        gathered = Gathered(self.method, training, self.seed, photos, sums)
        file = write_gathered(self.out, shard, gathered)
        used = sum(one.images for one in sums.values())
        tell_done(f"Gram matrices of {counted(used, 'photo')} in {file}")
        return status_after(failures)

    def _pretrained(self, method: Configurable) -> Configurable:
        from skyline_viz.methods.parsing import SceneParsing

        if not isinstance(method, SceneParsing):
            raise UsageError(f"--pretrained is for FCNs and SegNet, not for {method.name}.")
        return replace(method, width=1.0, pretrained=self.pretrained)

    def _train_method(self, sets: Mapping[str, Sequence[DatasetItem]], method: Configurable) -> int:
        from skyline_viz.method import Learner
        from skyline_viz.methods.registry import Trained, save_method

        if self.training != TrainingConfig():
            raise UsageError(f"--preset and --training are for our filter bank, not {self.method}.")
        if self.cluster is not None:
            raise UsageError(f"--cluster is for our filters and sky models, not {self.method}.")
        items = [item for one in sets.values() for item in one]
        dataset = ", ".join(sets)
        workers = foresee(items, self.workers)
        if self.pretrained is not None:
            method = self._pretrained(method)
        if not isinstance(method, Learner):
            raise UsageError(f"the method {self.method} has nothing to learn.")
        good, failures = evaluation.readable(items, workers=workers)
        if not (items := [*good.values()]):
            return status_after(failures)
        fitted = method.fit(items, self.seed)
        seen = tuple(evaluation.fingerprints(items).values())
        trained = Trained(dataset, len(items), self.seed, seen)
        save_method(fitted, self.out, trained)
        tell(f"{method.name}, trained on {counted(len(items), 'photo')} of {dataset}")
        tell_done(f"written  {self.out}, {self.out.stat().st_size:,} bytes")
        return status_after(failures)


def save_trained(
    out: Path, method: Detector, bank: FilterBank, photos: int, training: TrainingConfig
) -> None:
    """Write a detector with what it has learned, and say what that was.

    Args:
        out: File to write.
        method: The detector.
        bank: What it has learned.
        photos: Photos that there were, with a truth or without.
        training: How it has learned.
    """
    trained = replace(method, bank=bank, config=training.detector)
    trained.save(out)
    tell(f"photos used   {bank.provenance.images} of {photos} in {bank.provenance.dataset}")
    tell(f"samples       {bank.samples.sum():,}, flipped ones included")
    tell(f"starved bins  {_starved(bank, training)}")
    tell(f"filters       {bank.size} x {bank.size} pixels")
    tell(f"settings      {training.detector.name}")
    tell(
        f"learned with  reach {training.reach}, smoothness {training.smoothness:g}, "
        f"pooling {training.pooling:g}"
    )
    tell_done(f"written       {out}, {out.stat().st_size:,} bytes")


def _starved(bank: FilterBank, training: TrainingConfig) -> str:
    """How many bins have learned from few samples, and what that means for their filters."""
    from skyline_viz.filter_bank import STARVED_SAMPLES

    said = f"{bank.starved.sum()} of {counted(bank.bins.count, 'bin')}"
    if not bank.starved.any():
        return said
    lean = "lean on the others of their orientation" if training.pooling else "are used as they are"
    return f"{said} had under {STARVED_SAMPLES} samples, which is usual; they {lean}"
