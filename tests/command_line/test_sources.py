"""Photos as people name them: patterns, lists, folders with and without photos."""

import io
import os
import sys
from pathlib import Path

import pytest

from skyline_viz.command_line.inputs import collect
from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.sources import Missing, named
from skyline_viz.datasets.dataset import DatasetError
from testing.datasets import put


@pytest.fixture
def album(tmp_path, monkeypatch):
    """Four photos in folders, one under an odd name."""
    for name in ("top.png", "day1/a.png", "day1/far/b.png", "day2/a[1].png"):
        put(tmp_path / name)
    (tmp_path / "empty").mkdir()
    monkeypatch.chdir(tmp_path)


def said(*words):
    return [one if isinstance(one, Missing) else os.fspath(one) for one in named(map(Path, words))]


def test_patterns_in_quotes(album):
    assert said("day1/*.png", "top.png") == ["day1/a.png", "top.png"]
    assert said("**/b.png") == ["day1/far/b.png"]
    assert said("day?") == ["day1", "day2"]
    (missing,) = said("*.gif")
    assert missing.reason == "*.gif matches no file."


def test_a_pattern_does_not_follow_a_circle_of_links(album):
    Path("day1/back").symlink_to("..")
    Path("day1/c.png").symlink_to("a.png")
    assert said("**/*.png") == [
        "day1/a.png",
        "day1/c.png",
        "day1/far/b.png",
        "day2/a[1].png",
        "top.png",
    ]


def test_a_file_with_the_signs_of_a_pattern_is_itself(album):
    assert said("day2/a[1].png") == ["day2/a[1].png"]
    Path("@list.png").touch()
    assert said("@list.png") == ["@list.png"]


@pytest.mark.parametrize("between", [b"\n", b"\r\n", b"\0"])
@pytest.mark.parametrize("piped", [False, True])
def test_lists(album, monkeypatch, between, piped):
    data = between.join([b"top.png", b"", b"day1/far", b"day2/*", b""])
    Path("list.txt").write_bytes(data)
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))
    assert said("@-" if piped else "@list.txt") == ["top.png", "day1/far", "day2/a[1].png"]


@pytest.mark.parametrize(
    ("word", "reason"),
    [("@gone", "the list gone cannot be read: no such"), ("@none", "the list none names no photo")],
)
def test_lists_that_are_none(album, word, reason):
    Path("none").write_text("\n \n")
    with pytest.raises(UsageError, match=reason):
        said(word)


def test_a_folder_without_photos_fails_as_a_photo_does(album):
    found = collect([Path("empty"), Path("day1"), Path("*.gif")])
    assert [one.name for one in found] == ["empty", "a", "b", "*"]
    with pytest.raises(DatasetError, match=r"^empty holds no photograph\.$"):
        found[0].item.photo()
    with pytest.raises(DatasetError, match=r"^empty holds no photograph\. \*\.gif matches no"):
        collect([Path("empty"), Path("*.gif")])


def test_each_path_once_and_each_link_under_its_name(album):
    Path("link.png").symlink_to("top.png")
    found = collect([Path("top.png"), Path(), Path("link.png"), Path("day1/../top.png")])
    assert sorted(one.name for one in found) == ["a", "a[1]", "b", "link", "top"]


def test_what_is_skipped_is_said_at_the_end_of_the_command(say, album):
    Path("day1/x.nef").touch()
    for number in range(7):
        put(Path("day1/masks") / f"{number}.png")
    status, _, err = say("detect", "empty", "day1", "--out", "out")
    assert status == 1
    told = err.splitlines()
    assert "day1: 7 truths have no photo: masks/0.png, " in told[0]
    assert told[-2] == "skyline-viz: empty holds no photograph."
    assert "1 file is no photo that can be read: x.nef" in told[-1]
