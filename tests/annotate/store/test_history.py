"""What follows from a log: step by step, from a checkpoint, and as older programs understood it."""

import json

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from pydantic import ValidationError

from annotate.engine.edits import EditError, Edits
from annotate.store import checkpoints
from annotate.store import history as log
from annotate.store.history import LogError, folded
from annotate.store.labels import Comment
from annotate.store.operations import (
    LOGGED,
    Consensus,
    Hide,
    Redo,
    SetAnchor,
    SetStatus,
    Undo,
    spoken,
)
from testing.examples import examples
from testing.logs import (
    EMPTY,
    HEIGHT,
    WIDTH,
    edits,
    known_to_version_1,
    logs,
    new_moves,
    old_moves,
    others,
)


@examples(300)
@given(logs(edits, others, old_moves))
def test_old_logs_keep_their_meaning(kept):
    state = folded(EMPTY, kept)
    told = (state.done, state.undone, state.status, state.tags, state.seconds)
    assert told == known_to_version_1(kept)
    again = EMPTY.edits
    for edit in state.done:
        again = edit.on(again)
    assert state.edits == again


class Snapshots:
    """The same history, told by whole copies of what held before each change."""

    def __init__(self):
        self.now, self.before, self.after = (EMPTY.edits, "to do"), [], []

    def do(self, operation):
        _, status = self.now
        match operation.kind:
            case "open" | "tag":
                return
            case "undo" if self.before:
                self.after.append(self.before[-1][1])
                self.now = self.before.pop()[0]
                return
            case "redo" if self.after:
                self.change(self.after.pop())
            case "undo" | "redo":
                return
            case "status" if operation.status == status:
                return
            case "status":
                self.change(operation)
                self.after = [one for one in self.after if not isinstance(one, SetStatus)]
            case _:
                self.change(operation)
                self.after = []

    def change(self, operation):
        edits, status = self.now
        self.before.append((self.now, operation))
        if isinstance(operation, SetStatus):
            self.now = (edits, operation.status)
        else:
            stays = status in ("needs review", "rejected")
            self.now = (operation.on(edits), status if stays else "in progress")


@pytest.mark.parametrize("remembered", [1, 4, 64])
def test_undo_goes_back_through_edits_and_statuses(remembered, monkeypatch):
    monkeypatch.setattr(log, "_REMEMBERED", remembered)

    @examples(200)
    @given(logs(edits, others, new_moves, new_moves))
    def check(kept):
        state, expected = EMPTY, Snapshots()
        for number, at, _, body in kept:
            operation = LOGGED.validate_json(body)
            state = state.after(operation, at, number)
            expected.do(operation)
            assert (state.edits, state.status) == expected.now
            assert [one.change for one in state.steps] == [one for _, one in expected.before]
            assert list(state.taken) == expected.after
            known = [at for at, one in enumerate(state.steps) if one.edits is not None]
            assert len(known) <= remembered + len(state.steps) // remembered + 1

    check()


@examples(200)
@given(logs(edits, others, old_moves, new_moves), st.integers(0, 60))
def test_a_checkpoint_and_the_rest_are_the_whole_log(kept, cut):
    whole = folded(EMPTY, kept)
    data = checkpoints.packed(folded(EMPTY, kept[:cut]), 7)
    assert folded(checkpoints.unpacked(data, 7, EMPTY.edits), kept[cut:]) == whole
    for other in ((data, 8, EMPTY.edits), (data, 7, Edits(HEIGHT, WIDTH + 1))):
        assert checkpoints.unpacked(*other) is None


def test_a_checkpoint_can_be_undone_to_the_beginning():
    kept = [
        (n + 1, 0.0, "anchor", f'{{"kind": "anchor", "column": {n % WIDTH}, "row": {n % 7}}}')
        for n in range(500)
    ]
    state = checkpoints.unpacked(checkpoints.packed(folded(EMPTY, kept), 1), 1, EMPTY.edits)
    back = [(n, 0.0, "undo", '{"kind": "undo", "status": true}') for n in range(501, 1001)]
    there = [(n, 0.0, "redo", '{"kind": "redo", "status": true}') for n in range(1001, 1501)]
    undone = folded(state, back)
    assert (undone.edits, undone.status, undone.steps) == (EMPTY.edits, "to do", ())
    redone = folded(undone, there)
    assert redone.edits == state.edits
    assert redone.steps == state.steps


def test_undoing_an_edit_of_an_accepted_photo_makes_it_accepted_again():
    log = [
        '{"kind": "status", "status": "accepted"}',
        '{"kind": "anchor", "column": 3, "row": 4}',
    ]
    for undo, status in (
        ('{"kind": "undo", "status": true}', "accepted"),
        ('{"kind": "undo"}', "in progress"),  # of a program of version 1
    ):
        kept = [(n, 0.0, json.loads(body)["kind"], body) for n, body in enumerate([*log, undo], 1)]
        assert folded(EMPTY, kept).status == status
        assert folded(EMPTY, kept[:2]).status == "in progress"


@example(["edit", "undo", "edit", "redo"])
@example(["edit", "undo", "status", "redo"])
@given(st.lists(st.sampled_from(["edit", "undo", "redo", "status", "tag"]), max_size=12))
def test_a_new_edit_leaves_nothing_to_redo(kinds):
    bodies = {
        "edit": {"kind": "hidden", "first": 3, "last": 4},
        "status": {"kind": "status", "status": "accepted"},
        "tag": {"kind": "tag", "tag": "fog", "on": True},
        "undo": {"kind": "undo", "status": True},
        "redo": {"kind": "redo", "status": True},
    }
    state = EMPTY
    for number, kind in enumerate(kinds, 1):
        before = state.status
        state = state.after(LOGGED.validate_json(json.dumps(bodies[kind])), 0.0, number)
        if kind == "edit":
            assert state.taken == ()
        if kind == "status" and before != "accepted":
            assert not any(isinstance(one, SetStatus) for one in state.taken)


@pytest.mark.parametrize(
    "body",
    [
        '{"kind": "lasso"}',
        '{"kind": "anchor", "column": 1}',
        '{"kind": "anchor", "column": 99, "row": 1}',
        '{"kind": "remove", "column": 1}',
        '{"kind": "status", "status": "done"}',
        '{"kind": "undo", "steps": 3}',
        '{"kind": "tag", "tag": "", "on": true}',
        '{"kind": "open"}',
        "[]",
        "",
    ],
)
def test_a_log_that_makes_no_sense_is_one_sentence(body):
    good = (1, 0.0, "anchor", '{"kind": "anchor", "column": 3, "row": 4}')
    with pytest.raises(LogError, match=r"^operation 2 of the log [^\n]*\.$"):
        folded(EMPTY, [good, (2, 0.0, "anchor" if "open" in body else body[10:14], body)])


@pytest.mark.parametrize(
    "damage", [lambda d: d[:-1], lambda d: b"", lambda d: d[:9] + b"x" + d[10:]]
)
def test_a_damaged_checkpoint_counts_as_none(damage):
    data = checkpoints.packed(EMPTY, 1)
    assert checkpoints.unpacked(data, 1, EMPTY.edits) == EMPTY
    assert checkpoints.unpacked(damage(data), 1, EMPTY.edits) is None


def test_a_checkpoint_of_another_version_counts_as_none(monkeypatch):
    monkeypatch.setattr(checkpoints, "_VERSION", 2)
    assert checkpoints.unpacked(checkpoints.packed(EMPTY, 1), 1, EMPTY.edits) is None


@pytest.mark.parametrize(
    ("operation", "words"),
    [
        ({"kind": "anchor", "column": 1, "row": 2}, "the anchor"),
        ({"kind": "move", "from_column": 1, "column": 1, "row": 2}, "the move of the anchor"),
        ({"kind": "remove", "column": 1}, "the removal of the anchor"),
        ({"kind": "forbid", "points": [[1, 2]], "radius": 3}, "the brush stroke"),
        ({"kind": "forbid", "points": [[1, 2]], "radius": 3, "allow": True}, "the eraser stroke"),
        (
            {"kind": "straight", "column": 1, "row": 2, "to_column": 5, "to_row": 6},
            "the straight span",
        ),
        ({"kind": "drawn", "first": 1, "rows": [2]}, "the drawn span"),
        ({"kind": "hidden", "first": 1, "last": 2}, "the hidden columns"),
        ({"kind": "hidden", "first": 1, "last": 2, "hidden": False}, "the columns shown again"),
        ({"kind": "hidden", "first": 1, "last": 2, "why": "fog"}, "hidden by fog"),
        ({"kind": "release", "first": 1, "last": 2}, "the release of the columns"),
        (
            {"kind": "carried", "points": [[1, 2]], "radius": 3, "name": "a.png"},
            "the line carried over from a.png",
        ),
        ({"kind": "status", "status": "needs review"}, "needs review"),
    ],
)
def test_what_undo_takes_back_has_a_name(operation, words):
    assert spoken(LOGGED.validate_json(json.dumps(operation))) == words


def said(status, comment="", by="eve"):
    return SetStatus(status=status, comment=comment, by=by if comment else "")


def after(*operations):
    state = EMPTY
    for number, operation in enumerate(operations, 1):
        state = state.after(operation, float(number), number)
    return state


REVIEW = said("needs review", "the hut is cut off")


def test_what_was_said_goes_with_its_status():
    assert after(REVIEW).comment == Comment("the hut is cut off", "eve")
    assert after(REVIEW, SetAnchor(column=3, row=4)).comment is not None
    assert after(REVIEW, said("accepted")).comment is None
    assert after(said("rejected", "no sky")).comment == Comment("no sky", "eve")
    assert after(said("needs review")).comment is None


def test_undo_gives_back_what_was_said_before():
    undo, redo = Undo(status=True), Redo(status=True)
    other = said("needs review", "and the mast, too", "ann")
    assert after(REVIEW, other).comment.by == "ann"
    assert after(REVIEW, other, undo).comment.by == "eve"
    assert after(REVIEW, other, undo, undo).comment is None
    assert after(REVIEW, said("accepted"), undo).comment.by == "eve"
    assert after(REVIEW, undo, redo).comment.by == "eve"


def test_the_same_status_without_words_leaves_what_was_said():
    state = after(REVIEW, said("needs review"))
    assert (len(state.steps), state.comment.by) == (1, "eve")


def test_a_consensus_changes_no_status_and_is_undone_as_a_whole():
    rows = {"first": 0, "rows": [5] * WIDTH, "origins": [("solved", WIDTH)], "of": ["ann", "bob"]}
    state = after(Consensus(**rows, apart=[(3, 9)]), REVIEW)
    assert state.consensus.apart == [(3, 9)]
    assert after(Consensus(**rows)).status == "to do"
    assert spoken(state.steps[0].change) == "the line of ann and bob"
    assert after(Consensus(**rows), Undo(status=True)).edits == EMPTY.edits
    again = checkpoints.unpacked(checkpoints.packed(state, 1), 1, EMPTY.edits)
    assert (again.consensus, again.comment, again.edits) == (
        state.consensus,
        state.comment,
        state.edits,
    )


@pytest.mark.parametrize("words", ["x" * 301, "two\nlines", "\x07", " "])
def test_a_comment_is_one_short_line(words):
    with pytest.raises(ValidationError):
        SetStatus(status="rejected", comment=words)


@pytest.mark.parametrize(
    ("rows", "apart"), [(WIDTH - 1, []), (WIDTH, [(3, WIDTH)]), (WIDTH, [(9, 3)])]
)
def test_a_consensus_is_one_of_the_whole_photo(rows, apart):
    origins = [("solved", rows)]
    told = Consensus(first=0, rows=[5] * rows, origins=origins, of=["ann"], apart=apart)
    with pytest.raises(EditError, match="of all columns"):
        after(told)


def test_a_log_of_before_reasons_is_read_as_it_was_meant():
    old = [
        (1, 1.0, "hidden", '{"first": 3, "last": 9, "hidden": true, "kind": "hidden"}'),
        (2, 2.0, "tag", '{"tag": "hidden by fog", "on": true, "kind": "tag"}'),
    ]
    state = folded(EMPTY, old)
    assert state.edits.hidden == ((3, 9, ""),)
    assert state.tags == ("hidden by fog",)


def test_undo_takes_a_reason_back_before_what_it_explains():
    state = folded(EMPTY, [])
    for number, why in enumerate((None, "fog"), 1):
        state = state.after(Hide(first=3, last=9, why=why), number, number)
    assert state.edits.hidden == ((3, 9, "fog"),)
    state = state.after(Undo(status=True), 3.0, 3)
    assert state.edits.hidden == ((3, 9, ""),)
    assert state.after(Redo(status=True), 4.0, 4).edits.hidden == ((3, 9, "fog"),)
    assert state.after(Undo(status=True), 4.0, 4).edits.hidden == ()
