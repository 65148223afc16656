"""A detection in a few numbers: how wrong it is, where, and how sure it was."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F64
from skyline_viz.evaluation.metrics import column_errors, is_gross_miss
from skyline_viz.skyline import Skyline

WRONG_SHARE = 0.01
"""A column is wrong when its error exceeds this share of the image height (5 px at 519 rows)."""

SEGMENT_GAP = 5
"""Wrong columns with at most this many right ones between them belong to one segment."""

UNSURE_PERCENTILE = 5.0
"""The margin of a photo is this percentile of the margins of its columns."""


@dataclass(frozen=True)
class Verdict:
    """What a detection comes to. Errors need a truth, and are None without one."""

    a_err: float | None
    """Mean error over the visible columns, in pixels."""

    worst_column: int | None
    """Column with the largest error."""

    worst_error: float | None
    """Its error, in pixels."""

    gross_miss: bool | None
    """Whether `a_err` is over 5 % of the image height."""

    segments: tuple[tuple[int, int], ...] | None
    """First and last column of each run of wrong columns."""

    margin: float
    """How sure the path is: the `UNSURE_PERCENTILE` of its margins, a cost; small is uncertain."""

    unsure_column: int
    """Column with the smallest margin."""

    @classmethod
    def of(cls, skyline: Skyline, margins: F64, height: int, truth: Skyline | None) -> Verdict:
        """Sum up a detected skyline.

        Args:
            skyline: The detected line.
            margins: ``(W,)`` its margins, see `path.margins`.
            height: Rows of the photo.
            truth: The true line; one that is visible nowhere counts as none.

        Raises:
            SkylineError: The widths differ.
        """
        margin = float(np.percentile(margins, UNSURE_PERCENTILE, method="lower"))
        unsure = int(margins.argmin())
        errors = column_errors(skyline, truth) if truth else np.full(skyline.width, np.nan)
        if np.isnan(errors).all():
            return cls(None, None, None, None, None, margin, unsure)
        worst = int(np.nanargmax(errors))
        mean = float(np.nanmean(errors))
        return cls(
            a_err=mean,
            worst_column=worst,
            worst_error=float(errors[worst]),
            gross_miss=is_gross_miss(mean, height),
            segments=wrong_segments(errors, height),
            margin=margin,
            unsure_column=unsure,
        )


def wrong_segments(errors: F64, height: int) -> tuple[tuple[int, int], ...]:
    """First and last column of each run of wrong columns.

    >>> wrong_segments(np.array([0, 9, 9, 0, 9, 0, 0, 0, 0, 0, 0, 9.0]), height=100)
    ((1, 4), (11, 11))

    Args:
        errors: ``(W,)`` in pixels; NaN where there is no truth.
        height: Rows of the photo.
    """
    wrong = np.flatnonzero(errors > WRONG_SHARE * height)  # NaN is not greater
    if len(wrong) == 0:
        return ()
    runs = np.split(wrong, np.flatnonzero(np.diff(wrong) > SEGMENT_GAP + 1) + 1)
    return tuple((int(run[0]), int(run[-1])) for run in runs)
