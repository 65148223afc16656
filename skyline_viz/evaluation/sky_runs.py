"""Sky models from whole data sets: in several processes, past photos that fail."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, closing, nullcontext
from functools import partial

from skyline_viz.datasets.item import Item
from skyline_viz.methods.extras import needed
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.progress import ProgressBar
from skyline_viz.sky_model import SkyModel
from skyline_viz.sky_training.choosing import Part, chosen
from skyline_viz.sky_training.example_file import ExampleFile
from skyline_viz.sky_training.examples import example_of
from skyline_viz.sky_training.sizes import STEPS, SizeName


def learn_sky(
    datasets: Mapping[str, Sequence[Item]],
    size: SizeName = "small",
    *,
    teacher: SkyModel | None = None,
    steps: int = STEPS,
    seed: int = 0,
    workers: int = 1,
    reading: AbstractContextManager[object] | None = None,
) -> tuple[SkyModel, list[Failure]]:
    """Learn a sky model from several data sets.

    Of more photos than it can see some are chosen before any is read, see `sky_training.choosing`.
    Examples are kept on the disk, see `sky_training.example_file`.

    Args:
        datasets: Name of each data set, for what the file says of itself, and its photos.
        size: How large it is.
        teacher: A network that says what is sky in photos without a truth; these are left out
            without one.
        steps: How many batches of photos it sees.
        seed: The same seed and photos give the same model, on the same machine.
        workers: Number of processes that read the photos, see `batch.run`.
        reading: A block to read them in, such as one on a cluster, which is over before the network
            is fitted.

    Returns:
        The model, called after its size, and the photos that failed.

    Raises:
        MethodError: The packages that train networks are not installed.
        ValueError: There is no photo to learn from.
        StorageError: The disk would not hold the examples.
        OSError: They cannot be written.
    """
    learning = needed("skyline_viz.sky_training.learning", "deep", "a sky model")
    read = chosen(datasets, steps, seed)
    parts = {name: Part(len(items), len(datasets[name])) for name, items in read.items()}
    with closing(ExampleFile(sum(map(len, read.values())))) as examples:
        with reading or nullcontext():
            failures = _gathered(examples, read, teacher, workers)
        if not len(examples):
            reason = f", and the first one failed: {failures[0]}" if failures else "."
            raise ValueError(f"training needs at least one photo with a true skyline{reason}")
        with ProgressBar(steps, "steps") as bar:
            network = learning.learn(
                examples,
                size,
                parts=parts,
                steps=steps,
                seed=seed,
                progress=lambda *_: bar.advance(),
            )
    return SkyModel(f"{size}.onnx", network), failures


def _gathered(
    examples: ExampleFile,
    datasets: Mapping[str, Sequence[Item]],
    teacher: SkyModel | None,
    workers: int,
) -> list[Failure]:
    """Keep what there is to learn from each photo; return those that failed."""
    failures: list[Failure] = []
    for name, items in datasets.items():
        work = partial(example_of, source=name, teacher=teacher)
        for outcome in run(work, items, workers=workers, title=f"photos of {name}"):
            if isinstance(outcome, Failure):
                failures.append(outcome)
            elif outcome is not None:
                examples.append(outcome)
    return failures
