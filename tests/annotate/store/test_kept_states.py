"""What is kept beside the logs follows from them, whatever came in between."""

import json
import sqlite3
from contextlib import closing

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given
from hypothesis import strategies as st

import annotate.store.database as database
from annotate.engine.edits import EditError, Edits
from annotate.store import checkpoints
from annotate.store.database import MIGRATIONS, NAME, StoreError
from annotate.store.history import LogError, State, folded
from annotate.store.kept_states import Request
from annotate.store.labels import Comment
from annotate.store.lines import Line
from annotate.store.operations import LOGGED, Redo, Undo
from annotate.store.store import StaleError, Store
from skyline_viz.constraints import PathError
from skyline_viz.skyline import Skyline
from testing.examples import examples
from testing.labelling import workbench, write_hills

LINE = Line(Skyline(rows=[5] * 70), np.zeros(70, np.uint8))
EMPTY = State(Edits(48, 70))


@pytest.fixture
def store(tmp_path):
    store = Store(write_hills(tmp_path, count=2))
    store.find()
    yield store
    store.close()


def rows(store, what="*", table="operations", order="id"):
    """Rows of a table as another program reads them."""
    with closing(sqlite3.connect(store.folder / NAME)) as connection:
        return connection.execute(f"SELECT {what} FROM {table} ORDER BY {order}").fetchall()


def from_log(store, label=1):
    """The state of a label by its whole log."""
    log = rows(store, "id, at, kind, body, label")
    return folded(EMPTY, [row[:4] for row in log if row[4] == label])


def standing(store, label=1):
    """What is kept of it."""
    (row,) = [one[1:] for one in rows(store, table="standings", order="label") if one[0] == label]
    said = Comment(*row[5:]) if row[5] else None
    return (*row[:3], tuple(json.loads(row[3])), row[4], said)


def agrees(store, label=1):
    """The state in memory, what is kept, and the log tell the same."""
    whole = from_log(store, label)
    assert store.state(label) == whole
    assert standing(store, label) == (
        whole.last,
        whole.revision,
        whole.status,
        whole.tags,
        whole.seconds,
        whole.comment,
    )
    return whole


def many(store, label, count, first=0):
    """Operations of many kinds."""
    for number in range(first, first + count):
        kind, body = (
            ("anchor", {"column": number % 70, "row": number % 40}),
            ("hidden", {"first": number % 60, "last": number % 60 + 3, "hidden": True}),
            ("undo", {"status": True}),
            ("status", {"status": "accepted"})
            if number % 2
            else ("status", {"status": "rejected", "comment": f"says {number}", "by": "eve"}),
            ("tag", {"tag": f"t{number % 5}", "on": True}),
            ("redo", {"status": True}),
        )[number * 7 % 6]
        store.append(label, -1, kind, body, LINE, f"{label}-{number}")


def test_checkpoints_and_standings_follow_from_the_log(store, monkeypatch):
    monkeypatch.setattr(checkpoints, "EVERY", 7)
    for label in (store.begin(1, "ann", 1), store.begin(2, "ann", 1)):
        many(store, label, 60)
        agrees(store, label)
    again = Store(store.folder)
    for label in (1, 2):
        assert agrees(again, label).count == 60
        assert again.state(label).line.skyline == LINE.skyline
    again.close()


def test_opening_reads_what_was_done_since_the_checkpoint_only(store, monkeypatch):
    monkeypatch.setattr(checkpoints, "EVERY", 50)
    label = store.begin(1, "ann", 1)
    many(store, label, 120)
    read = []
    monkeypatch.setattr(
        "annotate.store.kept_states.folded",
        lambda state, log: folded(state, [read.append(row) or row for row in log]),
    )
    again = Store(store.folder)
    assert again.state(label) == from_log(store)
    assert len(read) == 20
    again.close()


@pytest.mark.parametrize(
    "harm",
    [
        "UPDATE checkpoints SET state = x'00'",
        "UPDATE checkpoints SET state = (SELECT state FROM checkpoints WHERE label = 2)",
        "DELETE FROM checkpoints",
        "INSERT OR REPLACE INTO checkpoints SELECT label, 'text' FROM checkpoints",
        "DROP TRIGGER operations_remain; DELETE FROM operations WHERE id = 5;"
        " DELETE FROM standings",
    ],
)
def test_a_checkpoint_that_is_no_use_is_left_out(store, harm, monkeypatch):
    monkeypatch.setattr(checkpoints, "EVERY", 10)
    for label in (store.begin(1, "ann", 1), store.begin(2, "ann", 1)):
        many(store, label, 25)
    with closing(sqlite3.connect(store.folder / NAME)) as connection:
        connection.executescript(harm)
    again = Store(store.folder)
    assert again.state(1) == from_log(store)
    again.close()


def old_store(folder, logs):
    """Labels as version 1 kept them."""
    write_hills(folder, count=len(logs))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(database, "MIGRATIONS", MIGRATIONS[:1])
        database.connect(folder).close()
    with closing(sqlite3.connect(folder / NAME)) as connection, connection:
        for label, log in enumerate(logs, 1):
            connection.execute(
                "INSERT INTO photos VALUES (?, ?, ?, 70, 48, 0, 0)",
                (label, f"old {label}", f"hill-{label - 1}.png"),
            )
            connection.execute(
                "INSERT INTO labels (id, photo, annotator, number) VALUES (?, ?, 'ann', 1)",
                (label, label),
            )
            for at, operation in enumerate(log):
                connection.execute(
                    "INSERT INTO operations (label, at, kind, body) VALUES (?, ?, ?, ?)",
                    (label, at * 2.0, operation["kind"], json.dumps(operation)),
                )


ANCHOR = {"kind": "anchor", "column": 3, "row": 4}
ACCEPT = {"kind": "status", "status": "accepted"}


def test_labels_of_version_1_keep_their_meaning(tmp_path):
    logs = [
        [ANCHOR, ACCEPT, {"kind": "undo"}],
        [ACCEPT, ANCHOR, {"kind": "undo"}, {"kind": "redo"}, ACCEPT],
        [ANCHOR, {"kind": "undo"}, ACCEPT, {"kind": "redo"}],
        [{"kind": "open"}],
        [ACCEPT] + [ANCHOR] * 250 + [ACCEPT],
    ]
    old_store(tmp_path, logs)
    store = Store(tmp_path)
    told = [card.status for card in store.cards("ann", 1).values()]
    assert told == ["in progress", "accepted", "in progress", "to do", "accepted"]
    assert [len(store.state(label).done) for label in range(1, 6)] == [0, 1, 1, 0, 250]
    for label in range(1, 6):
        agrees(store, label)
    assert [label for (label,) in rows(store, "label", "checkpoints", "label")] == [5]
    label = 2  # the undo of this version goes back through both kinds
    for status, anchors in (("in progress", 1), ("in progress", 0), ("to do", 0)):
        store.append(label, -1, "undo", {"status": True}, LINE)
        state = agrees(store, label)
        assert (state.status, len(state.edits.anchors)) == (status, anchors)
    store.close()


def test_a_label_that_cannot_be_read_leaves_the_others_alone(tmp_path):
    old_store(tmp_path, [[ANCHOR], [ANCHOR, {"kind": "lasso"}], [ACCEPT]])
    store = Store(tmp_path)
    for _ in range(2):
        cards = list(store.cards("ann", 1).values())
        assert [card.status for card in cards] == ["in progress", "needs review", "accepted"]
        assert "operation 2 of the log ('lasso') is unknown" in cards[1].problem
    with pytest.raises(LogError, match="operation 2 of the log"):
        store.state(2)
    with pytest.raises(LogError, match="operation 2 of the log"):
        store.append(2, -1, "tag", {"tag": "x", "on": True})
    store.close()


def test_labels_of_version_1_are_listed_where_nothing_can_be_written(tmp_path, monkeypatch):
    old_store(tmp_path, [[ANCHOR], [ACCEPT]])
    store = Store(tmp_path)

    def refused(*_, **__):
        raise StoreError("nothing can be written here.")

    monkeypatch.setattr("annotate.store.standings.keep", refused)
    told = [card.status for card in store.cards("ann", 1).values()]
    assert told == ["in progress", "accepted"]
    store.close()


def test_however_an_operation_gets_in_the_list_is_right(store):
    label = store.begin(1, "ann", 1)
    many(store, label, 5)
    with closing(sqlite3.connect(store.folder / NAME)) as connection, connection:
        connection.execute(
            "INSERT INTO operations (label, at, kind, body) VALUES (1, 0, 'tag', ?)",
            (json.dumps({"kind": "tag", "tag": "other", "on": True}),),
        )
    assert "other" in store.cards("ann", 1)[1].tags
    agrees(store)


def test_a_list_reads_no_log(store):
    many(store, store.begin(1, "ann", 1), 30)
    store.cards("ann", 1)
    said = []
    store._connection.set_trace_callback(said.append)
    store.cards("ann", 1)
    assert not [one for one in said if "body" in one or "FROM operations WHERE label = 1" in one]


def test_a_known_id_is_answered_as_it_was_then(store):
    label, other = store.begin(1, "ann", 1), store.begin(2, "ann", 1)
    asked = [
        ("open", {}),
        ("anchor", {"column": 3, "row": 4}),
        ("open", {}),
        ("undo", {"status": True}),
        ("tag", {"tag": "fog", "on": True}),
    ]
    first = [
        store.append(label, -1, kind, body, LINE, f"id-{at}")
        for at, (kind, body) in enumerate(asked)
    ]
    assert first == [0, 2, 2, 4, 5]
    kept = rows(store)
    again = [
        store.append(label, 0, kind, body, LINE, f"id-{at}")
        for at, (kind, body) in enumerate(asked)
    ]
    assert again == first
    assert rows(store) == kept
    for label_of, kind, body in (
        (other, "anchor", {"column": 3, "row": 4}),
        (label, "anchor", {"column": 3, "row": 5}),
        (label, "undo", {"status": True}),
    ):
        with pytest.raises(StaleError, match="belongs to another one") as refused:
            store.append(label_of, -1, kind, body, LINE, "id-1")
        assert refused.value.revision == (5 if label_of == label else 0)
    assert rows(store) == kept


def test_what_makes_no_sense_never_gets_into_a_log(store):
    label = store.begin(1, "ann", 1)
    with pytest.raises(EditError, match="no anchor in column 3"):
        store.append(label, -1, "remove", {"column": 3}, LINE, "a")
    assert rows(store) == []
    assert store.append(label, -1, "anchor", {"column": 3, "row": 4}, LINE, "a") == 1


def test_an_undone_line_of_a_blind_photo_stays_undone(tmp_path):
    folder = write_hills(tmp_path, count=1)
    bench = workbench(folder, blind=1.0)
    session = bench.session(1)
    session.apply(LOGGED.validate_python(ANCHOR), -1)
    session.undo(-1)
    assert session.wire.empty
    bench.close()
    bench = workbench(folder, blind=1.0)
    assert bench.session(1).wire.empty
    assert bench.store.state(1).line is None
    bench.close()


acts = st.one_of(
    st.builds(
        lambda c, r: {"kind": "anchor", "column": c, "row": r}, st.integers(0, 71), st.just(20)
    ),
    st.builds(lambda c: {"kind": "remove", "column": c}, st.integers(0, 5)),
    st.builds(
        lambda c, a: {"kind": "forbid", "points": [(c, 9), (c + 9, 9)], "radius": 2, "allow": a},
        st.integers(0, 60),
        st.booleans(),
    ),
    st.builds(lambda s: {"kind": "status", "status": s}, st.sampled_from(["accepted", "rejected"])),
    st.just({"kind": "tag", "tag": "fog", "on": True}),
    st.just({"kind": "open"}),
    st.just({"kind": "undo", "status": True}),
    st.just({"kind": "redo", "status": True}),
)
EDIT_UNDO_EDIT_REDO = [ANCHOR, {"kind": "undo", "status": True}, {**ANCHOR, "row": 9}]


@example(asked=[*EDIT_UNDO_EDIT_REDO, {"kind": "redo", "status": True}], again=[0, 2, 1, 3], at=2)
@example(asked=[ACCEPT, ANCHOR, {"kind": "undo", "status": True}] * 2, again=[5, 1, 1], at=3)
@examples(40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    asked=st.lists(acts, min_size=1, max_size=12),
    again=st.lists(st.integers(0, 11), max_size=12),
    at=st.integers(0, 11),
)
def test_any_changes_sent_any_number_of_times_are_kept_once(tmp_path_factory, asked, again, at):
    folder = write_hills(tmp_path_factory.mktemp("twice"), count=1)
    bench = workbench(folder)
    kept = {}

    def send(number, act):
        session, known_by = bench.session(1), f"id-{number}"
        operation = LOGGED.validate_json(json.dumps(act))
        try:
            if isinstance(operation, Undo | Redo):
                revision = getattr(session, operation.kind)(-1, known_by)
            else:
                revision = session.apply(operation, -1, known_by)
        except (EditError, PathError):
            assert number not in kept
            return
        assert kept.setdefault(number, revision) == revision

    for number, act in enumerate(asked):
        send(number, act)
        if number == at:  # a restart, after which all that was answered is sent again
            bench.close()
            bench = workbench(folder)
            for other in again:
                if other in kept:
                    send(other, asked[other])
    before = rows(bench.store)
    for other in again:
        if other in kept:
            send(other, asked[other])
    assert rows(bench.store) == before
    asked_for = [row[0] for row in rows(bench.store, "request")]
    assert asked_for == [f"id-{number}" for number in kept]
    if before:
        state, session = agrees(bench.store), bench.session(1)
        assert session.state == state
        assert session.wire.edits == state.edits
        assert session.wire.skyline == bench.store.line(1).skyline
    bench.close()


def test_a_request_says_what_is_kept():
    asked = Request(1, 0, "anchor", {"column": 3, "row": 4}, "a")
    assert asked.operation() == LOGGED.validate_json(asked.text)


@pytest.mark.parametrize("operation", [ANCHOR, ACCEPT, {"kind": "open"}])
def test_an_open_photo_never_goes_on_from_what_it_has_not_seen(tmp_path, operation):
    bench = workbench(write_hills(tmp_path, count=1))
    session = bench.session(1)
    before = session.state
    other = Store(tmp_path)
    revision = other.append(1, -1, "anchor", {"column": 9, "row": 9}, LINE)
    other.close()
    with pytest.raises(StaleError) as refused:
        session.apply(LOGGED.validate_python(operation), -1)
    assert refused.value.revision == revision
    assert (session.state, session.wire.edits) == (before, before.edits)
    kept = [row[0] for row in rows(bench.store, "kind")]
    assert kept == (["anchor", "open"] if operation["kind"] == "open" else ["anchor"])
    bench.close()


def test_a_request_of_an_older_program_is_known_although_fields_have_come_since(store):
    label = store.begin(1, "ann", 1)
    before = {"first": 3, "last": 9, "hidden": True}
    kept = store.append(label, -1, "hidden", before, LINE, "a")
    assert store.append(label, -1, "hidden", {**before, "why": None}, LINE, "a") == kept
    with pytest.raises(StaleError, match="belongs to another one"):
        store.append(label, -1, "hidden", {**before, "why": "fog"}, LINE, "a")
