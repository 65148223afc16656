"""Labels whose photos are not there: listed, and exported under names of their own."""

import json

import pytest

from annotate.formats import FORMATS
from testing.edited_photos import replaced, write_jpegs
from testing.labelling import workbench
from testing.labels import label_named, run


@pytest.fixture
def folder(tmp_path):
    return write_jpegs(tmp_path / "alps")


def test_orphans_are_listed_and_leave_under_their_own_names(folder, tmp_path, capsys):
    label_named(folder, ["hill-0.jpg", "hill-1.jpg", "hill-2.jpg"], 11)
    replaced(folder / "hill-1.jpg", seed=7)
    (folder / "hill-2.jpg").unlink()
    assert run("status", folder, "--orphans") == 0
    said = capsys.readouterr()
    assert [line.split(" ")[0] for line in said.out.splitlines()[-2:]] == [
        "hill-1.jpg",
        "hill-2.jpg",
    ]
    assert "2 labels belong to photos that are not here any more: hill-1.jpg (sha256" in said.err
    out = tmp_path / "csv"
    assert run("export", folder, "--orphans", "--out", out) == 0
    names = sorted(file.name for file in out.iterdir())
    assert names[0].startswith("hill-1.sha256-")  # hill-1 is another photo's now
    assert names[1] == "hill-2.csv"
    for kind in FORMATS:
        if kind not in ("csv", "json"):
            assert run("export", folder, "--orphans", "--format", kind, "--out", "x") == 2
            assert f"leave as csv and json only, not as {kind}" in capsys.readouterr().err
    out = tmp_path / "json"
    assert run("export", folder, "--orphans", "--format", "json", "--out", out) == 0
    document = json.loads((out / "labels.json").read_text())
    assert [one["name"] for one in document["labels"]] == ["hill-1.jpg", "hill-2.jpg"]
    assert run("import", folder, out, "--annotator", "eve") == 2
    assert "not in" in capsys.readouterr().err


def test_no_orphans_is_a_sentence(folder, tmp_path, capsys):
    label_named(folder, ["hill-0.jpg"], 11)
    assert run("export", folder, "--orphans", "--out", tmp_path / "out") == 2
    assert "the photos of all labels of ann, pass 1, are there." in capsys.readouterr().err


def test_photos_that_were_only_looked_at_are_no_orphans(folder, capsys):
    bench = workbench(folder)
    for photo in bench.photos:
        bench.session(photo)
    bench.close()
    (folder / "hill-2.jpg").unlink()
    assert run("status", folder) == 0
    assert capsys.readouterr().err == ""
