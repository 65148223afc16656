"""Reviews and comments: nothing that was acknowledged is lost, whoever else writes."""

import json
from concurrent.futures import ThreadPoolExecutor

import pytest
from filelock import FileLock
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.gallery import flags
from skyline_viz.gallery.documents import GalleryError
from skyline_viz.gallery.flags import (
    LONGEST,
    Change,
    Flag,
    OvertakenError,
    change_flags,
    find_names,
    read_flags,
)


def test_a_change_is_about_what_it_names_and_no_more(tmp_path):
    change_flags(tmp_path, {"a": Change(reviewed=True), "b": Change(comment="faint")})
    change_flags(tmp_path, {"a": Change(comment="steep")})
    said = change_flags(tmp_path, {"b": Change(reviewed=True)})
    assert said == {"a": Flag(True, "steep"), "b": Flag(True, "faint")}
    assert read_flags(tmp_path) == said


def test_photos_about_which_nothing_is_said_are_left_out(tmp_path):
    change_flags(tmp_path, {"a": Change(True, "x"), "b": Change(True)})
    assert change_flags(tmp_path, {"a": Change(False, "")}) == {"b": Flag(True)}
    assert [one["name"] for one in json.loads((tmp_path / "flags.json").read_text())["flags"]] == [
        "b"
    ]


def test_a_file_of_today_is_read(tmp_path):
    (tmp_path / "flags.json").write_text(
        '{"version": 1, "flags": [{"name": "a", "reviewed": false, "comment": "ä ridge"},\n'
        '{"name": "b", "reviewed": true, "comment": ""}, {"name": "c", "reviewed": false}]}'
    )
    assert read_flags(tmp_path) == {"a": Flag(False, "ä ridge"), "b": Flag(True), "c": Flag()}


@pytest.mark.parametrize("one", [{"name": 1}, {"comment": 1}, {"colour": "red"}])
def test_a_damaged_file_is_one_sentence_and_is_not_written_over(tmp_path, one):
    text = json.dumps({"version": 1, "flags": [{"name": "a"} | one]})
    (tmp_path / "flags.json").write_text(text)
    with pytest.raises(GalleryError, match=r"flags\.json is damaged"):
        change_flags(tmp_path, {"a": Change(True)})
    assert (tmp_path / "flags.json").read_text() == text


def test_a_comment_that_somebody_else_has_changed_is_not_overwritten(tmp_path):
    change_flags(tmp_path, {"a": Change(comment="first")})
    change_flags(tmp_path, {"a": Change(comment="second", instead_of="first")})
    with pytest.raises(OvertakenError, match="on a was changed elsewhere") as told:
        change_flags(tmp_path, {"b": Change(True), "a": Change(comment="x", instead_of="first")})
    assert told.value.flag == Flag(comment="second")
    assert read_flags(tmp_path) == {"a": Flag(comment="second")}  # all of it or nothing
    change_flags(tmp_path, {"a": Change(comment="second", instead_of="first")})  # sent twice


def test_a_comment_has_a_limit(tmp_path):
    change_flags(tmp_path, {"a": Change(comment="x" * LONGEST)})
    with pytest.raises(GalleryError, match="at most 2000 characters"):
        change_flags(tmp_path, {"a": Change(comment="x" * (LONGEST + 1))})


def test_many_at_once_lose_nothing(tmp_path):
    changes = [{f"p{number}": Change(True, str(number))} for number in range(40)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda change: change_flags(tmp_path, change), changes))
    assert read_flags(tmp_path) == {f"p{number}": Flag(True, str(number)) for number in range(40)}


def test_who_never_gets_a_turn_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr(flags, "_PATIENCE", 0.01)
    with (
        FileLock(tmp_path / ".flags.lock"),
        pytest.raises(GalleryError, match="another program keeps changing"),
    ):
        change_flags(tmp_path, {"a": Change(True)})


def test_nothing_is_written_where_nothing_changes(tmp_path):
    change_flags(tmp_path, {"a": Change(True)})
    before = (tmp_path / "flags.json").stat().st_mtime_ns
    change_flags(tmp_path, {"a": Change(True, "")})
    assert (tmp_path / "flags.json").stat().st_mtime_ns == before


@given(st.dictionaries(st.text(), st.tuples(st.booleans(), st.text(max_size=40)), max_size=5))
def test_whatever_is_said_is_kept(tmp_path_factory, said):
    folder = tmp_path_factory.mktemp("flags")
    change_flags(folder, {name: Change(*one) for name, one in said.items()})
    expected = {name: Flag(*one) for name, one in said.items() if one != (False, "")}
    assert read_flags(folder) == expected


FILES = {"a": "alps/a.jpg", "b": "alps/b.jpg", "x-b": "else/b.jpg", "gone": ""}


def test_photos_are_named_by_name_or_by_file():
    assert find_names(["a", "alps/b.jpg", "./else/b.jpg", "a.jpg", "gone"], FILES) == [
        "a",
        "b",
        "x-b",
        "gone",
    ]


@pytest.mark.parametrize(
    ("word", "says"),
    [
        ("c", "no photo of the gallery is called c."),
        ("", "no photo of the gallery is called ."),
        ("away/a.jpg", "no photo of the gallery is called away/a.jpg."),
        ("b.jpg", "b.jpg could be b or x-b; name one of them."),
    ],
)
def test_who_is_not_understood_is_told(word, says):
    with pytest.raises(GalleryError) as told:
        find_names(["a", word], FILES)
    assert str(told.value) == says
