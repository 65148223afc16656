"""What an import came to: labels, what was wrong, and what is worth knowing."""

import numpy as np
import pytest

from annotate.formats.common import Imported
from annotate.formats.importing import Found, Imports, Task
from annotate.formats.photo_names import PhotoNames
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.skyline import Skyline, SkylineError
from testing.exports import WIDTH, put


def test_labels_are_asked_for_in_every_way():
    labels = tuple(Imported(name, Skyline([1])) for name in "ab")
    imports = Imports(labels, ("a.",), ())
    assert (len(imports), tuple(imports), imports[1]) == (2, labels, labels[1])


def test_a_problem_is_said_once_and_notes_of_one_kind_together():
    found = Found()
    for sentence in ("x is damaged.", "y is damaged.", "x is damaged."):
        found.problem(sentence)
    for name in ("a", "b", "a"):
        found.note("left out", name)
    found.note("nothing else was there")
    outcome = found.outcome()
    assert outcome.problems == ("x is damaged.", "y is damaged.")
    assert outcome.notes == ("left out: a, b.", "nothing else was there.")


@pytest.fixture
def task(tmp_path):
    """Files for photos a and b."""
    for name in ("a.png", "b.png"):
        put(tmp_path / "photos", name)
    names = ("a.png", "b.png")
    return Task(tmp_path, (), tmp_path / "photos", names, PhotoNames(names), Found())


def level(row):
    return Skyline(np.full(WIDTH, row))


def test_each_photo_gets_the_file_of_its_name(task, tmp_path):
    read = {"a": level(3), "b": level(5)}
    task.read_each([tmp_path / "a.csv", tmp_path / "b.csv"], lambda file, photo: read[file.stem])
    assert {one.name: one.skyline for one in task.found.labels} == {
        "a.png": level(3),
        "b.png": level(5),
    }


def test_a_file_that_cannot_be_read_loses_no_other(task, tmp_path):
    def read(file, photo):
        if file.stem == "a":
            raise SkylineError(f"{file} is damaged.")
        return level(5)

    task.read_each([tmp_path / "a.csv", tmp_path / "b.csv"], read)
    assert [one.name for one in task.found.labels] == ["b.png"]
    assert task.found.problems == [f"{tmp_path / 'a.csv'} is damaged."]


def test_files_that_contradict_each_other_give_nothing(task, tmp_path):
    files = [tmp_path / "x" / "a.csv", tmp_path / "y" / "a.csv"]
    task.read_each(files, lambda file, photo: level(3 if file.parent.name == "x" else 9))
    assert task.found.labels == []
    assert "a.png has two files that differ by up to 6 px" in task.found.problems[0]


def test_a_line_of_another_width_is_a_problem(task, tmp_path):
    task.read_each([tmp_path / "a.csv"], lambda file, photo: Skyline([1, 2]))
    assert task.found.problems == [f"a.png has {WIDTH} columns, its label 2."]
    assert issubclass(FormatError, ValueError)
