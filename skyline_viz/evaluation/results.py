"""Results of an evaluation: photo by photo, and their summary."""

import math
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields

import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.evaluation.intervals import Interval, resampled
from skyline_viz.evaluation.metrics import (
    Errors,
    called_invisible,
    segmentation_accuracy,
    signed_errors,
)
from skyline_viz.skyline import Skyline


@dataclass(frozen=True)
class PhotoResult:
    """How far the skyline of one photo is from its truth."""

    name: str
    """Name of the photo in its data set."""

    a_err: float
    """Mean distance from the truth over visible columns, in pixels."""

    worst_error: float
    """Largest distance from the truth of any visible column, in pixels."""

    worst_column: int
    """The column where it is."""

    segmentation_accuracy: float
    """Share of pixels rightly called sky or terrain, in [0, 1]."""

    gross_miss: bool
    """Whether ``a_err`` is over 5 % of the height."""

    seconds: float
    """Time that the detection took, reading the file not counted."""

    height: int
    """Rows of the photo."""

    width: int
    """Columns of the photo."""

    called_invisible: float = 0.0
    """Share of the truth's visible columns that the detection calls not visible, in [0, 1]."""

    seen: str = ""
    """What has seen the photo in training, as ``training: exact``, see `seen_in_training`; empty
    where nothing has, as far as is known. With it the error is no test."""

    errors: F32 | None = field(default=None, compare=False, repr=False)
    """``(W,)`` row minus true row of each column, in pixels, NaN where the truth is not visible;
    None in results of somebody's who kept none."""

    @classmethod
    def of(
        cls, name: str, skyline: Skyline, truth: Skyline, height: int, seconds: float = math.nan
    ) -> "PhotoResult":
        """Compare a skyline with the truth.

        Raises:
            SkylineError: The widths differ, a row lies outside `height`, or nothing is visible.
        """
        errors = Errors.of(skyline, truth, height)
        return cls(
            name=name,
            a_err=errors.a_err,
            worst_error=errors.worst_error,
            worst_column=errors.worst_column,
            segmentation_accuracy=segmentation_accuracy(skyline, truth, height),
            gross_miss=errors.gross_miss,
            seconds=seconds,
            height=height,
            width=truth.width,
            called_invisible=called_invisible(skyline, truth),
            errors=signed_errors(skyline, truth).astype(np.float32),
        )


@dataclass(frozen=True)
class Summary:
    """Results over all photos. A few whole-image failures rule the mean, none of them the median.

    Examples:
        >>> results = [PhotoResult.of("a", Skyline([4, 5]), Skyline([4, 4]), height=9)]
        >>> Summary.of(results).mean
        0.5
    """

    photos: int
    """Number of photos."""

    mean: float
    """Mean A_err, in pixels."""

    standard_deviation: float
    """Standard deviation of A_err over these photos (divided by their number), in pixels."""

    median: float
    """Median A_err, in pixels."""

    minimum: float
    """Smallest A_err, in pixels."""

    maximum: float
    """Largest A_err, in pixels."""

    percentile_75: float
    """Three quarters of the photos have an A_err of at most this, in pixels."""

    percentile_90: float
    """Nine in ten have."""

    percentile_95: float
    """Nineteen in twenty have."""

    under_4_px: float
    """Share of photos with an A_err below 4 pixels, in [0, 1]."""

    under_5_px: float
    """Share of photos with an A_err below 5 pixels, in [0, 1]."""

    gross_misses: int
    """Number of photos with an A_err over 5 % of their height."""

    segmentation_accuracy: float
    """Mean over photos of the share of rightly called pixels, in [0, 1]."""

    seconds: float
    """Median time of a detection."""

    called_invisible: float = 0.0
    """Mean over photos of the share of the truth's visible columns called not visible."""

    @classmethod
    def of(cls, results: Sequence[PhotoResult]) -> "Summary":
        """Summarise; all figures of no result at all are NaN, and the counts 0."""
        if not results:
            counts = {"photos": 0, "gross_misses": 0}
            return cls(**{field.name: counts.get(field.name, math.nan) for field in fields(cls)})  # type: ignore[arg-type]
        errors = np.array([result.a_err for result in results])
        return cls(
            photos=len(results),
            mean=float(errors.mean()),
            standard_deviation=float(errors.std()),
            median=float(np.median(errors)),
            minimum=float(errors.min()),
            maximum=float(errors.max()),
            percentile_75=float(np.percentile(errors, 75)),
            percentile_90=float(np.percentile(errors, 90)),
            percentile_95=float(np.percentile(errors, 95)),
            under_4_px=float((errors < 4).mean()),
            under_5_px=float((errors < 5).mean()),
            gross_misses=sum(result.gross_miss for result in results),
            segmentation_accuracy=float(np.mean([r.segmentation_accuracy for r in results])),
            seconds=float(np.median([result.seconds for result in results])),
            called_invisible=float(np.mean([result.called_invisible for result in results])),
        )


def mean_interval(
    results: Sequence[PhotoResult], groups: Mapping[str, Hashable] | None = None
) -> Interval:
    """The 95 % interval of the mean A_err, of photos that are drawn anew, see `resampled`.

    Args:
        results: At least one.
        groups: The group of each photo by its name, see `grouped`: groups are drawn as a whole.
    """
    of = None if groups is None else [groups[one.name] for one in results]
    return resampled([one.a_err for one in results], of)


def worst(results: Iterable[PhotoResult], count: int = 5) -> list[PhotoResult]:
    """The results with the largest A_err, the worst first."""
    return sorted(results, key=lambda result: (-result.a_err, result.name))[:count]
