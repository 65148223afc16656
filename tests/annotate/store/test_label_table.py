"""The table of labels: whole labels out of it, and labels from elsewhere into it."""

import numpy as np
import pytest

from annotate.store.label_table import (
    Log,
    begin,
    insert,
    labels_of,
    require_fit,
    seen,
    whole_label,
)
from annotate.store.lines import Line, LineError
from skyline_viz.skyline import Skyline

ANCHOR = '{"kind": "anchor", "column": 3, "row": 9}'
LINE = Line(Skyline(np.full(70, 9)), np.zeros(70, np.uint8))


def log(photo, **changes):
    operations = [(1.0, "open", '{"kind": "open"}'), (2.0, "anchor", ANCHOR)]
    made = {"photo": photo, "annotator": "ann", "number": 1, "blind": True}
    return Log(**{**made, "operations": operations, "line": LINE, **changes})


def test_a_label_is_begun_once(store):
    with store._writing() as database:
        first = begin(database, 1, "ann", 1, blind=False)
        assert begin(database, 1, "ann", 1, blind=True) == first
        assert begin(database, 1, "ann", 2, blind=False) != first
    assert not store.is_blind(first)


def test_a_label_from_elsewhere_is_there_as_a_whole(store):
    with store._writing() as database:
        assert insert(database, log(1))
        (label,) = labels_of(database, None, None)
    found = whole_label(store._connection, label, store.state(label))
    assert (found.name, found.annotator, found.number, found.blind) == (
        "hill-0.png",
        "ann",
        1,
        True,
    )
    assert found.skyline == LINE.skyline
    assert found.operations == (
        {"kind": "open", "at": 1.0},
        {"kind": "anchor", "at": 2.0, "column": 3, "row": 9},
    )
    assert found.seconds == 1.0


def test_work_that_was_done_here_stays(store):
    with store._writing() as database:
        assert insert(database, log(1))
        assert not insert(
            database, log(1, operations=[(3.0, "tag", '{"kind": "tag", "tag": "a", "on": true}')])
        )
        assert insert(database, log(1, number=2))
    assert store.state(1).tags == ()


def test_labels_are_chosen_by_annotator_and_pass_in_the_order_of_photos(store):
    with store._writing() as database:
        for photo, who, number in ((2, "bob", 1), (1, "bob", 2), (1, "ann", 1)):
            insert(database, log(photo, annotator=who, number=number))
        names = {1: "bob 2nd", 2: "bob 1st", 3: "ann"}
        assert labels_of(database, None, None) == [3, 2, 1], names
        assert labels_of(database, "bob", None) == [2, 1]
        assert labels_of(database, "bob", 1) == [1]
        assert labels_of(database, "eve", None) == []


def test_a_line_of_another_width_is_refused():
    require_fit(None, 5)
    require_fit(LINE, 70)
    with pytest.raises(LineError, match="its line has 70 columns, its photo 69"):
        require_fit(LINE, 69)


def test_nothing_of_a_line_counts_where_a_tag_says_that_no_skyline_is_visible():
    line = Skyline(rows=[3, 4], visible=np.array([True, False]))
    assert seen(line, ("fog",)) is line
    hidden = seen(line, ("fog", "no visible skyline"))
    assert not hidden.visible.any()
    assert hidden.rows.tolist() == [3, 4]
