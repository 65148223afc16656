"""What an annotator has asked of a skyline."""

import numpy as np
import pytest

from annotate.engine.edits import ORIGINS, EditError, Edits
from annotate.engine.live_wire import LiveWire
from annotate.engine.steering import FORBIDDEN, paint
from testing.labelling import DETECTOR, hills


def test_a_span_cuts_an_earlier_one():
    edits = Edits(48, 70).draw(10, [7] * 20).straight(15, 7, 20, 9)
    assert [(one.kind, one.first, one.last) for one in edits.spans] == [
        ("drawn", 10, 14),
        ("drawn", 21, 29),
        ("straight", 15, 20),
    ]


def test_an_anchor_opens_a_piece_of_a_drawn_span():
    edits = Edits(40, 1000).draw(100, [20] * 200).anchor(200, 5)
    assert [(one.first, one.last) for one in edits.spans] == [(100, 179), (221, 299)]
    assert dict(edits.anchors) == {200: 5}
    ends = Edits(40, 1000).draw(100, [20] * 200).anchor(105, 5)
    assert [(one.first, one.last) for one in ends.spans] == [(126, 299)]


def test_a_stroke_on_others_is_painted_as_all_of_them_afresh():
    chance = np.random.default_rng(0)
    photo = hills(1)
    wire, edits = LiveWire(photo, DETECTOR), Edits(*photo.shape[:2])
    history = [edits]
    for _ in range(60):
        if len(history) > 1 and chance.random() < 0.3:
            history.pop()
        else:
            column, row = int(chance.integers(0, 70)), int(chance.integers(30, 48))
            points = [(column, row), (column + 6, row + 2)]
            radius, allow = int(chance.integers(0, 4)), bool(chance.random() < 0.4)
            history.append(history[-1].forbid(points, radius, allow=allow))
        wire.edits = history[-1]
        wire.refresh()
        forbidden = paint(history[-1].strokes, *photo.shape[:2]) == FORBIDDEN
        np.testing.assert_array_equal(
            wire._tables.allowed, np.where(forbidden, np.float32(np.inf), wire._tables._cost)
        )


def test_edits_that_differ_by_one_anchor_are_known():
    before = Edits(48, 70).anchor(3, 4).anchor(9, 5)
    assert before.anchor(20, 6).one_anchor_after(before) == (20, 6, None)
    assert before.move(9, 20, 6).one_anchor_after(before) == (20, 6, 9)
    assert before.anchor(9, 7).one_anchor_after(before) == (9, 7, 9)
    for others in (
        before,
        before.remove(9),
        before.anchor(20, 6).anchor(21, 6),
        before.remove(3).move(9, 20, 6),
        before.anchor(20, 6).draw(40, [3, 4]),
        before.anchor(20, 6).forbid([(1, 1)], 2),
    ):
        assert others.one_anchor_after(before) is None


def test_what_is_hidden_is_a_run_of_columns_and_is_shown_again():
    edits = Edits(48, 70).hide(10, 20).hide(21, 25).hide(40, 30)
    assert edits.hidden == ((10, 25, ""), (30, 40, ""))
    assert edits.hide(15, 35, hidden=False).hidden == ((10, 14, ""), (36, 40, ""))
    assert edits.release(0, 69).hidden == ()


def test_rows_of_other_passes_are_spans_of_their_origins():
    edits = Edits(48, 70).anchor(12, 3).hide(0, 20)
    taken = edits.take(10, [7] * 10, [("solved", 4), ("drawn", 6)], [(18, 19)])
    assert [(one.kind, one.first, one.last) for one in taken.spans] == [
        ("solved", 10, 13),
        ("drawn", 14, 19),
    ]
    assert taken.hidden == ((0, 9, ""), (18, 20, ""))
    assert not taken.anchors
    opened = taken.anchor(11, 5)
    assert dict(opened.anchors) == {11: 5}
    assert [one.kind for one in opened.spans] == ["drawn"]


def test_origins_of_taken_rows_stay_when_the_line_is_solved_again():
    wire = LiveWire(hills(0), DETECTOR)
    row = int(wire.skyline.rows[40]) + 9
    wire.edits = wire.edits.take(30, [row] * 20, [("proposal", 5), ("straight", 15)], [])
    wire.anchor(5, 20)
    assert [ORIGINS[one] for one in wire.origin[30:50]] == ["proposal"] * 5 + ["straight"] * 15


@pytest.mark.parametrize(
    ("origins", "hidden"), [([("solved", 3)], []), ([], []), ([("solved", 4)], [(9, 10)])]
)
def test_rows_without_their_origins_make_no_sense(origins, hidden):
    with pytest.raises(EditError, match="what is taken over"):
        Edits(48, 70).take(10, [7] * 4, origins, hidden)


def test_what_hides_columns_stays_with_them():
    edits = Edits(48, 70).hide(10, 25).hide(20, 40, why="fog")
    assert edits.hidden == ((10, 19, ""), (20, 40, "fog"))
    assert edits.release(30, 35).hidden == ((10, 19, ""), (20, 29, "fog"), (36, 40, "fog"))
    assert edits.hide(10, 40, why="cloud").hidden == ((10, 40, "cloud"),)
    assert edits.hidden_mask().sum() == 31
