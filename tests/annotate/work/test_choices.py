"""Where passes differ in the consensus, and the lines among which somebody decides."""

import numpy as np
import pytest

from annotate.engine.edits import Edits
from annotate.store.history import State
from annotate.store.operations import Consensus, Take
from annotate.work.choices import choices, nearest_span, spans_apart
from skyline_viz.skyline import Skyline
from testing.labels import made

LINE = Skyline(rows=[10] * 100)


def state(of, apart):
    operation = Consensus(first=0, rows=[10] * 100, origins=[("solved", 100)], of=of, apart=apart)
    return State(Edits(48, 100)).after(operation, 1.0, 1)


def test_spans_wait_until_somebody_has_changed_the_line_there():
    waiting = state(["ann", "bob"], [(20, 29), (60, 69)])
    assert spans_apart(waiting, LINE) == [(20, 29), (60, 69)]
    rows = LINE.rows.copy()
    rows[64] = 12
    assert spans_apart(waiting, Skyline(rows=rows)) == [(20, 29)]
    assert spans_apart(waiting, None) == []
    kept = Take(first=20, rows=[10] * 10, origins=[("solved", 10)], of=["ann"])  # as it is
    assert spans_apart(waiting.after(kept, 2.0, 2), LINE) == [(60, 69)]
    assert spans_apart(State(Edits(48, 100)), LINE) == []


def test_whoever_hides_columns_or_shows_them_has_decided():
    operation = Consensus(
        first=0,
        rows=[10] * 100,
        origins=[("solved", 100)],
        hidden=[(60, 69)],
        of=["ann", "bob"],
        apart=[(20, 29), (60, 69)],
    )
    waiting = State(Edits(48, 100)).after(operation, 1.0, 1)
    visible = np.ones(100, bool)
    visible[60:70] = False
    assert spans_apart(waiting, Skyline(rows=[10] * 100, visible=visible)) == [(20, 29), (60, 69)]
    visible[22:25] = False
    assert spans_apart(waiting, Skyline(rows=[10] * 100, visible=visible)) == [(60, 69)]
    visible[60:70] = True
    assert spans_apart(waiting, Skyline(rows=[10] * 100, visible=visible)) == []


@pytest.mark.parametrize(
    ("column", "span"), [(0, (20, 29)), (25, (20, 29)), (44, (20, 29)), (46, (60, 69))]
)
def test_the_span_at_the_cursor_is_meant(column, span):
    assert nearest_span([(20, 29), (60, 69)], column) == span


def test_lines_that_agree_in_the_span_are_one_choice():
    far = np.full(100, 10)
    far[20:30], far[60:70] = 30, 40
    labels = [
        made([10] * 100),
        made(far, "bob", origin=[3] * 50 + [1] * 50),
        made(np.where(np.arange(100) < 50, 11, 90), "eve"),
        made([80] * 100, "fred"),
    ]
    found = choices(state(["ann", "bob", "eve"], [(20, 29)]), labels, (20, 29))
    assert [one.name for one in found] == ["ann and eve", "bob"]
    assert found[1].take == Take(
        first=20, rows=[30] * 10, origins=[("drawn", 10)], hidden=[], of=["bob"]
    )


def test_who_does_not_see_the_line_there_is_another_choice():
    visible = np.ones(100, bool)
    visible[25:28] = False
    labels = [made([10] * 100), made([10] * 100, "bob", visible=visible)]
    found = choices(state(["ann", "bob"], [(20, 29)]), labels, (20, 29))
    assert [one.take.hidden for one in found] == [[], [(25, 27)]]


def test_no_more_lines_are_offered_than_there_are_keys():
    labels = [made([10 * place] * 100, f"p{place}") for place in range(6)]
    found = choices(state([f"p{place}" for place in range(6)], [(0, 9)]), labels, (0, 9))
    assert len(found) == 4
