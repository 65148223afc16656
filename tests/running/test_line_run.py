"""Detecting into a table: each photo once, nothing done twice, whatever happens between."""

import os
from dataclasses import replace
from functools import partial

import pyarrow.parquet as pq
import pytest

import skyline_viz as sv
from skyline_viz.running import line_run
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.line_run import detect_into, nameable
from skyline_viz.running.line_store import store_of
from skyline_viz.running.line_table import read_about
from skyline_viz.storage.addresses import StorageError, UnseenError
from skyline_viz.storage.stored_photo import StoredPhoto
from testing.programs.commands import scene, write_scene

ONE_BY_ONE = partial(run, workers=1)


@pytest.fixture
def photos(tmp_path):
    return [StoredPhoto(str(write_scene(tmp_path / f"p{at}.png", at))) for at in range(4)]


@pytest.fixture
def detected(monkeypatch):
    """The names of photos that were detected."""
    names, plain = [], line_run.found_row

    def found_row(name, *more):
        names.append(name.rsplit("/", 1)[-1])
        return plain(name, *more)

    monkeypatch.setattr(line_run, "found_row", found_row)
    return names


def rows(table):
    return {row["photo"].rsplit("/", 1)[-1]: row for row in pq.read_table(table).to_pylist()}


def test_a_table_holds_each_photo_once_in_order(photos, tmp_path):
    table = tmp_path / "t.parquet"
    done = detect_into(table, [*photos, photos[1]], sv.Detector(), ONE_BY_ONE, {"run": 1})
    assert (done.photos, done.known, done.failures) == (4, 0, [])
    told = pq.read_table(table).to_pylist()
    assert [row["photo"] for row in told] == [photo.name for photo in photos]
    line = sv.Detector().detect(scene(2)[0]).skyline
    assert told[2]["rows"] == line.rows.tolist()
    assert not store_of(table).exists()


def test_what_is_done_is_not_done_again_and_what_has_changed_is(photos, tmp_path, detected):
    table = tmp_path / "t.parquet"
    detect_into(table, photos[:3], sv.Detector(), ONE_BY_ONE, {})
    before = rows(table)
    write_scene(tmp_path / "p1.png", 7)
    detected.clear()
    done = detect_into(table, photos, sv.Detector(), ONE_BY_ONE, {})
    assert (detected, done.known) == (["p1.png", "p3.png"], 2)
    after = rows(table)
    assert [after[name] == before[name] for name in ("p0.png", "p1.png", "p2.png")] == [1, 0, 1]
    detected.clear()
    other = sv.Detector(config=sv.DetectorConfig(delta=2))
    assert detect_into(table, photos, other, ONE_BY_ONE, {}).known == 0
    assert len(detected) == 4


def test_a_run_that_was_interrupted_goes_on(photos, tmp_path, detected):
    table = tmp_path / "t.parquet"

    def interrupted(function, tasks):
        for number, outcome in enumerate(run(function, tasks, workers=1)):
            yield outcome
            if number == 1:
                raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        detect_into(table, photos, sv.Detector(), interrupted, {})
    assert not table.exists()
    done = detect_into(table, photos, sv.Detector(), ONE_BY_ONE, {})
    assert done.known == 2
    assert detected == ["p0.png", "p1.png", "p2.png", "p3.png"]
    assert len(rows(table)) == 4


def test_photos_that_fail_are_named_and_tried_again(photos, tmp_path, detected):
    table = tmp_path / "t.parquet"
    whole = (tmp_path / "p2.png").read_bytes()
    (tmp_path / "p2.png").write_bytes(b"")
    done = detect_into(table, photos, sv.Detector(), ONE_BY_ONE, {})
    assert [str(one) for one in done.failures] == [f"{photos[2].name} is empty (0 bytes)."]
    assert rows(table)["p2.png"]["error"] == f"{photos[2].name} is empty (0 bytes)."
    (tmp_path / "p2.png").write_bytes(whole)
    detected.clear()
    assert detect_into(table, photos, sv.Detector(), ONE_BY_ONE, {}).known == 3
    assert detected == ["p2.png"]
    assert rows(table)["p2.png"]["error"] is None


def test_a_stamp_spares_the_download(photos, tmp_path, monkeypatch, detected):
    table = tmp_path / "t.parquet"
    stamped = [StoredPhoto(photo.name, stamp="ETag 1") for photo in photos]
    detect_into(table, stamped, sv.Detector(), ONE_BY_ONE, {})
    asked = []

    def listed(function, tasks):
        asked.extend(task.name for task in tasks)
        return run(function, tasks, workers=1)

    assert detect_into(table, stamped, sv.Detector(), listed, {}).known == 4
    assert asked == []
    detected.clear()
    moved = [StoredPhoto(photo.name, stamp="ETag 2") for photo in photos]
    assert detect_into(table, moved, sv.Detector(), listed, {}).known == 4
    assert (len(asked), detected) == (4, [])  # downloaded, and found to be the same
    assert {row["stamp"] for row in rows(table).values()} == {"ETag 2"}


def test_rows_outlive_an_outage_unless_the_photo_is_known_to_have_changed(
    photos, tmp_path, monkeypatch
):
    table = tmp_path / "t.parquet"
    stamped = [*photos[:2], replace(photos[2], stamp="ETag 1")]
    detect_into(table, stamped, sv.Detector(), ONE_BY_ONE, {})
    before = rows(table)

    def out(photo, known=""):
        if photo.name.endswith("p1.png"):
            raise StorageError("it does not exist.")
        raise UnseenError("it is busy.")

    monkeypatch.setattr(StoredPhoto, "read", out)
    again = [*stamped[:2], replace(photos[2], stamp="ETag 2"), photos[3]]
    done = detect_into(table, again, sv.Detector(), ONE_BY_ONE, {})
    stays = "it is busy; its row of an earlier run stays."
    assert done.unseen == [Failure(photos[0].name, stays)]
    assert [one.name for one in done.failures] == [one.name for one in again[1:]]
    after = rows(table)
    assert after["p0.png"] == before["p0.png"]
    assert [after[f"p{at}.png"]["error"] for at in (1, 2, 3)] == [
        "it does not exist.",
        "it is busy.",
        "it is busy.",
    ]


def test_a_name_that_is_no_text_fails_alone(photos, tmp_path):
    odd = tmp_path / os.fsdecode(b"b\xff.png")
    odd.write_bytes((tmp_path / "p1.png").read_bytes())
    named = nameable([photos[0], StoredPhoto(str(odd)), photos[2]])
    table = tmp_path / "t.parquet"
    done = detect_into(table, named, sv.Detector(), ONE_BY_ONE, {"words": str(odd)})
    escaped = f"{tmp_path}/b\\xff.png"
    reason = f"{escaped} has a name that is no text, and a table holds text; rename it."
    assert [str(one) for one in done.failures] == [reason]
    told = pq.read_table(table).to_pylist()
    assert [row["photo"] for row in told] == [photos[0].name, escaped, photos[2].name]
    assert [row["error"] for row in told] == [None, reason, None]
    assert read_about(table)["words"] == str(odd)
    assert not store_of(table).exists()


def test_escaped_names_do_not_meet():
    names = ["b\udcff.png", "b\\xff.png", "c.png"]
    named = [one.name for one in nameable([*map(StoredPhoto, names)])]
    assert named == ["b\\xff.png'", *names[1:]]


def test_rows_of_photos_that_are_not_named_are_counted(photos, tmp_path):
    table = tmp_path / "t.parquet"
    assert detect_into(table, photos[:3], sv.Detector(), ONE_BY_ONE, {}).gone == 0
    assert detect_into(table, photos[2:], sv.Detector(), ONE_BY_ONE, {}).gone == 2
    other = sv.Detector(config=sv.DetectorConfig(delta=2))
    assert detect_into(table, photos[3:], other, ONE_BY_ONE, {}).gone == 1
