"""Where labels stand, in short: kept with the log, and made anew where that is missing."""

import sqlite3
from contextlib import closing

import pytest

from annotate.store import standings
from annotate.store.database import NAME
from annotate.store.labels import Comment
from annotate.store.store import Store
from testing.labelling import write_hills
from testing.labels import label, poisoned


@pytest.fixture
def folder(tmp_path):
    return label(write_hills(tmp_path / "alps"), row=9)


def test_lists_need_no_log(folder):
    store = Store(folder, reading=True)
    assert standings.missing(store._connection) == []
    kept = standings.kept(store._connection, "ann", 1)
    assert {one.status for one in kept.values()} == {"accepted"}
    assert standings.kept(store._connection, "bob", 1) == {}
    store.close()


@pytest.mark.parametrize(
    "damage",
    ["status = 'perfect'", "tags = '{'", "tags = '{}'", "seconds = 'long'", "comment = 'x'"],
)
def test_a_damaged_standing_counts_as_none_and_is_made_from_the_log(folder, damage):
    with closing(sqlite3.connect(folder / NAME)) as database, database:
        database.execute("PRAGMA ignore_check_constraints = ON")
        database.execute(f"UPDATE standings SET {damage} WHERE label = 1")
    store = Store(folder)
    assert standings.missing(store._connection) == [1]
    assert store.cards("ann", 1)[1].status == "accepted"
    assert standings.missing(store._connection) == []  # it is kept from now on
    store.close()


def test_a_log_that_cannot_be_read_is_a_problem_and_stays_missing(tmp_path):
    folder = poisoned(write_hills(tmp_path / "alps"))
    with closing(sqlite3.connect(folder / NAME)) as database, database:
        database.execute("DELETE FROM standings")
    store = Store(folder)
    with store._writing() as database:
        found = standings.made(database, keeping=True)
        assert found[1].status == "accepted"
        assert found[2].status == "needs review"
        assert "cannot be read" in found[2].problem
        assert standings.missing(database) == [2]
    store.close()


def test_lists_know_what_was_said(folder):
    store = Store(folder)
    store.append(1, -1, "status", {"status": "rejected", "comment": "no sky", "by": "eve"})
    assert store.cards("ann", 1)[1].comment == Comment("no sky", "eve")
    with closing(sqlite3.connect(folder / NAME)) as database, database:
        database.execute("DELETE FROM standings")
    assert store.cards("ann", 1)[1].comment == Comment("no sky", "eve")  # from the log
    assert store.cards("ann", 1)[2].comment is None
    store.close()


def test_others_have_finished_what_they_accepted_and_no_more_is_told(folder):
    label(folder, annotator="bob", number=2, photos=1)
    with closing(Store(folder)) as store:
        finished = standings.finished_by_others(store._connection, "cy", 1)
        assert finished == {1: ("ann", "bob, pass 2"), 2: ("ann",)}
        finished = standings.finished_by_others(store._connection, "ann", 1)
        assert finished == {1: ("bob, pass 2",)}
        cards = store.cards("ann", 1)
        assert [cards[photo].finished_by for photo in (1, 2)] == [("bob, pass 2",), ()]
