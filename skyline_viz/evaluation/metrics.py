"""How far a skyline is from the truth. Every metric counts the columns in which it is visible.

What a detection itself calls visible changes nothing: it cannot get better by looking away.
"""

from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F64, runs
from skyline_viz.skyline import Skyline, SkylineError

GROSS_MISS_SHARE = 0.05
"""A_err above this share of the image height is a gross miss."""


TOLERANCE = 4.0
"""Error up to which a column is right, in pixels at `REFERENCE_HEIGHT` rows; beyond it is wrong.

Four pixels are what the papers count as a good line, and twice what labels are accurate to."""

REFERENCE_HEIGHT = 519
"""Rows of the photos for which lengths in pixels are meant; on larger photos they are larger."""

SEGMENT_GAP = 5
"""Wrong columns with at most this many right ones between them belong to one segment."""


def scaled(pixels: float, height: int) -> float:
    """A length that is meant for photos of `REFERENCE_HEIGHT` rows, on a photo of `height` rows.

    >>> scaled(4, 519), scaled(4, 240), scaled(4, 1038)
    (4, 4, 8.0)
    """
    return pixels if height <= REFERENCE_HEIGHT else pixels * height / REFERENCE_HEIGHT


def wrong_segments(
    errors: F64, height: int, tolerance: float | None = None
) -> tuple[tuple[int, int], ...]:
    """First and last column of each run of wrong columns; a few right ones do not end it.

    >>> wrong_segments(np.array([0, 9, 9, 0, 9, 0, 0, 0, 0, 0, 0, 9.0]), height=100)
    ((1, 4), (11, 11))

    Args:
        errors: ``(W,)`` in pixels; NaN where there is no truth.
        height: Rows of the photo.
        tolerance: Error up to which a column is right, in pixels; `TOLERANCE`, scaled for photos
            of more than `REFERENCE_HEIGHT` rows, unless given.
    """
    allowed = scaled(TOLERANCE, height) if tolerance is None else tolerance
    return tuple(runs(errors > allowed, SEGMENT_GAP))  # NaN is not greater


def signed_errors(skyline: Skyline, truth: Skyline) -> F64:
    """``row - truth row`` in pixels, ``(W,)``, below the truth more than 0; NaN where it is hidden.

    Raises:
        SkylineError: The widths differ.

    Examples:
        >>> signed_errors(Skyline(rows=[4, 5]), Skyline(rows=[6, 4]))
        array([-2.,  1.])
    """
    if skyline.width != truth.width:
        raise SkylineError(
            f"the skyline has {skyline.width} columns, the truth {truth.width}; they must match"
        )
    return np.where(truth.visible, skyline.rows.astype(np.float64) - truth.rows, np.nan)


def column_errors(skyline: Skyline, truth: Skyline) -> F64:
    """Distance ``|row - truth row|`` in pixels, ``(W,)``; NaN where the truth is not visible.

    Raises:
        SkylineError: The widths differ.

    Examples:
        >>> hidden = Skyline(rows=[4, 4, 4], visible=[True, False, True])
        >>> column_errors(Skyline(rows=[4, 5, 6]), hidden)
        array([ 0., nan,  2.])
        >>> column_errors(hidden, Skyline(rows=[4, 5, 6]))
        array([0., 1., 2.])
    """
    return np.abs(signed_errors(skyline, truth))


def a_err(skyline: Skyline, truth: Skyline) -> float:
    r"""Average pixel-wise absolute distance, in pixels (equation 27 of the paper).

    $$
    A_{err} = \frac{1}{N} \sum_{j=1}^{N} | P_{d(j)} - P_{g(j)} |
    $$

    The sum runs over the columns in which the truth is visible.

    Raises:
        SkylineError: The widths differ, or the truth is visible nowhere.

    Examples:
        >>> a_err(Skyline(rows=[4, 5, 6]), Skyline(rows=[4, 4, 4]))
        1.0
    """
    errors = column_errors(skyline, truth)
    errors = errors[~np.isnan(errors)]
    if len(errors) == 0:
        raise SkylineError("the truth is visible in no column")
    return float(errors.mean())


def segmentation_accuracy(skyline: Skyline, truth: Skyline, height: int) -> float:
    """Share of pixels that both call sky or both call terrain, where the truth is visible.

    Raises:
        SkylineError: The widths differ, a row lies outside `height`, or nothing is visible.

    Examples:
        >>> segmentation_accuracy(Skyline(rows=[4, 5, 6]), Skyline(rows=[4, 4, 4]), height=10)
        0.9
    """
    whole = [
        Skyline(line.pixel_rows(height).astype(np.float32), line.visible)
        for line in (skyline, truth)
    ]
    return 1.0 - a_err(*whole) / height


def called_invisible(skyline: Skyline, truth: Skyline) -> float:
    """Share of the truth's visible columns that a skyline calls not visible, in [0, 1].

    Raises:
        SkylineError: The widths differ, or the truth is visible nowhere.

    Examples:
        >>> called_invisible(Skyline([4, 5], visible=[True, False]), Skyline([4, 4]))
        0.5
    """
    counts = ~np.isnan(column_errors(skyline, truth))
    if not counts.any():
        raise SkylineError("the truth is visible in no column")
    return float(1 - skyline.visible[counts].mean())


def is_gross_miss(error: float, height: int) -> bool:
    """Whether an A_err in pixels is over 5 % of the image height in pixels.

    Examples:
        >>> is_gross_miss(20.0, height=519), is_gross_miss(30.0, height=519)
        (False, True)
    """
    return error > GROSS_MISS_SHARE * height


@dataclass(frozen=True)
class Errors:
    """What a skyline's distance from the truth comes to."""

    a_err: float
    """Mean error over the visible columns, in pixels."""

    worst_column: int
    """Column with the largest error."""

    worst_error: float
    """Its error, in pixels."""

    gross_miss: bool
    """Whether `a_err` is over 5 % of the image height."""

    segments: tuple[tuple[int, int], ...]
    """First and last column of each run of wrong columns, see `wrong_segments`."""

    @classmethod
    def of(cls, skyline: Skyline, truth: Skyline, height: int) -> "Errors":
        """Compare a skyline with the truth, on a photo of `height` rows.

        Raises:
            SkylineError: The widths differ, or the truth is visible nowhere.
        """
        errors = column_errors(skyline, truth)
        mean = a_err(skyline, truth)
        worst = int(np.nanargmax(errors))
        return cls(
            a_err=mean,
            worst_column=worst,
            worst_error=float(errors[worst]),
            gross_miss=is_gross_miss(mean, height),
            segments=wrong_segments(errors, height),
        )
