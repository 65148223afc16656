"""Labels of a folder of photos, made and looked at as an annotator and the commands would."""

import csv
import shutil
import sqlite3
from contextlib import closing

import numpy as np

from annotate.cli import main
from annotate.store.database import NAME
from annotate.store.labels import Label
from annotate.store.operations import SetStatus, Straight
from annotate.store.store import Store
from skyline_viz.skyline import Skyline
from testing.labelling import workbench


def run(*words):
    return main([str(word) for word in words])


def poisoned(folder, kind="rotate", body='{"kind": "rotate", "degrees": 3}', row=11):
    """Two labels, of which the second has an operation that nobody knows."""
    label(folder, row=row)
    with closing(sqlite3.connect(folder / NAME)) as database, database:
        database.execute(
            "INSERT INTO operations (label, at, kind, body) SELECT id, 5.0, ?, ? FROM labels"
            " WHERE photo = (SELECT id FROM photos WHERE name = 'hill-1.png')",
            (kind, body),
        )
    return folder


POISON = [
    ("rotate", '{"kind": "rotate", "degrees": 3}'),
    ("status", "{}"),
    ("status", '{"kind": "status", "status": ["a"]}'),
    ("tag", '{"kind": "tag", "tag": ["a"], "on": true}'),
    ("anchor", '{"kind": "anchor", "column": 5000, "row": 5}'),
    ("anchor", "not JSON"),
    ("anchor", '{"kind": "remove", "column": 5}'),
    ("anchor", "[" * 2000),
    ("anchor", b"\xff\xfe{"),
    ("anchor", 7),
    (b"\xff", "{}"),
]


def label(folder, annotator="ann", number=1, row=None, photos=2, **how):
    """Accept the proposals of some photos; with `row`, after drawing a level line there."""
    bench = workbench(folder, annotator, number=number, **how)
    for photo in list(bench.photos)[:photos]:
        session = bench.session(photo)
        if row is not None:
            session.apply(Straight(column=0, row=row, to_column=69, to_row=row), -1)
        session.apply(SetStatus(status="accepted"), -1)
    bench.close()
    return folder


def label_named(folder, names, row, annotator="ann"):
    """Accept a level line on some photos."""
    bench = workbench(folder, annotator)
    for photo in bench.photos.values():
        if photo.name in names:
            session = bench.session(photo.id)
            session.apply(Straight(column=0, row=row, to_column=69, to_row=row), -1)
            session.apply(SetStatus(status="accepted"), -1)
    bench.close()


def two_passes(folder):
    """Let two people agree on one photo of a folder, and not on another."""
    label_named(folder, ["hill-0.png", "hill-1.png"], 10, "ann")
    label_named(folder, ["hill-0.png"], 11, "bob")
    label_named(folder, ["hill-1.png"], 30, "bob")
    return folder


def labels_by_name(folder, annotator="consensus"):
    """Labels of a pass by the photo's name."""
    with closing(Store(folder, reading=True)) as store:
        return {one.name: one for one in store.labels(annotator, 1)}


def statuses(folder, annotator="ann"):
    """Status of each photo, as the page lists it."""
    bench = workbench(folder, annotator)
    found = {card.photo.name: card.status for card in bench.cards()}
    bench.close()
    return found


def rows_of(folder, annotator="ann"):
    """Rows of the labels that an export as CSV holds, by the stem of the photo."""
    out = folder.parent / "rows"
    shutil.rmtree(out, ignore_errors=True)
    if run("export", folder, "--out", out, "--annotator", annotator):
        return {}
    found = {}
    for file in out.glob("*.csv"):
        with file.open(newline="") as text:
            found[file.stem] = {int(float(line["row"])) for line in csv.DictReader(text)}
    return found


def change(folder, statement, *values):
    with closing(sqlite3.connect(folder / NAME)) as database, database:
        database.execute("PRAGMA ignore_check_constraints = ON")
        return database.execute(statement, values).fetchone()


def made(rows, annotator="ann", number=1, visible=None, origin=1, **other):
    """An accepted label of a made-up photo with these rows; other parts of it as they are given."""
    rows = np.asarray(rows, np.float32)
    width = len(rows)
    origins = (
        np.full(width, origin, np.uint8) if np.isscalar(origin) else np.array(origin, np.uint8)
    )
    parts = {
        "name": "hill.png",
        "digest": "aa",
        "status": "accepted",
        "tags": (),
        "operations": (),
        "seconds": 1.0,
        "detector": "",
        "blind": False,
    }
    return Label(
        width=width,
        height=1000,
        annotator=annotator,
        number=number,
        skyline=Skyline(rows=rows, visible=visible),
        origin=origins,
        **(parts | other),
    )
