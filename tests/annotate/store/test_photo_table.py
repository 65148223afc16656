"""What is kept of photos: digests, and stamps of files that are settled."""

import sqlite3
from contextlib import closing

import pytest

import annotate.store.identity as identity
import annotate.store.photo_table as photo_table
from annotate.store.database import NAME
from annotate.store.store import Store
from testing.edited_photos import with_comment, write_jpegs
from testing.labelling import workbench
from testing.labels import label_named, rows_of, statuses


@pytest.fixture
def folder(tmp_path):
    return write_jpegs(tmp_path / "alps")


def test_labels_of_an_older_version_learn_their_pixels_once(folder, monkeypatch):
    label_named(folder, ["hill-1.jpg"], 11)
    with closing(sqlite3.connect(folder / NAME)) as labels, labels:
        labels.execute("UPDATE photos SET pixels = NULL, touched = NULL")
    Store(folder, reading=True).close()
    bench = workbench(folder)
    bench.close()
    with_comment(folder / "hill-1.jpg")
    assert statuses(folder)["hill-1.jpg"] == "accepted"


def test_known_bytes_are_the_photo_whatever_their_pixels_are_read_as(folder, monkeypatch):
    label_named(folder, ["hill-1.jpg"], 11)
    with closing(sqlite3.connect(folder / NAME)) as labels, labels:
        labels.execute("UPDATE photos SET pixels = 'of another decoder' WHERE pixels IS NOT NULL")
    assert rows_of(folder) == {"hill-1": {11}}
    bench = workbench(folder)
    for photo in bench.photos:
        bench.session(photo)
    bench.close()
    with_comment(folder / "hill-1.jpg")
    assert rows_of(folder) == {"hill-1": {11}}


def test_the_table_of_photos_keeps_no_stamp_of_a_file_that_may_still_change(folder):
    stamp = identity.Stamp.of((folder / "hill-0.jpg").stat())
    assert not stamp.settled
    assert photo_table._stamp(stamp)[2] == 0
