"""Lines that cannot all be the skyline of one photo."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from skyline_viz.datasets.outlines import FormatError
from skyline_viz.datasets.sky_region import spans_of
from skyline_viz.skyline import Skyline

_SAME = 2.0
"""Rows by which lines may differ that two people drew of one skyline."""

_MEETING = 2
"""Columns in which lines that meet may overlap, however steep they are there."""


def refuse_rivals(
    lines: Iterable[npt.NDArray[np.float64]], what: str = "lines", opening: str = "has"
) -> None:
    """Refuse lines that lie over each other in some columns, and apart.

    Args:
        lines: Rows ``(width,)`` of each, infinite in columns that it does not reach.
        what: What they are, in words.
        opening: How the message begins, to go on after the name of their photo.

    Raises:
        FormatError: Some differ by more than a hand does; the message has no full stop.
    """
    upper = lower = None
    count = 0
    for rows in lines:
        count += 1
        deepest = np.where(np.isfinite(rows), rows, -np.inf)
        upper = rows if upper is None else np.minimum(upper, rows)
        lower = deepest if lower is None else np.maximum(lower, deepest)
    if upper is None or lower is None or count < 2:
        return
    apart = np.where(np.isfinite(upper), lower, 0) - np.where(np.isfinite(upper), upper, 0)
    columns = np.flatnonzero(apart > _SAME)
    if len(columns) > min(_MEETING, len(upper) // 2):
        number = "two" if count == 2 else f"{count}"
        raise FormatError(
            f"{opening} {number} {what} that differ by up to {apart.max():.4g} px in "
            f"{spans_of(columns)}; none is imported"
        )


def seen_rows(skyline: Skyline) -> npt.NDArray[np.float64]:
    """Rows ``(width,)`` of a skyline, infinite where it is not visible."""
    return np.where(skyline.visible, skyline.rows.astype(np.float64), np.inf)


def difference(one: Skyline, other: Skyline) -> str | None:
    """How two skylines of one width differ, to end a sentence; None where they do not."""
    both = one.visible & other.visible
    apart = np.where(both, np.abs(one.rows - other.rows), 0)
    if apart.any():
        return f"differ by up to {apart.max():.4g} px in {spans_of(np.flatnonzero(apart))}"
    hidden = np.flatnonzero(one.visible != other.visible)
    return f"differ in what is visible in {spans_of(hidden)}" if len(hidden) else None
