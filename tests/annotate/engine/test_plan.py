"""What of a line is fixed, what is solved between it, and what is stale after a change."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from annotate.engine.edits import Edits
from annotate.engine.plan import Run, make_plan

HEIGHT, WIDTH = 30, 40
COLUMNS, ROWS = st.integers(0, WIDTH - 1), st.integers(0, HEIGHT - 1)


def edits_with(anchors, spans=()):
    edits = Edits(HEIGHT, WIDTH)
    for first, row, length in spans:
        edits = edits.draw(first, [row] * min(length, WIDTH - first))
    for column, row in anchors.items():
        edits = edits.anchor(column, row)
    return edits


some_edits = st.builds(
    edits_with,
    st.dictionaries(COLUMNS, ROWS, max_size=4),
    st.lists(st.tuples(COLUMNS, ROWS, st.integers(1, 9)), max_size=2),
)


def test_nothing_asked_for_is_one_run_from_edge_to_edge():
    assert make_plan(Edits(HEIGHT, WIDTH), 3).runs == (Run(-1, None, WIDTH, None),)


def test_what_is_steeper_than_delta_is_straight():
    plan = make_plan(edits_with({10: 5, 14: 20}), delta=3)
    assert plan.fixed[10:15].tolist() == [5, 9, 13, 16, 20]
    assert np.flatnonzero(plan.straight).tolist() == [11, 12, 13]
    solved = make_plan(edits_with({10: 5, 14: 17}), delta=3)
    assert not solved.straight.any()
    assert solved.run_at(12) == Run(10, 5, 14, 17)
    assert solved.run_at(10) is None


def test_without_a_delta_all_is_straight_and_level_to_the_edges():
    plan = make_plan(edits_with({10: 5, 30: 25}), delta=None)
    assert not plan.free.any()
    assert set(plan.fixed[:11]) == {5}
    assert set(plan.fixed[30:]) == {25}
    assert (np.diff(plan.fixed[10:31]) == 1).all()


@given(some_edits)
def test_runs_and_fixed_columns_are_the_whole_line(edits):
    plan = make_plan(edits, 2)
    free = np.zeros(WIDTH, bool)
    for run in plan.runs:
        assert not free[run.left + 1 : run.right].any()
        free[run.left + 1 : run.right] = True
        assert run.left_row == (int(plan.fixed[run.left]) if run.left >= 0 else None)
        assert run.right_row == (int(plan.fixed[run.right]) if run.right < WIDTH else None)
    np.testing.assert_array_equal(free, plan.free)
    for column, row in edits.anchors.items():
        assert plan.fixed[column] == row


@given(some_edits, some_edits, st.none() | st.tuples(COLUMNS, COLUMNS).map(sorted))
def test_what_is_not_stale_depends_on_nothing_that_changed(before, after, changed):
    """A table from the left may be kept up to a column when the run began there before, and so on.

    What the tables of a run hold is told by names here: from which pixel they come, and whether
    a changed column lies on the way.
    """
    old, new = make_plan(before, 2), make_plan(after, 2)
    for forward in (True, False):
        tables = _swept(old, forward, range(WIDTH), {}, "old")
        touched = range(changed[0], changed[1] + 1) if changed else ()
        for part in (one for one in new.stale(old, changed) if one.forward == forward):
            step = 1 if forward else -1
            again = range(part.first, part.last + step, step)
            tables |= _swept(new, forward, again, tables, "new")
        wanted = _swept(new, forward, range(WIDTH), {}, "any")
        for run in new.runs:
            for column in range(run.left + 1, run.right):
                assert tables[column][0] == wanted[column][0]
                on_the_way = (
                    range(run.left + 1, column + 1) if forward else range(column, run.right)
                )
                if set(on_the_way) & set(touched):
                    assert tables[column][1] == "new"


def _swept(plan, forward, columns, tables, name):
    """For each column the pixel that a sweep of its run begins at, and the sweep's name."""
    found = {}
    for column in columns:
        if run := plan.run_at(column):
            begins = (run.left, run.left_row) if forward else (run.right, run.right_row)
            found[column] = (begins, name)
    return found


def test_equal_plans_have_nothing_that_is_stale():
    edits = edits_with({5: 6, 20: 7})
    assert make_plan(edits, 3) == make_plan(edits, 3)
    assert make_plan(edits, 3) != make_plan(edits.anchor(9, 9), 3)
    assert make_plan(edits, 3).stale(make_plan(edits, 3), None) == []
    assert len(make_plan(edits, 3).stale(None, None)) == 6
