"""``skyline-annotate consensus``: what it says, and that exports take what it writes."""

import pytest

from testing.labelling import write_hills
from testing.labels import label, labels_by_name, run, two_passes


@pytest.fixture
def folder(tmp_path):
    return two_passes(write_hills(tmp_path / "alps"))


def test_photos_are_accepted_where_all_agree_and_else_wait(folder, capsys):
    assert run("consensus", folder) == 0
    out = capsys.readouterr().out
    assert "Accepted, since all agree within 2 px: 1" in out
    assert "hill-1.png: ann and bob differ by up to 20 px in columns 0 to 69" in out
    assert "Not in it, since fewer than two passes have decided them: 1" in out
    found = labels_by_name(folder)
    assert {name: one.status for name, one in found.items()} == {
        "hill-0.png": "accepted",
        "hill-1.png": "needs review",
    }
    assert set(found["hill-0.png"].skyline.rows) == {11}
    assert str(found["hill-1.png"].comment).startswith("consensus: ann and bob differ")
    assert found["hill-0.png"].comment is None


def test_within_says_what_agrees(folder, capsys):
    assert run("consensus", folder, "--within", "0.5") == 0
    assert "Needs review, since they do not agree: 2" in capsys.readouterr().out
    assert run("consensus", folder, "--within", "20") == 0
    assert "Accepted, since all agree within 20 px: 2" in capsys.readouterr().out


def test_again_nothing_is_written_that_is_there(folder, capsys):
    run("consensus", folder)
    before = {name: one.operations for name, one in labels_by_name(folder).items()}
    assert run("consensus", folder) == 0
    assert "somebody has decided or worked on them: 1" in capsys.readouterr().out
    assert {name: one.operations for name, one in labels_by_name(folder).items()} == before


def test_an_export_takes_the_consensus_where_there_is_one(folder, tmp_path, capsys):
    assert run("export", folder, "--out", tmp_path / "none") == 2
    assert "which pass? There are ann 1, bob 1" in capsys.readouterr().err
    run("consensus", folder)
    for number, words in enumerate(([], ["--annotator", "consensus"])):
        out = tmp_path / f"out-{number}"
        assert run("export", folder, "--out", out, *words) == 0
        assert [file.name for file in out.iterdir()] == ["hill-0.csv"]
        assert "0,11,1" in (out / "hill-0.csv").read_text()
    assert run("export", folder, "--out", tmp_path / "bob", "--annotator", "bob") == 0
    assert len(list((tmp_path / "bob").iterdir())) == 2


def test_a_consensus_leaves_as_json_and_comes_back(folder, tmp_path):
    run("consensus", folder)
    out, again = tmp_path / "out", write_hills(tmp_path / "again")
    words = ["--format", "json", "--status", "all", "--annotator", "consensus", "--out", out]
    assert run("export", folder, *words) == 0
    assert run("import", again, out) == 0
    before, after = labels_by_name(folder), labels_by_name(again)
    for name, one in before.items():
        assert after[name].skyline == one.skyline
        assert after[name].comment == one.comment
        assert after[name].origin.tolist() == one.origin.tolist()
    assert run("consensus", label(again, "ann", row=5)) == 2  # one pass alone
