"""``skyline-annotate``: what its commands say and do."""

import json
import re

import numpy as np
import pytest

from annotate.agreement import paired
from annotate.cli import main
from annotate.commands.open import propose_all
from annotate.store.database import NAME
from annotate.store.operations import SetStatus, Straight
from annotate.store.store import Store
from annotate.work.doubts import read_doubts
from annotate.work.workbench import Assignment, Workbench
from skyline_viz import __version__
from skyline_viz.datasets.layouts import open_dataset
from skyline_viz.photo import read_photo
from skyline_viz.skyline import Skyline
from testing.labelling import DETECTOR, workbench, write_hills


def run(*words):
    return main([str(word) for word in words])


def label(folder, annotator="ann", number=1, row=None, photos=2):
    """Accept the proposals of some photos; with `row`, after drawing a level line there."""
    bench = workbench(folder, annotator, number=number)
    for photo in list(bench.photos)[:photos]:
        session = bench.session(photo)
        if row is not None:
            session.apply(Straight(column=0, row=row, to_column=69, to_row=row), -1)
        session.apply(SetStatus(status="accepted"), -1)
    bench.close()
    return folder


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


def test_help_and_version(capsys):
    assert run("--version") == 0
    assert capsys.readouterr().out == f"skyline-annotate {__version__}\n"
    for words in (
        [],
        ["open"],
        ["export"],
        ["import"],
        ["status"],
        ["agreement"],
        ["backup"],
        ["repair"],
    ):
        assert run(*words, "--help") == 0
        assert "usage: skyline-annotate" in capsys.readouterr().out


def test_status_is_a_table(folder, capsys):
    label(folder)
    assert run("status", folder) == 0
    out = capsys.readouterr().out
    assert "3 photos" in out
    row = next(line for line in out.splitlines() if line.startswith("ann "))
    assert re.split(r"\s{2,}", row.strip())[:5] == ["ann", "1", "1", "0", "2"]


@pytest.mark.parametrize(
    "kind", ["mask", "painted", "ch1", "csv", "json", "coco", "labelme", "cvat"]
)
def test_labels_leave_and_come_back(folder, kind, tmp_path, capsys):
    label(folder)
    out = tmp_path / "out"
    assert run("export", folder, "--format", kind, "--out", out) == 0
    said = capsys.readouterr().out
    assert f"2 labels in {out}" in said
    assert "Not in it: 1 photo of the folder." in said
    again = write_hills(tmp_path / "again")
    words = ["import", again, out, "--annotator", "eve", "--status", "accepted"]
    assert run(*words) == 0
    assert "2 labels imported" in capsys.readouterr().out
    lines = []
    for place, who in ((folder, "ann"), (again, "eve")):
        store = Store(place)
        lines.append([one for one in store.labels(who) if one.status == "accepted"])
        store.close()
    assert [one.skyline for one in lines[0]] == [one.skyline for one in lines[1]]
    assert run(*words) == 1
    assert "has been labelled by eve in pass 1 already" in capsys.readouterr().err


def test_undone_statuses_leave_and_come_back(folder, tmp_path):
    bench = workbench(folder)
    session = bench.session(1)
    session.apply(SetStatus(status="accepted"), -1)
    session.apply(Straight(column=0, row=9, to_column=69, to_row=9), -1)
    session.undo(-1)
    assert session.state.status == "accepted"
    kept = session.state
    bench.close()
    assert run("export", folder, "--format", "json", "--out", tmp_path / "out") == 0
    file = tmp_path / "out" / "labels.json"
    document = json.loads(file.read_text())
    assert document["version"] == 2  # programs that would misread the undo refuse it
    assert run("import", write_hills(tmp_path / "again"), file) == 0
    store = Store(tmp_path / "again")
    came = store.state(1)
    assert (came.status, came.edits, came.steps) == ("accepted", kept.edits, kept.steps)
    assert came.taken == kept.taken
    store.close()
    file.write_text(json.dumps({**document, "version": 1}))  # as programs before wrote it
    assert run("import", write_hills(tmp_path / "third"), file) == 0
    file.write_text(json.dumps({**document, "version": 3}))
    assert run("import", write_hills(tmp_path / "fourth"), file) == 2


def test_imported_labels_can_be_edited_on(folder, tmp_path):
    label(folder, row=11)
    assert run("export", folder, "--format", "json", "--out", tmp_path / "out") == 0
    again = write_hills(tmp_path / "again")
    assert run("import", again, tmp_path / "out" / "labels.json") == 0
    bench = workbench(again)
    session = bench.session(1)
    assert session.state.status == "accepted"
    assert set(session.wire.skyline.rows) == {11}
    session.undo(-1)
    assert session.state.status == "in progress"
    session.undo(-1)
    assert len(set(session.wire.skyline.rows)) > 1
    bench.close()


def test_an_export_is_a_data_set(folder, tmp_path):
    label(folder)
    assert run("export", folder, "--format", "ch1", "--out", tmp_path / "out") == 0
    items = list(open_dataset(tmp_path / "out"))
    assert len(items) == 2
    for item in items:
        np.testing.assert_array_equal(item.photo(), read_photo(folder / item.photo_path.name))
        assert isinstance(item.truth(), Skyline)


def test_agreement_of_two_annotators(folder, tmp_path, capsys):
    label(folder, "ann", row=10)
    label(folder, "bob", row=13)
    picture = tmp_path / "apart.png"
    assert run("agreement", folder, "--picture", picture) == 0
    out = capsys.readouterr().out
    assert "ann and bob, 2 photos" in out
    assert "mean difference   3.00 px a column" in out
    assert "worst difference  3 px" in out
    assert "within 2 px       0.0% of 140 columns" in out
    assert "within 5 px       100.0% of 140 columns" in out
    assert read_photo(picture).shape[1] == 960


def test_agreement_of_two_passes(folder, capsys):
    label(folder, "ann", 1, row=10)
    label(folder, "ann", 2, row=10)
    label(folder, "bob", 1, row=30)
    assert run("agreement", folder) == 2
    assert "which two passes? There are ann:1, ann:2, bob:1" in capsys.readouterr().err
    assert run("agreement", folder, "--first", "ann", "--second", "ann:2") == 0
    assert "mean difference   0.00 px" in capsys.readouterr().out
    assert run("agreement", folder, "--first", "ann", "--second", "eve") == 2


def test_only_columns_that_both_see_are_compared(folder):
    label(folder, "ann", row=10)
    label(folder, "bob", row=20)
    store = Store(folder)
    first, second = list(store.labels("ann")), list(store.labels("bob"))
    store.close()
    visible = np.arange(70) < 7
    object.__setattr__(first[0], "skyline", Skyline(rows=first[0].skyline.rows, visible=visible))
    assert [len(pair.differences) for pair in paired(first[:1], second)] == [7]


def test_a_backup_is_one_file(folder, tmp_path, capsys):
    label(folder)
    assert run("backup", folder, "--out", tmp_path / "kept.sqlite") == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "kept.sqlite")
    again = write_hills(tmp_path / "again")
    (tmp_path / "kept.sqlite").rename(again / NAME)
    assert run("status", again) == 0
    assert run("backup", folder, "--out", again / NAME) == 2


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["open", "nowhere"], "nowhere does not exist."),
        (["open", "empty"], "empty holds no photograph."),
        (["open", "alps", "--blind", "2"], "--blind is a share from 0 to 1, not 2.0."),
        (["open", "alps", "--pass-number", "0"], "there is no pass 0."),
        (["open", "alps", "--port", "99999"], "there is no port 99999."),
        (["open", "alps", "--host", "192.0.2.1"], "cannot listen on 192.0.2.1"),
        (["open", "alps", "--bank", "nothing.npz"], "nothing.npz does not exist."),
        (["status", "empty"], "empty has no labels yet"),
        (["export", "empty"], "empty has no labels yet"),
        (["export", "done", "--out", "alps"], "alps exists already"),
        (["export", "done", "--annotator", "eve"], "there is no such pass; there are ann 1."),
        (["import", "alps", "nowhere"], "nowhere does not exist."),
        (["import", "alps", "empty"], "empty is of no known format"),
        (["import", "empty", "alps"], "empty holds no photograph."),
        (["agreement", "done"], "which two passes? There are ann:1"),
        (["agreement", "done", "--picture", "x.gif"], "should end in .png or .jpg."),
        (["backup", "empty"], "empty has no labels to back up."),
    ],
)
def test_what_is_wrong_is_one_sentence(words, sentence, folder, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    label(write_hills(tmp_path / "done"), photos=1)
    assert run(*words) in (1, 2)
    err = capsys.readouterr().err
    assert sentence in err
    assert err.count("\n") == 1
    assert err.startswith("skyline-annotate: ")


def test_the_least_certain_photo_comes_first(folder):
    bench = workbench(folder, order="margin")
    propose_all(bench)
    margins = [card.margin for card in bench.cards()]
    assert None not in margins
    assert margins == sorted(margins)
    bench.close()


def test_random_orders_and_blind_shares_are_seeded(tmp_path):
    folder = write_hills(tmp_path, count=12)

    def order(seed):
        bench = workbench(folder, order="random", blind=0.5, seed=seed)
        names = [card.photo.name for card in bench.cards()]
        blind = {photo for photo in bench.photos if bench.store.is_blind(bench.label(photo))}
        bench.close()
        return names, blind

    (first, blind), (second, _) = order(0), order(1)
    assert sorted(first) == sorted(second)
    assert first != second
    assert order(0)[0] == first
    assert 2 <= len(blind) <= 10


def test_doubtful_truths_are_opened_where_they_are_doubtful(folder, tmp_path, capsys):
    segments = [
        {"cause": "truth doubtful", "columns": [3, 6]},
        {"cause": "truth doubtful", "columns": [20, 40]},
        {"cause": "missed edge", "columns": [0, 69]},
    ]
    photos = [
        {"name": "hill-1", "segments": segments},
        {"name": "hill-2", "segments": segments[2:]},
    ]
    document = {"format": "skyline-diagnosis", "version": 1, "photos": photos}
    file = tmp_path / "diagnosis.json"
    file.write_text(json.dumps(document))
    bench = Workbench(Store(folder), DETECTOR, Assignment("ann"), read_doubts(file))
    assert [photo.name for photo in bench.photos.values()] == ["hill-1.png"]
    assert list(bench.doubts.values()) == [30]
    assert [card.photo.name for card in bench.cards()] == ["hill-1.png"]
    bench.close()
    file.write_text(json.dumps({**document, "photos": photos[1:]}))
    assert run("open", folder, "--from-diagnosis", file) == 2
    assert "doubts no truth of a photo" in capsys.readouterr().err


def diagnosis_with(columns, name="hill-1", version=1):
    """A diagnosis that doubts a truth, as text."""
    return (
        f'{{"format": "skyline-diagnosis", "version": {version}, "photos": [{{"name": "{name}", '
        f'"segments": [{{"cause": "truth doubtful", "columns": {columns}}}]}}]}}'
    )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{}", "holds no diagnosis"),
        ("[]", "holds no diagnosis"),
        ("{", "holds no diagnosis: it is not JSON"),
        ("\udc80", "holds no diagnosis: it is not JSON"),
        ("[" * 100_000, "holds no diagnosis: it is not JSON"),
        (diagnosis_with("[1e400, 5]"), "holds a diagnosis that is damaged"),
        (diagnosis_with('["a", "b"]'), "holds a diagnosis that is damaged"),
        (diagnosis_with('{"a": 1}'), "holds a diagnosis that is damaged"),
        (diagnosis_with("[]"), "holds a diagnosis that is damaged"),
        ('{"format": "skyline-diagnosis", "version": 1}', "holds a diagnosis that is damaged"),
        (
            diagnosis_with("[1, 2]", version=99),
            "is not a diagnosis of version 1, the only one known",
        ),
    ],
)
def test_a_broken_diagnosis_is_one_plain_sentence(text, said, folder, tmp_path, capsys):
    file = tmp_path / "diagnosis.json"
    file.write_text(text, errors="surrogateescape")
    assert run("open", folder, "--from-diagnosis", file) == 2
    assert capsys.readouterr().err == f"skyline-annotate: {file} {said}.\n"


def test_a_diagnosis_that_is_not_there_is_said_not_to_exist(folder, tmp_path, capsys):
    file = tmp_path / "diagnosis.json"
    assert run("open", folder, "--from-diagnosis", file) == 2
    assert capsys.readouterr().err == f"skyline-annotate: {file} does not exist.\n"


def test_doubtful_columns_beyond_the_rims_are_the_rims(folder, tmp_path):
    file = tmp_path / "diagnosis.json"
    for columns, opened in (("[-50, -10]", 0), ("[5000, 6000]", 69)):
        file.write_text(diagnosis_with(columns))
        bench = Workbench(Store(folder), DETECTOR, Assignment("ann"), read_doubts(file))
        assert list(bench.doubts.values()) == [opened]
        bench.close()
