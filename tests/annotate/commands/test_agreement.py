"""``skyline-annotate agreement``: what it says."""

import json
import re

import pytest

from skyline_viz.photo import read_photo
from testing.labelling import write_hills
from testing.labels import label, label_named, run


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


def row(out, name):
    """Cells of the row of a table that begins with a name."""
    found = next(line for line in out.splitlines() if re.match(rf"{re.escape(name)}  ", line))
    return re.split(r"\s{2,}", found.strip())[1:]


def test_agreement_of_two_annotators(folder, tmp_path, capsys):
    label(folder, "ann", row=10)
    label(folder, "bob", row=13)
    picture = tmp_path / "apart.png"
    assert run("agreement", folder, "--picture", picture) == 0
    out = capsys.readouterr().out
    assert "2 passes, 2 photos accepted in several of them" in out
    figures = ["2", "3.00", "3.00 to 3.00", "3", "0.0%", "0.0%", "100.0%", "-"]
    assert row(out, "ann and bob") == figures
    assert "hill-0.png  mean 3.00, worst 3 px  (ann and bob)" in out
    assert read_photo(picture).shape[1] == 960


def test_agreement_of_all_passes_or_of_some(folder, tmp_path, capsys):
    label(folder, "ann", 1, row=10)
    label(folder, "ann", 2, row=11)
    label(folder, "bob", 1, row=30)
    assert run("agreement", folder, "--out", tmp_path / "out") == 0
    out = capsys.readouterr().out
    assert row(out, "ann:2") == ["1.00", "-", "19.00"]  # of the matrix
    assert row(out, "ann, twice")[1] == "1.00"
    assert row(out, "ann with others")[1] == "19.50"
    assert len(json.loads((tmp_path / "out" / "agreement.json").read_text())["pairs"]) == 3
    assert (tmp_path / "out" / "photos.csv").read_text().count("\n") == 7
    assert run("agreement", folder, "--passes", "ann", "ann:2") == 0
    out = capsys.readouterr().out
    assert row(out, "ann and ann:2")[1] == "1.00"
    assert "bob" not in out
    assert run("agreement", folder, "--passes", "ann", "eve") == 2
    said = "there is no pass eve; there are ann:1, ann:2, bob:1."
    assert said in capsys.readouterr().err


def test_the_consensus_is_compared_where_it_is_named(folder, capsys):
    label(folder, "ann", row=10)
    label(folder, "bob", row=11)
    assert run("consensus", folder) == 0
    assert run("agreement", folder) == 0
    assert "consensus" not in capsys.readouterr().out.split("passes, 2 photos")[1]
    assert run("agreement", folder, "--passes", "consensus", "ann") == 0
    assert row(capsys.readouterr().out, "consensus and ann")[1] == "1.00"


def test_blind_labels_stand_beside_proposed_ones(folder, capsys):
    label(folder, "ann", row=10)
    label(folder, "bob", row=13, blind=1.0)
    assert run("agreement", folder) == 0
    out = capsys.readouterr().out
    assert row(out, "one blind")[:2] == ["2", "3.00"]
    assert "Proposed lines lie 3.00 px higher than blind ones (3.00 to 3.00)." in out


def test_passes_without_a_photo_in_common_are_one_sentence(folder, capsys):
    label(folder, "ann", row=10, photos=1)
    assert run("agreement", folder) == 2
    assert "two passes are compared at least, and with accepted photos: ann:1." in (
        capsys.readouterr().err
    )
    label_named(folder, ["hill-2.png"], 20, "bob")
    assert run("agreement", folder) == 2
    assert "no photo has been accepted in two of the passes ann:1, bob:1." in (
        capsys.readouterr().err
    )
