"""Tables that are swept again in part, against tables that are swept whole."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from annotate.engine import tables as module
from annotate.engine.edits import Edits
from annotate.engine.plan import make_plan
from annotate.engine.tables import BACKWARD, FORWARD, Tables
from testing.examples import examples

HEIGHT, WIDTH, DELTA, LINK = 14, 90, 3, 0.05

COLUMNS, ROWS = st.integers(0, WIDTH - 1), st.integers(0, HEIGHT - 1)
ACTS = st.one_of(
    st.tuples(st.just("anchor"), COLUMNS, ROWS),
    st.tuples(st.just("remove"), COLUMNS, ROWS),
    st.tuples(st.just("forbid"), COLUMNS, ROWS),
    st.tuples(st.just("allow"), COLUMNS, ROWS),
    st.tuples(st.just("draw"), COLUMNS, ROWS),
    st.tuples(st.just("undo"), COLUMNS, ROWS),
)


def after(edits, history, what, column, row):
    if what == "anchor":
        return edits.anchor(column, row)
    if what == "remove":
        return edits.remove(min(edits.anchors)) if edits.anchors else edits
    if what == "draw":
        return edits.draw(column, [row] * min(5, WIDTH - column))
    if what == "undo":
        return history[row % len(history)]
    return edits.forbid([(column, row), (column + 3, row)], row % 3, allow=what == "allow")


def by_column(table, free):
    """Columns less their lowest cost: an amount that is the same for a column says nothing."""
    lowest = table.min(axis=1, keepdims=True)
    return np.where(np.isfinite(table), table - np.where(np.isfinite(lowest), lowest, 0), np.inf)[
        free
    ]


@examples(150)
@given(
    st.integers(0, 20),
    st.lists(st.tuples(ACTS, st.sampled_from(["forward", "both", "measure"])), max_size=12),
)
def test_what_is_swept_in_part_is_what_a_whole_sweep_gives(seed, acts):
    cost = np.random.default_rng(seed).random((WIDTH, HEIGHT)).astype(np.float32)
    edits = Edits(HEIGHT, WIDTH)
    history = [edits]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "_STRIDE", 4)
        kept = Tables(cost, DELTA, LINK)
        for act, asked in acts:
            edits = after(edits, history, *act)
            history.append(edits)
            plan = make_plan(edits, DELTA)
            if asked == "measure":
                kept.measure(plan, 17)
            else:
                kept.sweep_for(plan, *((FORWARD, BACKWARD) if asked == "both" else (FORWARD,)))
        plan = make_plan(edits, DELTA)
        margins = kept.margins(plan)
    fresh = Tables(cost, DELTA, LINK)
    wanted = fresh.margins(plan)
    np.testing.assert_array_equal(kept.allowed, fresh.allowed)
    for one, other in ((kept.forward, fresh.forward), (kept.backward, fresh.backward)):
        np.testing.assert_allclose(
            by_column(one, plan.free), by_column(other, plan.free), atol=1e-6
        )
    np.testing.assert_allclose(margins, wanted, atol=1e-6)


@pytest.fixture
def swept(monkeypatch):
    """Columns that are swept."""
    done = []
    real = module.sweep
    monkeypatch.setattr(
        module, "sweep", lambda *words: done.append(abs(words[5] - words[4])) or real(*words)
    )
    return done


def test_far_from_a_change_nothing_is_swept_again(swept):
    width = 3000
    cost = np.random.default_rng(1).random((width, HEIGHT)).astype(np.float32)
    tables = Tables(cost, DELTA, LINK)
    edits = Edits(HEIGHT, width)
    tables.sweep_for(make_plan(edits, DELTA), FORWARD, BACKWARD)
    assert sum(swept) == 2 * (width - 1)
    swept.clear()
    tables.sweep_for(make_plan(edits.forbid([(1500, 5)], 3), DELTA), FORWARD, BACKWARD)
    assert 0 < sum(swept) < 600
    swept.clear()
    tables.sweep_for(make_plan(edits, DELTA), FORWARD)
    assert 0 < sum(swept) < 300


def test_margins_are_measured_in_pieces(swept):
    cost = np.random.default_rng(1).random((WIDTH, HEIGHT)).astype(np.float32)
    tables = Tables(cost, DELTA, LINK)
    plan = make_plan(Edits(HEIGHT, WIDTH).anchor(40, 5), DELTA)
    assert [tables.measure(plan, 30) for _ in range(4)] == [59, 29, 0, 0]
    assert np.isinf(tables.margins(plan)[40])
