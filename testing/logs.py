"""Logs of operations that make sense, and what version 1 of the program took from them."""

import json

import numpy as np
from hypothesis import strategies as st
from pydantic import TypeAdapter

from annotate.engine.edits import EditError, Edits
from annotate.store.history import State
from annotate.store.lines import Line
from annotate.store.operations import LOGGED, Edit
from skyline_viz.skyline import Skyline

HEIGHT, WIDTH = 30, 40
EMPTY = State(Edits(HEIGHT, WIDTH))
LINE = Line(Skyline(rows=[3, 4, 9]), np.array([0, 1, 3], np.uint8))
columns, rows = st.integers(0, WIDTH - 1), st.integers(0, HEIGHT - 1)
edits = st.one_of(
    st.fixed_dictionaries({"kind": st.just("anchor"), "column": columns, "row": rows}),
    st.fixed_dictionaries({"kind": st.just("remove"), "column": columns}),
    st.fixed_dictionaries(
        {"kind": st.just("move"), "from_column": columns, "column": columns, "row": rows}
    ),
    st.fixed_dictionaries(
        {
            "kind": st.just("drawn"),
            "first": st.integers(0, WIDTH - 5),
            "rows": st.lists(rows, min_size=1, max_size=5),
        }
    ),
    st.fixed_dictionaries(
        {"kind": st.just("hidden"), "first": columns, "last": columns},
        optional={"why": st.sampled_from([None, "fog", "cloud"])},
    ),
    st.fixed_dictionaries({"kind": st.just("release"), "first": columns, "last": columns}),
    st.fixed_dictionaries(
        {
            "kind": st.just("forbid"),
            "points": st.lists(st.tuples(columns, rows), min_size=1, max_size=3),
            "radius": st.integers(0, 3),
            "allow": st.booleans(),
        }
    ),
    st.fixed_dictionaries(
        {
            "kind": st.just("guide"),
            "points": st.lists(st.tuples(columns, rows), min_size=1, max_size=3),
            "radius": st.integers(1, 5),
        }
    ),
)
statuses = st.sampled_from(["to do", "in progress", "accepted", "needs review", "rejected"])
others = st.one_of(
    st.fixed_dictionaries(
        {"kind": st.just("tag"), "tag": st.sampled_from("ab"), "on": st.booleans()}
    ),
    st.fixed_dictionaries({"kind": st.just("status"), "status": statuses}),
    st.just({"kind": "open"}),
)
old_moves = st.sampled_from([{"kind": "undo"}, {"kind": "redo"}])
new_moves = st.sampled_from([{"kind": "undo", "status": True}, {"kind": "redo", "status": True}])


def logs(*kinds, most=60):
    """Logs of operations that make sense, each where it stands."""
    return st.lists(
        st.tuples(st.one_of(*kinds), st.floats(0.1, 200, allow_nan=False)), max_size=most
    ).map(sensible)


def sensible(asked):
    state, kept, at = EMPTY, [], 1000.0
    for number, (operation, pause) in enumerate(asked, 1):
        at += pause
        try:
            state = state.after(LOGGED.validate_json(json.dumps(operation)), at, number)
        except EditError:
            continue
        kept.append((number, at, operation["kind"], json.dumps(operation)))
    return kept


def known_to_version_1(kept):
    """Edits that hold, edits that were undone, status, tags and seconds, as version 1 told them."""
    done, undone, tags = [], [], {}
    status, edited, seconds, before = "", False, 0.0, None
    for _, at, kind, body in kept:
        if before is not None and kind != "open":
            seconds += min(max(at - before, 0.0), 60.0)
        before = at
        if kind == "status":
            status = json.loads(body)["status"]
        elif kind == "tag":
            said = json.loads(body)
            tags.pop(said["tag"], None)
            if said["on"]:
                tags[said["tag"]] = True
        elif kind != "open":
            edited = True
            status = "" if status in ("accepted", "to do") else status
        if kind == "undo" and done:
            undone.append(done.pop())
        elif kind == "redo" and undone:
            done.append(undone.pop())
        elif kind not in ("undo", "redo", "tag", "status", "open"):
            done.append(TypeAdapter(Edit).validate_json(body))
            undone.clear()
    status = status or ("in progress" if edited else "to do")
    return tuple(done), tuple(undone), status, tuple(tags), seconds


def anchor(store, label, column, row=5):
    """Add an anchor to the log of a label; the line after it is three columns wide."""
    body = {"column": column, "row": row}
    return store.append(label, -1, "anchor", body, LINE)
