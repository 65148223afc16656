"""Folders of lines on the command line: labels, and what is said of files that are not used."""

import pytest

from skyline_viz.command_line.lines import about_lines, open_lines, status_after_lines
from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.truth_options import Truths
from skyline_viz.datasets import open_dataset
from skyline_viz.evaluation.tasks import NO_LINE
from skyline_viz.running.batch import Failure
from testing.datasets import SKYLINE, put


@pytest.fixture
def items(tmp_path):
    for name in "ab":
        put(tmp_path / "set" / "images" / f"{name}.jpg")
    return list(open_dataset(tmp_path / "set"))


def test_a_label_stands_before_the_folder(tmp_path, items):
    SKYLINE.write_csv(tmp_path / "found" / "a.csv")
    SKYLINE.write_csv(tmp_path / "x=y" / "a.csv")
    folders = [f"{tmp_path / 'found'}", f"mine={tmp_path / 'found'}", f"{tmp_path / 'x=y'}"]
    assert [one.name for one in open_lines(folders, items, Truths())] == ["found", "mine", "x=y"]
    with pytest.raises(UsageError, match=r"called found; give one a label: other="):
        open_lines(folders[:1] * 2, items, Truths())


def test_what_is_not_used_is_said(tmp_path, items, capsys):
    found = tmp_path / "found"
    for name in ("a.csv", "a.json", "zebra.csv"):
        SKYLINE.write_csv(found / name) if name.endswith("v") else SKYLINE.write_json(found / name)
    (one,) = open_lines([f"{found}"], items, Truths())
    told = capsys.readouterr().err
    assert f"{found}: 1 file belongs to no photo: zebra.csv." in told
    assert f"{found}: not used, because another file of the same photo is: a.json." in told
    assert about_lines(one)["belong_to_no_photo"] == ["zebra.csv"]
    assert about_lines(one)["lines"] == 1


def test_photos_without_a_line_are_one_sentence(tmp_path, items, capsys):
    SKYLINE.write_csv(tmp_path / "found" / "a.csv")
    lines = open_lines([f"{tmp_path / 'found'}"], items, Truths())
    assert status_after_lines([], lines, 2) == 0
    assert status_after_lines([Failure("b", f"{NO_LINE} found")], lines, 2) == 1
    assert f"1 of 2 photos has no line in {tmp_path / 'found'}: b." in capsys.readouterr().err
    assert status_after_lines([Failure("a", "it is gone")], lines, 2) == 1
