"""``skyline-viz gallery`` on the command line, without a viewer: causes, and flags."""

import json

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.cli import main
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.datasets.named_item import NamedItem
from skyline_viz.gallery.flags import Change, Flag, change_flags, read_flags
from skyline_viz.gallery.store import Gallery
from testing.programs.commands import write_flat


@pytest.fixture
def hills(tmp_path):
    return write_flat(tmp_path / "hills", 5)


def test_a_cause_that_there_is_not(say, hills, tmp_path):
    words = ["gallery", hills, "--out", "g", "--screenshot", "a.png", "--cause"]
    status, out, err = say(*words, "fog")
    assert (status, out) == (2, "")
    assert "--cause cannot be fog; it is one of truth doubtful, " in err
    assert not (tmp_path / "g").exists()
    status, _, err = say(*words, "starved bin")
    assert status == 1
    assert err == "skyline-viz: none of 5 photos with a truth has the cause starved bin.\n"
    assert not (tmp_path / "a.png").exists()
    assert len(json.loads((tmp_path / "g" / "gallery.json").read_text())["photos"]) == 5


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    folder = tmp_path_factory.mktemp("gallery")
    photo = np.full((60, 70, 3), 200, np.uint8)
    photo[30:] = 60
    for name in "abc":
        sv.write_photo(folder / f"{name}.png", photo)
    photos = [NamedItem(name, DatasetItem(name, folder / f"{name}.png")) for name in "abc"]
    list(Gallery(folder / "g").build(photos, sv.Detector(), workers=1))
    return folder / "g"


@pytest.fixture
def gallery(built):
    (built / "flags.json").unlink(missing_ok=True)
    return built


def run(gallery, *words):
    return main(["gallery", "--out", str(gallery), *map(str, words)])


def test_several_photos_are_flagged_and_commented_at_once(gallery, capsys):
    assert run(gallery, "--flag", "a", gallery.parent / "c.png", "--comment", "faint ridge") == 0
    assert capsys.readouterr().out == "a\t1\tfaint ridge\nc\t1\tfaint ridge\n"
    assert read_flags(gallery) == dict.fromkeys("ac", Flag(True, "faint ridge"))


def test_flags_and_comments_are_taken_back(gallery, capsys):
    change_flags(gallery, dict.fromkeys("abc", Change(True, "x")))
    assert run(gallery, "--unflag", "a.png") == 0
    assert run(gallery, "--flag", "b", "--unflag", "c", "--comment", "") == 0
    assert capsys.readouterr().out == "a\t0\tx\nb\t1\t\nc\t0\t\n"
    assert read_flags(gallery) == {"a": Flag(comment="x"), "b": Flag(True)}


def test_flags_are_listed_a_line_a_photo(tmp_path, capsys):
    change_flags(tmp_path, {"b": Change(True, "two\nlines"), "a": Change(False, "ä ridge")})
    assert run(tmp_path, "--list-flags") == 0
    assert capsys.readouterr().out == "a\t0\tä ridge\nb\t1\ttwo lines\n"


def test_all_can_be_listed_after_a_change(gallery, capsys):
    change_flags(gallery, {"c": Change(True)})
    assert run(gallery, "--flag", "a", "--list-flags") == 0
    assert capsys.readouterr().out == "a\t1\t\nc\t1\t\n"


def test_a_photo_that_left_the_data_set_keeps_its_flag_and_can_lose_it(gallery):
    change_flags(gallery, {"gone": Change(True, "x")})
    assert run(gallery, "--unflag", "gone", "--comment", "") == 0
    assert read_flags(gallery) == {}


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--flag", "a", "nope"], "no photo of the gallery is called nope."),
        (["--flag", "a", "--unflag", "a.png"], "a cannot be both flagged and not."),
        (["--comment", "x"], "on which photos? Name them with --flag or --unflag."),
        (["--flag", "a", "--comment", "x" * 2001], "a comment has at most 2000 characters."),
    ],
)
def test_what_cannot_be_done_is_one_sentence_and_nothing_is_changed(gallery, words, says, capsys):
    assert run(gallery, *words) == 2
    assert capsys.readouterr().err == f"skyline-viz: {says}\n"
    assert read_flags(gallery) == {}


@pytest.mark.parametrize("words", [["--list-flags"], ["--flag", "a"]])
def test_a_folder_that_is_none_is_named(tmp_path, words, capsys):
    assert run(tmp_path / "none", *words) == 2
    assert "is no gallery; --out names its folder" in capsys.readouterr().err
    assert not (tmp_path / "none").exists()


def test_a_gallery_of_an_earlier_version_is_brought_up_to_date_first(gallery, tmp_path, capsys):
    document = json.loads((gallery / "gallery.json").read_text())
    (tmp_path / "gallery.json").write_text(json.dumps(document | {"version": 1}))
    assert run(tmp_path, "--flag", "a") == 2
    assert "bring it up to date first" in capsys.readouterr().err
