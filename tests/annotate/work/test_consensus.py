"""The consensus: what is written into it, and what is left alone."""

import pytest

from annotate.store.operations import Draw, SetAnchor, SetStatus
from annotate.store.store import Store
from testing.labelling import workbench, write_hills
from testing.labels import label, label_named, labels_by_name, run, statuses, two_passes


@pytest.fixture
def folder(tmp_path):
    return two_passes(write_hills(tmp_path / "alps"))


def test_what_people_have_decided_or_begun_stays(folder, capsys):
    run("consensus", folder)
    bench = workbench(folder, "consensus")
    session = bench.session(2)
    session.apply(SetAnchor(column=30, row=20), -1)
    rows = session.wire.skyline.rows
    bench.close()
    label_named(folder, ["hill-0.png", "hill-1.png"], 10, "bob")  # bob agrees by now
    capsys.readouterr()
    assert run("consensus", folder) == 0
    said = capsys.readouterr()
    assert "somebody has decided or worked on them: 2" in said.out
    assert "labelled anew since the consensus was decided: hill-0.png, hill-1.png." in said.err
    assert set(labels_by_name(folder)["hill-0.png"].skyline.rows) == {11}
    kept = labels_by_name(folder)["hill-1.png"]
    assert kept.status == "needs review"
    assert kept.skyline.rows.tolist() == rows.tolist()


def test_what_nobody_has_touched_follows_the_passes(folder):
    run("consensus", folder)
    label_named(folder, ["hill-1.png"], 12, "bob")
    assert run("consensus", folder) == 0
    found = labels_by_name(folder)["hill-1.png"]
    assert (found.status, found.comment, set(found.skyline.rows)) == ("accepted", None, {11})


def test_a_comment_of_a_person_is_work_too(folder):
    run("consensus", folder)
    bench = workbench(folder, "consensus", reviewer="eve")
    bench.session(2).apply(SetStatus(status="needs review", comment="ask the guide"), -1)
    bench.close()
    label_named(folder, ["hill-1.png"], 10, "bob")
    run("consensus", folder)
    assert str(labels_by_name(folder)["hill-1.png"].comment) == "eve: ask the guide"


def test_what_was_undone_is_no_work(folder):
    run("consensus", folder)
    bench = workbench(folder, "consensus")
    session = bench.session(2)
    session.apply(Draw(first=3, rows=[9, 9]), -1)
    session.undo(-1)
    bench.close()
    label_named(folder, ["hill-1.png"], 10, "bob")
    run("consensus", folder)
    assert statuses(folder, "consensus")["hill-1.png"] == "accepted"


def test_photos_that_some_have_rejected_wait_and_those_of_all_are_rejected(folder, capsys):
    for who in ("ann", "bob"):
        bench = workbench(folder, who)
        bench.session(3).apply(SetStatus(status="rejected"), -1)
        if who == "bob":
            bench.session(1).apply(SetStatus(status="rejected"), -1)
        bench.close()
    assert run("consensus", folder) == 0
    out = capsys.readouterr().out
    assert "Rejected, as by all: 1" in out
    assert "hill-0.png: rejected by bob, accepted by ann" in out
    assert statuses(folder, "consensus") == {
        "hill-0.png": "needs review",
        "hill-1.png": "needs review",
        "hill-2.png": "rejected",
    }


def test_columns_keep_where_they_are_from_also_after_somebody_has_decided(tmp_path):
    folder = write_hills(tmp_path / "alps", count=1)
    label(folder, "ann", photos=1)  # as it was proposed
    bench = workbench(folder, "bob")
    session = bench.session(1)
    proposed = session.wire.skyline.rows
    rows = (proposed[20:30] + 9).astype(int).tolist()
    session.apply(Draw(first=20, rows=rows), -1)
    session.apply(SetStatus(status="accepted"), -1)
    bench.close()
    assert run("consensus", folder) == 0
    bench = workbench(folder, "consensus")
    bench.session(1).apply(SetAnchor(column=25, row=int(proposed[25])), -1)
    bench.session(1).apply(SetStatus(status="accepted"), -1)
    bench.close()
    found = labels_by_name(folder)["hill-0.png"]
    assert set(found.origin[:10]) == set(found.origin[60:]) == {0}  # `proposal`


def test_whoever_works_on_a_photo_meanwhile_keeps_it(folder, monkeypatch):
    run("consensus", folder)
    label_named(folder, ["hill-1.png"], 10, "bob")
    appended = Store.append_all

    def late(store, wanted):
        monkeypatch.setattr(Store, "append_all", appended)
        (label, *_) = [one.label for one, _ in wanted]
        store.append(label, -1, "anchor", {"column": 3, "row": 4}, store.line(label))
        return appended(store, wanted)

    monkeypatch.setattr(Store, "append_all", late)
    assert run("consensus", folder) == 0
    kept = labels_by_name(folder)["hill-1.png"]
    assert (kept.status, kept.operations[-1]["kind"]) == ("needs review", "anchor")
