"""What steers a line: here sides, all above which is sky or all below which is terrain."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from annotate.engine.edits import EditError, Edits
from annotate.engine.live_wire import LiveWire
from annotate.engine.steering import FORBIDDEN, FREE, Left, paint, side_of
from testing.examples import examples
from testing.labelling import DETECTOR, hills

SIZE = HEIGHT, WIDTH = 48, 70
POINTS = st.lists(
    st.tuples(st.integers(-9, WIDTH + 9), st.integers(-9, HEIGHT + 9)), min_size=1, max_size=5
)


@examples(100)
@given(POINTS, st.sampled_from(["sky", "terrain"]))
def test_a_side_forbids_all_beyond_its_stroke_and_leaves_a_way(points, ground):
    side = side_of(points, ground, SIZE)
    across = [column for column, _ in points]
    if side is None:
        assert max(across) < 0 or min(across) >= WIDTH
        return
    mask = paint([side], *SIZE)
    for column in range(WIDTH):
        if not side.first <= column <= side.last:
            assert (mask[column] == FREE).all()
            continue
        row = side.rows[column - side.first]
        beyond = mask[column, :row] if ground == "sky" else mask[column, row + 1 :]
        assert (beyond == FORBIDDEN).all()
        assert (mask[column] == FORBIDDEN).sum() == len(beyond)
        assert mask[column, row] == FREE
        assert all(side.may_forbid(column, at) == bool(mask[column, at]) for at in range(HEIGHT))


def test_all_above_is_sky_until_it_is_undone():
    wire = LiveWire(hills(1), DETECTOR)
    before = wire.skyline
    line = wire.side([(0, 24), (69, 24)], "sky")
    assert line.rows.min() >= 24
    below = wire.side([(20, 26), (50, 26)], "terrain")
    assert (below.rows[20:51] <= 26).all()
    assert wire.anchor(35, 5).rows[35] == 5  # a click wins
    wire.edits = wire.edits.release(0, 69)
    assert wire.skyline == before


def test_what_is_cut_out_of_a_side_is_gone():
    edits = Edits(*SIZE).side([(10, 5), (20, 5)], "sky").release(14, 16)
    assert [(one.first, one.last) for one in edits.strokes] == [(10, 13), (17, 20)]


@pytest.mark.parametrize("points", [[], [(80, 3), (90, 3)]])
def test_a_side_that_makes_no_sense_is_one_sentence(points):
    with pytest.raises(EditError, match=r"\.$"):
        Edits(*SIZE).side(points, "sky")


def test_a_line_that_is_left_is_dearer_but_not_where_it_is_forbidden():
    edits = Edits(*SIZE).forbid([(10, 20)], 3)
    left = Left(((5, 20), (40, 20)), 2, 9)
    mask = paint([*edits.strokes, left], *SIZE)
    assert mask[10, 20] == FORBIDDEN
    assert set(np.unique(mask[30, 18:23])) == {2}
    assert not left.may_forbid(10, 20)
    assert [one.points for one in left.without(0, 30)] == [((40, 20),)]
