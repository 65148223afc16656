"""Runs of columns in which the line cannot be seen."""

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from annotate.engine.hidden import Hidden, hidden_too, shown_again

WIDTH = 30
PLACES = st.integers(0, WIDTH - 1)
CHANGES = st.lists(st.tuples(PLACES, PLACES, st.sampled_from([None, "", "fog", "cloud"])))


@given(CHANGES)
def test_each_column_is_as_it_was_said_last_and_runs_are_whole(changes):
    spans, columns = (), [None] * WIDTH
    for one, other, why in changes:
        first, last = sorted((one, other))
        if why is None:
            spans = shown_again(spans, first, last)
        else:
            spans = hidden_too(spans, Hidden(first, last, why))
        columns[first : last + 1] = [why] * (last + 1 - first)
    found = [None] * WIDTH
    for first, last, why in spans:
        found[first : last + 1] = [why] * (last + 1 - first)
    assert found == columns
    for before, after in pairwise(spans):
        assert before.last < after.first
        assert before.last + 1 < after.first or before.why != after.why
