"""``skyline-viz tables``: what it refuses, and what it writes where little is asked for."""

import pytest

from testing.programs.commands import files


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ([], "which data sets? Name at least one folder."),
        (["HILLS", "--folds", "1"], "a cross-validation has 2 folds or more, not 1."),
        (["HILLS", "--seed", "-2"], "a seed is 0 or more, not -2."),
        (["HILLS", "HILLS"], "two data sets are called hills; rename a folder."),
        (["HILLS/images"], "images holds no truth for any"),
        (["HILLS", "--out", "HILLS/images"], "would be taken for the truth"),
    ],
)
def test_what_makes_no_sense_is_one_sentence(say, hills, words, told):
    before = files(hills)
    words = [word.replace("HILLS", str(hills)) for word in words]
    status, out, err = say("tables", *words, "--method", "edges")
    assert (status, out) == (2, "")
    assert told in err
    assert err.count("\n") == 1
    assert files(hills) == before


def test_two_data_sets_are_tables_on_one_page(say, hills, tmp_path):
    other = tmp_path / "other"
    other.symlink_to(hills, target_is_directory=True)
    words = ["--method", "edges", "--no-studies", "--out", "out"]
    status, out, _ = say("tables", hills, other, *words)
    assert status == 0
    assert "\nTable I: " in out
    assert "##" not in out
    assert "published" not in out.partition("Published rows")[0]
    assert "hills" in out
    assert "other" in out
    assert ", published |" in (tmp_path / "out" / "tables.md").read_text()
    assert (tmp_path / "out" / "tables.tex").is_file()
    assert {path.parent.name for path in (tmp_path / "out").rglob("photos.csv")} == {
        "hills",
        "other",
    }
