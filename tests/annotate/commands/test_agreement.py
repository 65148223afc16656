"""``skyline-annotate status`` and ``agreement``: what they say."""

import re

import pytest

from skyline_viz.photo import read_photo
from testing.labelling import write_hills
from testing.labels import label, run


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


def test_status_is_a_table(folder, capsys):
    label(folder)
    assert run("status", folder) == 0
    out = capsys.readouterr().out
    assert "3 photos" in out
    row = next(line for line in out.splitlines() if line.startswith("ann "))
    assert re.split(r"\s{2,}", row.strip())[:5] == ["ann", "1", "1", "0", "2"]


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
