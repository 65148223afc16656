"""What a click says of the line that it is not on.

A click some way off the line says that the line is wrong there, and hardly in that column alone. An
anchor by itself makes a tent: the line goes up to it and straight back, since the wrong ridge still
is the cheaper one. So it is tried what the line would be if it cost more around the click. As far
as that leads along another ridge, the line is left behind, and costs more from then on.
"""

from __future__ import annotations

import numpy as np

from annotate.engine.guide import thinned
from annotate.engine.plan import Plan
from annotate.engine.steering import Left
from annotate.engine.tables import Tables
from skyline_viz.arrays import F32, Int, runs
from skyline_viz.path import APART
from skyline_viz.skyline import Skyline

_PRICE = 3.0  # what a pixel of the line costs more while it is tried, in mean costs of the proposal
_LEAST = 0.1  # the same where the proposal costs next to nothing
_REACH = 4  # the line is tried on either side of the click: a part of the width, one of so many
_MOST = 500  # columns on either side at the most, so that a preview follows the hand
_BAND = 60  # and in a band of a part of the height, one of so many
_WITHIN = 1.0  # pixels to which the piece is known that is left
_ENDS = 2  # columns at either end in which a line crosses over to the other ridge


def price_of(columns: F32, proposal: Skyline, link_weight: float) -> float:
    """What a pixel of a line costs more while it is tried to leave it.

    Args:
        columns: ``(W, H)`` nodal costs, column by column.
        proposal: The cheapest line of all.
        link_weight: Link cost of one pixel of row change.
    """
    rows = proposal.rows.astype(np.int32)
    nodal = columns[np.arange(len(rows)), rows].sum(dtype=np.float64)
    paid = float(nodal + link_weight * np.abs(np.diff(rows)).sum())
    return _PRICE * max(paid / len(rows), _LEAST)


def piece_left(tables: Tables, plan: Plan, rows: Int, column: int, row: int) -> Left | None:
    """The piece of the line that a click leaves behind; None where it leaves none.

    Args:
        tables: Tables of the photo.
        plan: What holds before the click.
        rows: ``(W,)`` row of the line in each column.
        column: Column of the click.
        row: Its row.
    """
    run, away = plan.run_at(column), abs(int(rows[column]) - row)
    if run is None or away <= APART:
        return None
    width, height = len(rows), tables.allowed.shape[1]
    radius = min(max(height // _BAND, APART), away // 2)
    beside = radius + 2  # how far a thick line reaches beyond its end
    reach = min(width // _REACH, _MOST)
    first = max(column - reach, 0 if run.left < 0 else run.left + beside)
    last = min(column + reach, run.right - (1 if run.right == width else beside))
    if not first <= column <= last:
        return None
    tried = Left(thinned(first, rows[first : last + 1], _WITHIN), radius, column)
    found = rows.copy()
    if not tables.follow_past(tried, column, row, plan, found, try_it=True):
        return None
    gone = np.abs(found - rows)[first : last + 1] > radius
    start, stop = next(one for one in runs(gone) if one[0] <= column - first <= one[1])
    start, stop = first + start + _ENDS, first + stop - _ENDS
    if not start <= column <= stop:
        return None
    return Left(thinned(start, rows[start : stop + 1], _WITHIN), max(radius // 2, 1), column)
