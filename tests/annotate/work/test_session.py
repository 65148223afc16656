"""A photo that is being labelled: its line and its log always agree."""

import numpy as np
import pytest

from annotate.engine.edits import EditError
from annotate.store.database import StoreError
from annotate.store.operations import Hide, MoveAnchor, Open, SetAnchor, SetStatus, SetTag
from annotate.store.store import StaleError
from testing.labelling import workbench, write_hills


@pytest.fixture
def bench(tmp_path):
    bench = workbench(write_hills(tmp_path / "alps", count=1))
    yield bench
    bench.close()


@pytest.fixture
def session(bench):
    return bench.session(1)


def agree(bench, session):
    """That the log, read afresh, has what is open."""
    kept = bench.store.state(session.label)
    assert kept == session.state
    if kept.line is not None:
        assert kept.line.skyline == session.wire.skyline
    assert kept.edits == session.wire.edits


def test_the_proposal_is_kept_before_anything_is_done(bench, session):
    assert session.state.revision == 0
    assert bench.store.line(session.label).skyline == session.wire.skyline
    assert session.state.status == "to do"


def test_line_and_log_agree_after_every_step(bench, session):
    for operation in (
        Open(),
        SetAnchor(column=9, row=5),
        SetTag(tag="fog"),
        Hide(first=60, last=65),
        SetStatus(status="accepted"),
    ):
        session.apply(operation, session.state.revision)
        agree(bench, session)
    for step in (session.undo, session.undo, session.redo):
        step(session.state.revision)
        agree(bench, session)
    assert session.wire.skyline.rows[9] == 5
    assert not session.wire.skyline.visible[60:66].any()
    assert session.state.status == "in progress"


def test_a_click_is_kept_with_what_it_came_to(bench, session):
    row = int(session.wire.skyline.rows[35])
    click = SetAnchor(column=35, row=row + 14, within=3)
    first = session.apply(click, -1, "a-click")
    line = session.wire.skyline
    assert abs(int(line.rows[35]) - click.row) <= 3
    agree(bench, session)
    assert session.apply(click, -1, "a-click") == first  # it comes again: the line is another now
    with pytest.raises(StaleError, match="belongs to another one"):
        session.apply(SetAnchor(column=35, row=row, within=3), -1, "a-click")
    session.apply(MoveAnchor(from_column=35, column=37, row=click.row, within=3), -1)
    agree(bench, session)
    session.undo(-1)
    assert session.wire.skyline == line
    bench.close_photo(1)
    assert bench.session(1).wire.skyline == line  # from the log alone
    assert bench.session(1).wire.edits == session.wire.edits


def test_it_goes_on_where_the_log_ends(bench, session):
    session.apply(SetAnchor(column=9, row=5), -1)
    kept = session.wire.skyline
    bench.close_photo(1)
    again = bench.session(1)
    assert again is not session
    assert again.wire.skyline == kept
    assert dict(again.wire.edits.anchors) == {9: 5}


def test_what_comes_again_is_done_once(session):
    first = session.apply(SetAnchor(column=9, row=5), 0, "id-1")
    assert session.apply(SetAnchor(column=9, row=5), 0, "id-1") == first
    assert session.state.count == 1
    with pytest.raises(StaleError):
        session.apply(SetAnchor(column=9, row=6), 0, "id-1")


def test_what_cannot_be_kept_changes_nothing(session, monkeypatch):
    before, edits, state = session.wire.skyline, session.wire.edits, session.state

    def full(*_, **__):
        raise StoreError("the disk is full.")

    monkeypatch.setattr(session._store, "append", full)
    with pytest.raises(StoreError):
        session.apply(SetAnchor(column=9, row=5), 0)
    assert (session.wire.skyline, session.wire.edits, session.state) == (before, edits, state)


@pytest.mark.parametrize("step", ["undo", "redo"])
def test_there_is_nothing_to_take_back(session, step):
    with pytest.raises(EditError, match=f"there is nothing to {step}"):
        getattr(session, step)(-1)


def test_a_status_that_says_nothing_new_is_refused(session):
    session.apply(SetStatus(status="rejected"), -1)
    with pytest.raises(EditError, match="is rejected already"):
        session.apply(SetStatus(status="rejected"), -1)


def test_a_blind_photo_has_nothing_to_accept_before_there_is_a_line(tmp_path):
    bench = workbench(write_hills(tmp_path / "blind", count=1), blind=1.0)
    session = bench.session(1)
    assert session.blind
    assert bench.store.line(session.label) is None
    with pytest.raises(EditError, match="nothing to accept"):
        session.apply(SetStatus(status="accepted"), -1)
    session.apply(SetAnchor(column=9, row=5), -1)
    session.apply(SetStatus(status="accepted"), -1)
    np.testing.assert_array_equal(session.wire.skyline.rows, 5)
    bench.close()


def test_two_at_work_on_one_label_notice_each_other(bench, session):
    bench.store.append(session.label, -1, "tag", {"tag": "fog", "on": True})
    with pytest.raises(StaleError):
        session.apply(SetAnchor(column=9, row=5), session.state.revision)
    with pytest.raises(StaleError, match="changed elsewhere"):
        session.apply(Open(), session.state.revision)  # which needs no revision


def test_what_is_said_of_a_photo_is_said_by_whoever_works(tmp_path):
    bench = workbench(write_hills(tmp_path / "alps", count=1), reviewer="eve")
    session = bench.session(1)
    words = SetStatus(status="needs review", comment="the hut is cut off", by="somebody")
    kept = session.apply(words, -1, "asked-1")
    assert str(session.state.comment) == "eve: the hut is cut off"
    assert session.apply(words, -1, "asked-1") == kept  # it came twice
    with pytest.raises(EditError, match="is needs review already"):
        session.apply(SetStatus(status="needs review"), -1)
    session.apply(SetStatus(status="needs review", comment="and the mast"), -1)
    session.undo(-1)
    assert str(session.state.comment) == "eve: the hut is cut off"
    agree(bench, session)
    bench.close()


def test_an_accepted_photo_needs_no_comment(session):
    with pytest.raises(EditError, match="needs review, or is rejected"):
        session.apply(SetStatus(status="accepted", comment="fine"), -1)
    session.apply(SetStatus(status="rejected", comment="no sky"), -1)
    assert session.state.comment.by == "ann"
