"""Logs from elsewhere: whatever they hold, no label is made that cannot be read, or by half."""

import json
import sqlite3
from contextlib import closing

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from annotate.formats import FormatError, import_labels
from annotate.formats.whole import MOST_OPERATIONS
from annotate.store.database import NAME
from annotate.store.operations import Hide, SetStatus, SetTag, Straight
from annotate.store.store import Store
from annotate.work.importing import checked
from testing.examples import examples
from testing.labelling import served, workbench, write_hills
from testing.labels import POISON, label, poisoned, run

SOUND = [
    {"kind": "open", "at": 1.0},
    {"kind": "anchor", "column": 3, "row": 5, "at": 2.0},
    {"kind": "status", "status": "accepted", "at": 3.0},
]


@pytest.fixture(scope="module")
def document(tmp_path_factory):
    """What an export of two labels as JSON holds."""
    folder = label(write_hills(tmp_path_factory.mktemp("from") / "alps"), row=11)
    out = folder.parent / "out"
    assert run("export", folder, "--format", "json", "--out", out) == 0
    return json.loads((out / "labels.json").read_text())


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


def changed(document, **label):
    """The document with other values in its second label."""
    first, second = document["labels"]
    return {**document, "labels": [first, {**second, **label}]}


def imported(folder, document):
    """Import a document, which may hold what JSON cannot; return the exit status."""
    file = folder.parent / "labels.json"
    file.write_text(document if isinstance(document, str) else json.dumps(document))
    return run("import", folder, file)


def with_operations(*operations):
    return {"operations": [*SOUND, *operations]}


NESTED = "[" * 900 + "]" * 900

REFUSED = [
    (with_operations({"kind": "status"}), "operation 4"),
    (with_operations({"kind": "status", "status": ["a"]}), "operation 4"),
    (with_operations({"kind": "status", "status": "perfect"}), "operation 4"),
    (with_operations({"kind": "tag"}), "operation 4"),
    (with_operations({"kind": "tag", "tag": ["a"], "on": True}), "operation 4"),
    (with_operations({"kind": "rotate"}), "operation 4 of the log ('rotate') is unknown"),
    (with_operations({"kind": "anchor", "column": 5000, "row": 5}), "operation 4 of the log makes"),
    (with_operations({"kind": "anchor", "column": 10**30, "row": 5}), "operation 4"),
    (with_operations({"kind": "anchor", "column": 1.5, "row": 5}), "operation 4"),
    (with_operations({"kind": "anchor", "column": 1e400, "row": 5}), "operation 4"),
    (with_operations({"kind": "anchor", "column": True, "row": 5}), "operation 4"),
    (with_operations({"kind": "remove", "column": 9}), "there is no anchor in column 9"),
    (with_operations({"kind": "undo", "status": "yes"}), "operation 4"),
    (with_operations({"kind": "anchor", "column": 1, "row": 5, "more": 1}), "operation 4"),
    (with_operations({"kind": "drawn", "first": 0, "rows": [5] * 71}), "operation 4"),
    (with_operations({"kind": 7}), "operation 4 of the log has no kind"),
    (with_operations({"kind": "open", "at": float("nan")}), "operation 4 of the log has no sound"),
    (with_operations({"kind": "open", "at": float("inf")}), "operation 4 of the log has no sound"),
    (with_operations({"kind": "open", "at": None}), "operation 4 of the log has no sound time"),
    (with_operations({"kind": "open", "at": "now"}), "operation 4 of the log has no sound time"),
    (with_operations({"kind": "open", "at": 10**400}), "operation 4 of the log has no sound time"),
    (with_operations(7), "operations.3: input should be a valid dictionary"),
    ({"operations": "all"}, "operations: input should be a valid list"),
    ({"operations": [{"kind": "open", "at": 1.0}] * (MOST_OPERATIONS + 1)}, "at most 10000 items"),
    ({"number": 0}, "number: input should be greater than or equal to 1"),
    ({"number": -5}, "number: input should be greater than or equal to 1"),
    ({"number": 10**30}, "number: input should be"),
    ({"number": "1"}, "number: input should be a valid integer"),
    ({"annotator": ""}, "an annotator needs a name"),
    ({"annotator": "a\nb"}, "an annotator's name is plain text"),
    ({"annotator": "../../x"}, "an annotator's name is plain text"),
    ({"annotator": "x" * 81}, "at most 80 characters"),
    ({"annotator": None}, "annotator: input should be a valid string"),
    ({"status": "perfect"}, "status: input should be"),
    ({"digest": "../x"}, "digest: string should match"),
    ({"width": 0}, "width: input should be"),
    ({"skyline": None}, "skyline: input should be"),
    ({"origin": ["solved"]}, "70 columns, and as many origins"),
    ({"origin": ["guessed"] * 70}, "origin.0: input should be"),
    ({"seconds": float("nan")}, "seconds: input should be a finite number"),
    ({"tags": [5]}, "tags.0: input should be a valid string"),
    ({"name": "\ud800.png"}, "name: input should be a valid string"),
]


@pytest.mark.parametrize(("values", "sentence"), REFUSED)
def test_a_bad_label_is_named_and_loses_no_other(values, sentence, document, folder, capsys):
    capsys.readouterr()
    assert imported(folder, changed(document, **values)) == 1
    told = capsys.readouterr()
    assert sentence in told.err
    assert "labels.json: " in told.err
    assert "hill-1.png" in told.err or "name" in sentence
    assert told.err.count("\n") == 1
    assert "1 label imported" in told.out
    with closing(Store(folder, reading=True)) as store:
        assert [one.name for one in store.labels()] == ["hill-0.png"]
        assert store.unreadable == []


def test_where_all_labels_are_bad_nothing_is_made(document, folder, capsys):
    bad = with_operations({"kind": "rotate"})
    alone = {**document, "labels": changed(document, **bad)["labels"][1:]}
    assert imported(folder, alone) == 2
    assert "operation 4" in capsys.readouterr().err
    assert not (folder / NAME).exists()
    assert imported(folder, document) == 0


def test_a_file_that_is_none_leaves_no_labels_behind(folder, capsys):
    for text in (
        "",
        "{",
        "[]",
        '{"format": "skyline-labels"}',
        NESTED,
        '{"a": ' + "9" * 5000 + "}",
    ):
        assert imported(folder, text) in (1, 2)
        assert "Traceback" not in capsys.readouterr().err
        assert not (folder / NAME).exists()


def test_a_link_to_a_device_is_not_read_for_ever(folder, tmp_path, capsys):
    (tmp_path / "labels.json").symlink_to("/dev/zero")
    assert run("import", folder, tmp_path / "labels.json") == 2
    assert "it is a pipe or a device, not a file" in capsys.readouterr().err


def test_a_label_that_was_only_looked_at_is_a_line_to_be_reviewed(document, folder):
    looked = {"operations": SOUND[:1], "status": "to do"}
    assert imported(folder, changed(document, **looked)) == 0
    with served(folder, annotator="ann") as page:
        (photo,) = (
            one for one in page.get("/api/photos").json()["photos"] if one["name"] == "hill-1.png"
        )
        shown = page.get(f"/api/photos/{photo['id']}").json()
    assert (shown["status"], set(shown["rows"])) == ("needs review", {11})


def test_what_a_label_says_of_itself_follows_from_its_log(document, folder, capsys):
    capsys.readouterr()
    assert imported(folder, changed(document, status="rejected")) == 1
    assert "it says rejected, and its log ends with accepted" in capsys.readouterr().err


def test_of_two_labels_of_one_pass_in_a_file_the_first_counts(document, folder, capsys):
    twice = {**document, "labels": [*document["labels"], document["labels"][0]]}
    assert imported(folder, twice) == 1
    told = capsys.readouterr()
    assert "holds several labels of hill-0.png by ann, pass 1; the first of them counts" in told.err
    assert "2 labels imported" in told.out


def test_what_was_labelled_already_stays_and_the_rest_is_imported(document, folder, capsys):
    label(folder, row=20, photos=1)
    assert imported(folder, document) == 1
    said = capsys.readouterr()
    assert "1 label imported" in said.out
    assert "hill-0.png has been labelled by ann in pass 1 already." in said.err
    store = Store(folder, reading=True)
    rows = {one.name: set(one.skyline.rows) for one in store.labels() if one.skyline}
    store.close()
    assert rows == {"hill-0.png": {20}, "hill-1.png": {11}}


def test_all_labels_of_a_file_are_kept_at_once(document, folder, monkeypatch):
    import annotate.store.store as store  # noqa: PLC0415

    insert = store.insert

    def breaks(database, log):
        done = insert(database, log)
        if log.photo == 2:
            raise sqlite3.OperationalError("database or disk is full")
        return done

    monkeypatch.setattr(store, "insert", breaks)
    assert imported(folder, document) == 1
    kept = Store(folder, reading=True)
    assert list(kept.labels()) == []
    kept.close()


def test_blind_labels_stay_blind(document, folder):
    assert imported(folder, changed(document, blind=True)) == 0
    store = Store(folder, reading=True)
    assert [one.blind for one in store.labels()] == [False, True]
    store.close()


def test_what_leaves_comes_back_as_it_was(document, folder, tmp_path):
    assert imported(folder, document) == 0
    out = tmp_path / "again"
    assert run("export", folder, "--format", "json", "--out", out) == 0
    again = json.loads((out / "labels.json").read_text())
    for one, other in zip(document["labels"], again["labels"], strict=True):
        assert {**one, "detector": ""} == {**other, "detector": ""}


# Whatever a log holds


NUMBERS = st.one_of(
    st.integers(-5, 80),
    st.integers(),
    st.floats(),
    st.sampled_from([1e30, -1e30, float("nan"), float("inf"), 10**25, 0.5, True, None, "3", []]),
)
ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner),
    max_leaves=6,
)
PLACES = st.integers(0, 69)
OPERATIONS = st.one_of(
    st.fixed_dictionaries({"kind": st.just("anchor"), "column": PLACES, "row": st.integers(0, 47)}),
    st.fixed_dictionaries({"kind": st.just("anchor"), "column": NUMBERS, "row": NUMBERS}),
    st.fixed_dictionaries({"kind": st.just("remove"), "column": PLACES}),
    st.fixed_dictionaries(
        {"kind": st.just("move"), "from_column": PLACES, "column": NUMBERS, "row": NUMBERS}
    ),
    st.fixed_dictionaries({"kind": st.just("hidden"), "first": NUMBERS, "last": PLACES}),
    st.fixed_dictionaries({"kind": st.just("release"), "first": PLACES, "last": NUMBERS}),
    st.fixed_dictionaries(
        {"kind": st.just("drawn"), "first": PLACES, "rows": st.lists(NUMBERS, max_size=4)}
    ),
    st.fixed_dictionaries(
        {"kind": st.just("forbid"), "points": st.lists(ANYTHING, max_size=2), "radius": NUMBERS}
    ),
    st.sampled_from([{"kind": "undo"}, {"kind": "redo"}, {"kind": "undo", "status": True}]),
    st.fixed_dictionaries(
        {"kind": st.just("status"), "status": st.sampled_from(["accepted", "x"])}
    ),
    st.fixed_dictionaries({"kind": st.just("tag"), "tag": ANYTHING, "on": ANYTHING}),
    st.fixed_dictionaries({"kind": st.text(max_size=6)}, optional={"at": ANYTHING, "id": ANYTHING}),
    st.dictionaries(st.text(max_size=5), ANYTHING, max_size=3),
    ANYTHING,
)
TIMED = st.builds(
    lambda one, at: {"at": at, **one} if isinstance(one, dict) else one,
    OPERATIONS,
    st.one_of(st.floats(0, 1e9), NUMBERS),
)


@examples(60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(logs=st.lists(st.lists(TIMED, max_size=6), min_size=2, max_size=2))
def test_no_log_makes_a_label_that_cannot_be_read(document, tmp_path_factory, logs):
    folder = write_hills(tmp_path_factory.mktemp("any") / "alps", count=2)
    labels = [{**one, "operations": log} for one, log in zip(document["labels"], logs, strict=True)]
    status = imported(folder, {**document, "labels": labels})
    assert status in (0, 1, 2)
    if status == 2:
        assert not (folder / NAME).exists()
        return
    store = Store(folder)
    photos = store.find()
    cards = store.cards("ann", 1)
    assert [cards[photo.id].problem for photo in photos] == ["", ""]
    assert len(list(store.labels())) == 2 - status
    assert store.unreadable == []
    for photo in photos:
        if label_of := cards[photo.id].label:
            store.state(label_of)
    store.close()
    out = tmp_path_factory.mktemp("out") / "out"
    assert run("export", folder, "--status", "all", "--out", out) == 0
    assert run("status", folder) == 0


# A folder that was poisoned by an older version


@pytest.mark.parametrize(("kind", "body"), POISON)
def test_a_poisoned_folder_works_for_the_rest(kind, body, folder, tmp_path, capsys):
    poisoned(folder, kind, body)
    assert run("status", folder) == 0
    said = capsys.readouterr()
    assert "the label of hill-1.png by ann, pass 1, cannot be read" in said.err
    assert run("export", folder, "--out", tmp_path / "out") == 0
    said = capsys.readouterr()
    assert "1 label in" in said.out
    assert "the label of hill-1.png by ann, pass 1, cannot be read" in said.err
    assert [file.name for file in (tmp_path / "out").iterdir()] == ["hill-0.csv"]
    assert run("backup", folder, "--out", tmp_path / "kept.sqlite") == 0
    with served(folder) as page:
        listed = page.get("/api/photos")
        assert listed.status_code == 200
        ids = {one["name"]: one["id"] for one in listed.json()["photos"]}
        assert len(ids) == 3
        answer = page.get(f"/api/photos/{ids['hill-1.png']}")
        assert answer.status_code == 422
        assert "hill-1.png by ann, pass 1, cannot be read" in answer.json()["detail"]
        assert page.get(f"/api/photos/{ids['hill-1.png']}/strip").status_code in (200, 422)
        assert page.get(f"/api/photos/{ids['hill-0.png']}").status_code == 200
        assert page.get("/api/exports/csv").status_code == 200


def test_a_hostile_label_is_checked_before_the_store_sees_it(document, folder):
    file = folder.parent / "labels.json"
    file.write_text(json.dumps(changed(document, **with_operations({"kind": "rotate"}))))
    with closing(Store(folder, reading=True)) as store:
        photos = {photo.name: photo for photo in store.find()}
    found = import_labels(file, folder, photos)
    assert (found.problems, found.notes) == ((), ())
    bad = next(one for one in found if one.name == "hill-1.png")
    with pytest.raises(FormatError, match="operation 4"):
        checked(bad, photos["hill-1.png"], "ann", 1, status="accepted", source="labels.json")


def test_no_visible_skyline_and_what_hides_columns_go_there_and_come_back(folder, tmp_path):
    bench = workbench(folder)
    session = bench.session(1)
    for one in (
        Straight(column=0, row=9, to_column=69, to_row=9),
        Hide(first=3, last=8, why="fog"),
        SetTag(tag="no visible skyline", on=True),
        SetStatus(status="accepted"),
    ):
        session.apply(one, -1)
    bench.close()
    out = tmp_path / "out"
    assert run("export", folder, "--format", "json", "--out", out) == 0
    (told,) = json.loads((out / "labels.json").read_text())["labels"]
    assert not any(told["skyline"]["visible"])
    assert told["hidden"] == [{"first": 3, "last": 8, "why": "fog"}]
    other = write_hills(tmp_path / "other")
    assert run("import", other, out) == 0
    bench = workbench(other)
    session = bench.session(1)
    assert session.state.edits.hidden == session.wire.edits.hidden == ((3, 8, "fog"),)
    assert session.wire.skyline.visible.sum() == 64  # as the annotator left it, tag aside
    assert session.state.tags == ("no visible skyline",)
    (label_of,) = bench.joined().labels
    assert not label_of.skyline.visible.any()
    bench.close()
