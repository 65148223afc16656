"""A detection in a few numbers: how wrong it is, where, and how sure it was."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F64
from skyline_viz.evaluation.metrics import Errors, column_errors
from skyline_viz.skyline import Skyline

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
    """First and last column of each run of wrong columns, see `metrics.wrong_segments`."""

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
        if truth is None or np.isnan(column_errors(skyline, truth)).all():
            return cls(None, None, None, None, None, margin, unsure)
        errors = Errors.of(skyline, truth, height)
        return cls(**vars(errors), margin=margin, unsure_column=unsure)
