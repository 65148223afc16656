"""Options that several commands share: who, which folder, which pass."""

import getpass

import pytest

from annotate.commands.options import check_folder, chosen_pass, locked, opened, whoever
from annotate.store.database import StoreError
from annotate.store.store import Store
from skyline_viz.command_line.messages import UsageError
from testing.labelling import write_hills
from testing.labels import label


@pytest.fixture
def labelled(tmp_path):
    folder = write_hills(tmp_path / "alps", count=1)
    for who, number in (("ann", 1), ("ann", 2), ("bob", 1)):
        label(folder, who, number, row=9, photos=1)
    return folder


def test_an_annotator_is_who_is_named_or_runs_the_command(monkeypatch):
    assert whoever(" eve ") == "eve"
    monkeypatch.setattr(getpass, "getuser", lambda: "root")
    assert whoever("  ") == "root"
    with pytest.raises(UsageError, match="plain text without slashes"):
        whoever("a/b")

    def nobody():
        raise KeyError("uid")

    monkeypatch.setattr(getpass, "getuser", nobody)
    with pytest.raises(UsageError, match="who are you"):
        whoever("")


def test_what_is_no_folder_is_a_sentence(tmp_path):
    assert check_folder(tmp_path) == tmp_path
    (tmp_path / "file").touch()
    with pytest.raises(UsageError, match="file is a file, not a folder"):
        check_folder(tmp_path / "file")
    with pytest.raises(UsageError, match="gone does not exist"):
        check_folder(tmp_path / "gone")


def test_a_folder_is_open_once_at_a_time(tmp_path):
    with locked(tmp_path), pytest.raises(UsageError, match="is open in another"), locked(tmp_path):
        raise AssertionError
    with locked(tmp_path):
        pass
    (tmp_path / "file").touch()
    with (
        pytest.raises(StoreError, match="cannot be written, and labels are kept in it"),
        locked(tmp_path / "file"),
    ):
        raise AssertionError


def test_labels_that_are_there_are_read_and_none_are_made(tmp_path, labelled):
    with opened(labelled) as store:
        assert len(list(store.labels())) == 3
    with pytest.raises(UsageError, match="has no labels yet; make some"), opened(tmp_path):
        raise AssertionError
    assert not [one for one in tmp_path.iterdir() if one.is_file()]


def test_a_pass_is_the_one_that_is_named_or_the_only_one(labelled):
    store = Store(labelled, reading=True)
    assert chosen_pass(store, "bob", 0) == ("bob", 1)
    assert chosen_pass(store, "", 2) == ("ann", 2)
    with pytest.raises(UsageError, match=r"which pass\? There are ann 1, ann 2;"):
        chosen_pass(store, "ann", 0)
    with pytest.raises(UsageError, match="no such pass; there are ann 1, ann 2, bob 1"):
        chosen_pass(store, "eve", 0)
    store.close()
