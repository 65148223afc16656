"""``skyline-annotate repair``: what it says, and how it ends."""

import pytest

from annotate.commands.options import locked
from testing.labelling import write_hills
from testing.labels import label, poisoned, run


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


def test_what_is_whole_is_said_on_stdout(folder, capsys):
    label(folder)
    assert run("repair", folder) == 0
    said = capsys.readouterr()
    assert said.out == f"All labels in {folder} can be read; nothing was changed.\n"
    assert said.err == ""


def test_what_is_set_aside_is_said_on_stderr(folder, capsys):
    poisoned(folder)
    capsys.readouterr()
    assert run("repair", folder) == 1
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("skyline-annotate: set aside: the label of hill-1.png")


def test_a_folder_that_is_missing_or_open_is_a_sentence(folder, tmp_path, capsys):
    assert run("repair", tmp_path / "gone") == 2
    assert "gone does not exist" in capsys.readouterr().err
    with locked(folder):
        assert run("repair", folder) == 2
    assert "is open in another skyline-annotate" in capsys.readouterr().err
