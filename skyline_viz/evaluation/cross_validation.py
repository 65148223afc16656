"""How good a detector is on a data set: a filter bank put to the test, and cross-validation."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cache, partial, reduce
from operator import add
from typing import Any

import numpy as np

from skyline_viz.config import FILTER_SIZES, DetectorConfig, TrainingConfig
from skyline_viz.datasets.layouts import DatasetItem
from skyline_viz.detector import Detector
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.filter_bank import FilterBank, FilterBankError
from skyline_viz.method import Method
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.resume import Codec, Kept, digest_of, digest_of_item, digest_of_method
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.training import GramMatrices, gather, solve


def evaluate(
    items: Sequence[DatasetItem],
    detector: Detector,
    *,
    workers: int = 1,
    kept: Kept | None = None,
) -> tuple[list[PhotoResult], list[Failure]]:
    """Detect the skylines of photos that have a truth, and compare.

    Args:
        items: Photos with truth.
        detector: The detector.
        workers: Number of processes, see `batch.run`.
        kept: Where finished photos are kept; nowhere unless given.

    Returns:
        The results in the order of `items`, and the photos that failed.
    """
    tests = tests_of(items, {item.name: detector for item in items}, kept)
    return run_tests(tests, workers, kept)


def cross_validate(
    items: Sequence[DatasetItem],
    folds: int,
    *,
    config: DetectorConfig | None = None,
    training: TrainingConfig | None = None,
    seed: int = 0,
    workers: int = 1,
    kept: Kept | None = None,
) -> tuple[list[PhotoResult], list[Failure]]:
    """Test each photo with a filter bank that was trained on the photos of all other folds.

    Photo ``i`` in the order of names is in fold ``i % folds``. Each photo is looked at once for
    training: Gram matrices add up, so those of the other folds are summed, whichever they are.

    Args:
        items: Photos with truth.
        folds: Number of folds, from 2 to the number of photos.
        config: How to detect.
        training: How to train; unless given, with the edges of `config`.
        seed: Seed of the negative samples.
        workers: Number of processes, see `batch.run`.
        kept: Where finished photos and trained banks are kept; nowhere unless given.

    Returns:
        The results by name, and the photos that failed.

    Raises:
        ValueError: There are too few photos for so many folds.
    """
    detectors, failures = fold_detectors(
        items, folds, config=config, training=training, seed=seed, workers=workers, kept=kept
    )
    tests = sorted(tests_of(items, detectors, kept), key=lambda test: test.name)
    results, more = run_tests(tests, workers, kept)
    return results, failures + more


def fold_detectors(
    items: Sequence[DatasetItem],
    folds: int,
    *,
    config: DetectorConfig | None = None,
    training: TrainingConfig | None = None,
    seed: int = 0,
    workers: int = 1,
    kept: Kept | None = None,
) -> tuple[dict[str, Detector], list[Failure]]:
    """For each photo a detector that was trained on the photos of all other folds.

    Takes what `cross_validate` takes.

    Returns:
        The detectors by the name of the photo, and the photos that failed.

    Raises:
        ValueError: There are too few photos for so many folds.
    """
    items = sorted(items, key=lambda item: item.name)
    if not 2 <= folds <= len(items):
        raise ValueError(f"folds is a number from 2 to the {len(items)} photos, not {folds}")
    config = config or DetectorConfig()
    training = training or TrainingConfig(detector=config)
    key = ""
    if kept and kept.folder:
        contents = [_content(item) for item in items]
        key = digest_of("folds", folds, seed, training, contents)
        if known := _kept_banks(kept, key, folds):
            banks, of, failed = known
            return {name: Detector(banks[fold], config) for name, fold in of.items()}, failed
    sums = [GramMatrices.empty(training)] * folds
    usable: list[tuple[int, DatasetItem]] = []
    failures: list[Failure] = []
    gathered = run(partial(gather_item, training, seed), items, workers=workers, title="training")
    for index, outcome in enumerate(gathered):
        if isinstance(outcome, Failure):
            failures.append(outcome)
        else:
            sums[index % folds] += outcome
            usable.append((index % folds, items[index]))
    detectors: dict[str, Detector] = {}
    for fold in range(folds):
        others = reduce(add, (gram for other, gram in enumerate(sums) if other != fold))
        detector = Detector(solve(others, seed, training), config)
        detectors |= {item.name: detector for of, item in usable if of == fold}
        if kept and kept.folder:
            detector.bank.save(kept.folder / f"{key}-{fold}.npz")
    if kept and kept.folder:
        told = [[failure.name, failure.reason] for failure in failures]
        kept.keep(key, {"of": {item.name: fold for fold, item in usable}, "failed": told})
    return detectors, failures


def _kept_banks(
    kept: Kept, key: str, folds: int
) -> tuple[list[FilterBank], dict[str, int], list[Failure]] | None:
    """Banks that an earlier run has trained, the fold of each photo, and photos that failed."""
    record = kept.find(key)
    if record is None or kept.folder is None:
        return None
    try:
        banks = [FilterBank.load(kept.folder / f"{key}-{fold}.npz") for fold in range(folds)]
    except FilterBankError:
        return None
    return banks, record["of"], [Failure(name, reason) for name, reason in record["failed"]]


def _content(item: DatasetItem) -> str:
    """Digest of a photo; of one that cannot be read, which fails in its turn, of its name."""
    try:
        return digest_of_item("", item)
    except OSError:
        return item.name


def train_on(
    items: Sequence[DatasetItem],
    training: TrainingConfig,
    *,
    seed: int = 0,
    dataset: str = "",
    workers: int = 1,
) -> tuple[FilterBank, list[Failure]]:
    """Learn a filter bank from photos that have a truth, in several processes.

    Returns:
        The bank, the very one that `training.train` gives, and the photos that failed.

    Raises:
        ValueError: Every single photo failed, or there is none.
    """
    total, failures = _gather_all(items, training, seed, workers)
    return solve(total, seed, training, dataset), failures


def train_sizes(
    items: Sequence[DatasetItem],
    training: TrainingConfig,
    *,
    seed: int = 0,
    dataset: str = "",
) -> tuple[list[FilterBank], list[Failure]]:
    """Learn a filter bank of every size, of `FILTER_SIZES`; each photo is looked at once.

    Takes what `train_on` takes. Works in this process: Gram matrices of the largest filters, 120
    MB, are dear to send.

    Returns:
        The banks that `train_on` gives with each size, smallest first, and the photos that failed.

    Raises:
        ValueError: Every single photo failed, or there is none.
    """
    total, failures = _gather_all(items, replace(training, filter_size=FILTER_SIZES[-1]), seed)
    banks = [
        solve(total.cropped(size), seed, replace(training, filter_size=size), dataset)
        for size in FILTER_SIZES
    ]
    return banks, failures


def _gather_all(
    items: Sequence[DatasetItem], training: TrainingConfig, seed: int, workers: int = 1
) -> tuple[GramMatrices, list[Failure]]:
    """Summed Gram matrices of all photos, and the photos that failed."""
    total = GramMatrices.empty(training)
    failures = []
    work = partial(gather_item, training, seed)
    for outcome in run(work, items, workers=workers, title="training"):
        if isinstance(outcome, Failure):
            failures.append(outcome)
        else:
            total += outcome
    if total.images == 0:
        reason = f", and the first one failed: {failures[0]}" if failures else "."
        raise ValueError(f"training needs at least one photo with a true skyline{reason}")
    return total, failures


def gather_item(training: TrainingConfig, seed: int, item: DatasetItem) -> GramMatrices:
    """Gram matrices of one photo of a data set.

    Raises:
        PhotoError: The photo cannot be read.
        SkylineError: It has no truth, or one that does not fit.
    """
    truth = _truth(item)  # first: without it there is no need to read the photo
    return gather(item.photo(), truth, seed, training)


@cache
def warm_up() -> None:
    """Load the compiled loops of this process, lest the first photo's time include that."""
    photo = np.full((32, 32, 3), 200, np.uint8)
    photo[16:] = 50
    Detector().detect(photo)


@dataclass(frozen=True)
class Test:
    """A photo, and the detector that it is tested with."""

    item: DatasetItem
    detector: Method
    digest: str = ""
    """Of the detector, where results are kept."""

    @property
    def name(self) -> str:
        """The photo's name."""
        return self.item.name


def tests_of(
    items: Iterable[DatasetItem], detectors: Mapping[str, Method], kept: Kept | None = None
) -> list[Test]:
    """The photos that have a detector, by their names, each with its own."""
    digests: dict[int, str] = {}
    if kept and kept.folder:
        different = {id(one): one for one in detectors.values()}
        digests = {number: digest_of_method(one) for number, one in different.items()}
    pairs = [(item, detectors[item.name]) for item in items if item.name in detectors]
    return [Test(item, one, digests.get(id(one), "")) for item, one in pairs]


def run_tests(
    tests: Sequence[Test], workers: int = 1, kept: Kept | None = None, title: str = "photos"
) -> tuple[list[PhotoResult], list[Failure]]:
    """Results in order, and the photos that failed.

    Args:
        tests: Photos and their detectors.
        workers: Number of processes, see `batch.run`.
        kept: Where finished photos are kept; nowhere unless given.
        title: What is counted, for the progress bar.
    """
    codec: Codec[PhotoResult] = Codec(asdict, _result)
    key, kept = partial(key_of, "result"), kept or Kept()
    outcomes = kept.run(test_photo, tests, key, codec, workers=workers, title=title)
    return _parted(outcomes)


def key_of(what: str, test: Test) -> str:
    """Digest of all that a result is made from.

    Args:
        what: Kind and settings of the result.
        test: The photo and its detector.
    """
    return digest_of_item(f"{what} {test.digest}", test.item)


def _result(record: dict[str, Any]) -> PhotoResult:
    return PhotoResult(**record)


def test_photo(test: Test) -> PhotoResult:
    """Detect and compare with the truth."""
    return _detect_and_compare(test.detector, test.item)


def _detect_and_compare(detector: Method, item: DatasetItem) -> PhotoResult:
    truth = _truth(item)
    photo = item.photo()
    warm_up()
    found = detector.detect(photo)
    return PhotoResult.of(item.name, found.skyline, truth, len(photo), found.total_seconds)


def _truth(item: DatasetItem) -> Skyline:
    truth = item.truth()
    if truth is None:
        raise SkylineError("there is no truth")
    return truth


def _parted(
    outcomes: Iterable[PhotoResult | Failure],
) -> tuple[list[PhotoResult], list[Failure]]:
    results: list[PhotoResult] = []
    failures: list[Failure] = []
    for outcome in outcomes:
        if isinstance(outcome, Failure):
            failures.append(outcome)
        else:
            results.append(outcome)
    return results, failures
