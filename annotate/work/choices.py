"""Where passes differ in the consensus, and the lines among which somebody decides there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np
import numpy.typing as npt

from annotate.agreement.consensus import WITHIN
from annotate.engine.edits import ORIGINS
from annotate.store.history import State
from annotate.store.labels import Label, named
from annotate.store.operations import Run, Take
from skyline_viz.arrays import runs
from skyline_viz.skyline import Skyline

MOST = 4
"""Lines that are offered."""


@dataclass(frozen=True, eq=False)
class Choice:
    """The line of a pass, or of several that agree in a span."""

    name: str
    """Whose it is."""

    line: Skyline
    """All of it."""

    take: Take
    """What takes it over in the span."""


def spans_apart(state: State, line: Skyline | None) -> list[tuple[int, int]]:
    """First and last column of the spans in which passes differ and nobody has decided.

    Whoever changes the line in a span decides, or which columns are visible there, and whoever
    takes the line of a pass, be it the same.

    Args:
        state: A label of the consensus; of any other there are none.
        line: Its line as it is.
    """
    found = state.consensus
    if found is None or line is None:
        return []
    visible = np.ones(len(line.rows), bool)
    for first, last in found.hidden:
        visible[first : last + 1] = False
    waits = (np.array(found.rows) == line.rows) & (visible == line.visible)  # of all columns
    for change in state.done[state.done.index(found) :]:
        if isinstance(change, Take):
            waits[change.first : change.first + len(change.rows)] = False
    return [(first, last) for first, last in found.apart if waits[first : last + 1].all()]


def nearest_span(spans: Sequence[tuple[int, int]], column: int) -> tuple[int, int]:
    """The span that holds a column, or is nearest to it.

    >>> nearest_span([(3, 5), (20, 29)], 11)
    (3, 5)
    """
    return min(spans, key=lambda span: max(span[0] - column, column - span[1], 0))


def choices(state: State, labels: Sequence[Label], span: tuple[int, int]) -> list[Choice]:
    """The lines of the passes that were compared, those that agree in a span as one.

    Args:
        state: A label of the consensus.
        labels: All labels of its photo.
        span: First and last column.
    """
    of = state.consensus.of if state.consensus else []
    inside = slice(span[0], span[1] + 1)
    alike: list[list[Label]] = []
    for label in labels:
        if label.skyline is None or named(label.annotator, label.number) not in of:
            continue
        for several in alike:
            first = several[0].skyline
            assert first is not None
            if _agree(first, label.skyline, inside):
                several.append(label)
                break
        else:
            alike.append([label])
    return [_choice(several, inside) for several in alike[:MOST]]


def _agree(one: Skyline, other: Skyline, inside: slice) -> bool:
    both = one.visible[inside] & other.visible[inside]
    near = np.abs(one.rows[inside] - other.rows[inside])[both] <= WITHIN
    return bool(near.all()) and np.array_equal(one.visible[inside], other.visible[inside])


def _choice(labels: Sequence[Label], inside: slice) -> Choice:
    names = [named(one.annotator, one.number) for one in labels]
    first, line = labels[0], labels[0].skyline
    assert line is not None
    hidden = [(a + inside.start, b + inside.start) for a, b in runs(~line.visible[inside])]
    take = Take(
        first=inside.start,
        rows=line.rows[inside].astype(int).tolist(),
        origins=runs_of(first.origin[inside]),
        hidden=hidden,
        of=names,
    )
    return Choice(" and ".join(names), line, take)


def runs_of(origins: npt.NDArray[np.uint8]) -> list[Run]:
    """Origins ``(m,)`` as operations write them: each, and in how many columns.

    >>> runs_of(np.array([1, 1, 3], np.uint8))
    [('solved', 2), ('drawn', 1)]
    """
    return [(ORIGINS[one], len(list(many))) for one, many in groupby(origins.tolist())]
