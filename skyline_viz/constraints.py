"""What a path must and must not visit: anchors, straight spans, forbidden pixels."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import Bool, Int


class PathError(ValueError):
    """No path exists, or what was asked for is not valid; the message says why."""


@dataclass(frozen=True, order=True)
class Anchor:
    """A pixel that the path passes through.

    Examples:
        >>> print(Anchor(column=12, row=40))
        the anchor at column 12, row 40
    """

    column: int
    """Column, in pixels from the left."""

    row: int
    """Row, in pixels from the top."""

    def __str__(self) -> str:
        return f"the anchor at column {self.column}, row {self.row}"


@dataclass(frozen=True)
class StraightSpan:
    """Two pixels between which the path is the straight line, however steep.

    Examples:
        >>> StraightSpan(Anchor(column=0, row=10), Anchor(column=2, row=30)).rows()
        array([10, 20, 30])
    """

    start: Anchor
    """Its left end."""

    end: Anchor
    """Its right end, in a later column."""

    def rows(self) -> npt.NDArray[np.intp]:
        """Row in each of its columns, both ends included."""
        length = self.end.column - self.start.column
        steps = np.arange(length + 1) * (self.end.row - self.start.row)
        return self.start.row + (2 * steps + length) // (2 * length)  # halves go down, exactly


@dataclass(frozen=True)
class Constraints:
    """All constraints of one path."""

    anchors: tuple[Anchor, ...] = ()
    """Pixels that the path passes through."""

    straight: tuple[StraightSpan, ...] = ()
    """Spans in which the path is a straight line."""

    forbidden: Bool | None = None
    """``(H, W)`` True where the path must not go."""


def apply_constraints(
    columns: npt.NDArray[np.floating], reach: Int, constraints: Constraints
) -> tuple[npt.NDArray[np.floating], Int]:
    """Express constraints as costs and reach.

    Args:
        columns: ``(W, H)`` nodal costs, column by column.
        reach: ``(W - 1,)`` largest change of row on each link.
        constraints: What to express.

    Returns:
        Copies in which every pixel that must not be visited costs ``inf``, and the links inside
        straight spans reach as far as these need.

    Raises:
        PathError: Outside the photo, or two that fix one column to different rows.

    Examples:
        >>> columns, reach = np.ones((2, 3)), np.array([1], np.int32)
        >>> fixed, _ = apply_constraints(columns, reach, Constraints((Anchor(column=0, row=2),)))
        >>> fixed
        array([[inf, inf,  1.],
               [ 1.,  1.,  1.]])
    """
    columns, reach = columns.copy(), reach.copy()
    width, height = columns.shape
    if constraints.forbidden is not None:
        forbidden = constraints.forbidden
        if forbidden.shape != (height, width) or forbidden.dtype != np.bool_:
            raise PathError(
                f"forbidden is a bool array {(height, width)}, as the costs are, "
                f"not {forbidden.dtype} {forbidden.shape}"
            )
        columns[forbidden.T] = np.inf
    fixed: dict[int, tuple[int, Anchor]] = {}
    for anchor in constraints.anchors:
        _fix(fixed, anchor.column, anchor.row, anchor, (height, width))
    for span in constraints.straight:
        if span.end.column <= span.start.column:
            raise PathError(f"a straight span ends right of its start, {span.start}")
        rows = span.rows()
        for offset, row in enumerate(rows):
            nearer = span.start if 2 * offset < len(rows) else span.end
            _fix(fixed, span.start.column + offset, int(row), nearer, (height, width))
        links = slice(span.start.column, span.end.column)
        reach[links] = np.maximum(reach[links], np.abs(np.diff(rows)))
    for column, (row, anchor) in fixed.items():
        kept = columns[column, row]
        if np.isinf(kept):
            raise PathError(f"{anchor} asks for a forbidden pixel, row {row} of column {column}")
        columns[column] = np.inf
        columns[column, row] = kept
    return columns, reach


def find_conflict(dead_column: int, constraints: Constraints) -> str:
    """Sentence that names what admits no path, given the first column that none reaches."""
    ends = sorted(
        {*constraints.anchors, *(end for s in constraints.straight for end in (s.start, s.end))}
    )
    left = [anchor for anchor in ends if anchor.column < dead_column]
    right = [anchor for anchor in ends if anchor.column >= dead_column]
    names = [
        str(left[-1]) if left else "the left edge",
        str(right[0]) if right else "the right edge",
    ]
    return f"no path leads from {names[0]} to {names[1]} with this delta and these forbidden pixels"


def _fix(
    fixed: dict[int, tuple[int, Anchor]],
    column: int,
    row: int,
    anchor: Anchor,
    shape: tuple[int, int],
) -> None:
    height, width = shape
    if column % 1 or row % 1:
        raise PathError(f"{anchor} does not lie on a whole row and column")
    column, row = int(column), int(row)
    if not (0 <= column < width and 0 <= row < height):
        raise PathError(f"{anchor} lies outside the photo of {width}x{height} pixels")
    if column in fixed and fixed[column][0] != row:
        raise PathError(f"{fixed[column][1]} and {anchor} ask for two rows in column {column}")
    fixed[column] = (row, anchor)
