"""Files appear whole or not at all."""

import errno
import os
import stat
from pathlib import Path

import pytest

from skyline_viz.files import move_folder, read_at_most, replacing, write_text


def test_the_file_appears_only_at_the_end(tmp_path):
    target = tmp_path / "a.txt"
    with replacing(target) as temporary:
        temporary.write_text("new")
        assert not target.exists()
        assert temporary.parent == tmp_path
    assert [file.name for file in tmp_path.iterdir()] == ["a.txt"]
    assert target.read_text() == "new"


def test_the_temporary_file_is_hidden_and_keeps_the_suffix(tmp_path):
    with replacing(tmp_path / "a.tar.gz") as temporary:
        assert temporary.name.startswith(".")
        assert temporary.suffix == ".gz"


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
def test_a_failure_leaves_what_was_there(tmp_path, error):
    target = tmp_path / "a.txt"
    target.write_text("old")

    def write():
        with replacing(target) as temporary:
            temporary.write_text("half")
            raise error

    with pytest.raises(error):
        write()
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_failure_leaves_nothing_where_nothing_was(tmp_path):
    def write():
        with replacing(tmp_path / "a.txt"):
            raise ValueError

    with pytest.raises(ValueError):
        write()
    assert list(tmp_path.iterdir()) == []


def test_a_folder_in_the_way_is_an_error_and_stays(tmp_path):
    (tmp_path / "a.txt").mkdir()
    with pytest.raises(OSError):
        write_text(tmp_path / "a.txt", "new")
    assert [file.name for file in tmp_path.iterdir()] == ["a.txt"]
    assert (tmp_path / "a.txt").is_dir()


def test_missing_folders_are_made(tmp_path):
    write_text(tmp_path / "a" / "b" / "c.txt", "deep")
    assert (tmp_path / "a" / "b" / "c.txt").read_text() == "deep"


def test_two_writers_do_not_share_a_temporary_file(tmp_path):
    with replacing(tmp_path / "a.txt") as first, replacing(tmp_path / "a.txt") as second:
        assert first != second
        first.write_text("first")
        second.write_text("second")
    assert (tmp_path / "a.txt").read_text() == "first"  # the outer block ends last


@pytest.mark.skipif(os.name != "posix", reason="needs Unix permissions")
def test_permissions_are_those_of_an_ordinary_file(tmp_path):
    write_text(tmp_path / "ours", "")
    (tmp_path / "plain").touch()
    modes = [stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("ours", "plain")]
    assert modes[0] == modes[1]


def test_text_is_utf8_with_unix_line_ends(tmp_path):
    write_text(tmp_path / "a.txt", "Piz Palü\n3900 m\n")
    assert (tmp_path / "a.txt").read_bytes() == "Piz Palü\n3900 m\n".encode()


# What is said to be on the disk is on it


@pytest.fixture
def steps(monkeypatch, tmp_path):
    """What reaches the disk, in its order: names of files and folders, and moves."""
    said = []
    fsync, replace, rename = os.fsync, Path.replace, Path.rename

    def recorded_fsync(number):
        said.append(("fsync", Path(f"/proc/self/fd/{number}").readlink().name))
        fsync(number)

    def recorded(move):
        def moved(self, target):
            said.append(("move", Path(target).name))
            return move(self, target)

        return moved

    monkeypatch.setattr(os, "fsync", recorded_fsync)
    monkeypatch.setattr(Path, "replace", recorded(replace))
    monkeypatch.setattr(Path, "rename", recorded(rename))
    return said


needs_proc = pytest.mark.skipif(
    not Path("/proc/self/fd").is_dir(), reason="needs to know the name of an open file"
)


@needs_proc
def test_the_content_is_on_the_disk_before_the_name_and_the_name_before_it_is_said(tmp_path, steps):
    with replacing(tmp_path / "a.txt") as temporary:
        temporary.write_text("new")
    assert steps == [("fsync", temporary.name), ("move", "a.txt"), ("fsync", tmp_path.name)]


@needs_proc
def test_folders_that_are_made_are_on_the_disk_too(tmp_path, steps):
    write_text(tmp_path / "one" / "two" / "a.txt", "deep")
    assert steps[:2] == [("fsync", tmp_path.name), ("fsync", "one")]
    assert steps[-2:] == [("move", "a.txt"), ("fsync", "two")]


@needs_proc
def test_a_folder_that_appears_by_a_move_is_on_the_disk_with_all_that_is_in_it(tmp_path, steps):
    whole = tmp_path / "whole"
    (whole / "part").mkdir(parents=True)
    (whole / "part" / "a.txt").write_text("a")
    (whole / "b.txt").write_text("b")
    move_folder(whole, tmp_path / "out")
    before, moved, after = steps[:-2], steps[-2], steps[-1]
    assert {name for _, name in before} == {"a.txt", "b.txt", "part", "whole"}
    assert (moved, after) == (("move", "out"), ("fsync", tmp_path.name))


def test_a_disk_that_fails_to_keep_a_file_is_an_error_and_what_was_there_stays(
    tmp_path, monkeypatch
):
    write_text(tmp_path / "a.txt", "old")

    def broken(_):
        raise OSError(errno.EIO, "input/output error")

    monkeypatch.setattr(os, "fsync", broken)
    with pytest.raises(OSError, match="input/output"):
        write_text(tmp_path / "a.txt", "new")
    assert [(file.name, file.read_text()) for file in tmp_path.iterdir()] == [("a.txt", "old")]


def test_folders_that_cannot_be_flushed_are_no_error(tmp_path, monkeypatch):
    fsync = os.fsync

    def files_only(number):
        if stat.S_ISDIR(os.fstat(number).st_mode):
            raise OSError(errno.EINVAL, "invalid argument")
        fsync(number)

    monkeypatch.setattr(os, "fsync", files_only)
    write_text(tmp_path / "a.txt", "new")
    assert (tmp_path / "a.txt").read_text() == "new"


# Reading what may be anything


def test_only_files_of_a_bearable_size_are_read(tmp_path):
    path = tmp_path / "a.txt"
    path.write_bytes(b"12345")
    assert read_at_most(path, 5) == b"12345"
    with pytest.raises(OSError, match="it has 5 bytes, and the limit is 4"):
        read_at_most(path, 4)
    with pytest.raises(FileNotFoundError):
        read_at_most(tmp_path / "b.txt", 4)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs pipes and devices")
def test_a_pipe_or_a_device_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "zero").symlink_to("/dev/zero")
    for name in ("pipe", "zero"):
        with pytest.raises(OSError, match="a pipe or a device"):
            read_at_most(tmp_path / name, 100)
