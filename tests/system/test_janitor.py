"""The small process that cleans up: what it takes note of, and what it removes."""

import os
import subprocess
import sys

import pytest

from skyline_viz.system.janitor import Janitor, handle_of

pytestmark = pytest.mark.skipif(os.name != "posix", reason="there is none elsewhere")


@pytest.fixture
def pipe():
    told, tell = os.pipe()
    os.set_blocking(told, False)
    yield told, tell
    for end in (told, tell):
        try:
            os.close(end)
        except OSError:
            continue


def test_lines_are_taken_in_as_they_come_in_pieces(pipe):
    janitor = Janitor(pipe[0])
    os.write(pipe[1], b"+/a\0+/b\0-/a")
    assert janitor.listen()
    assert list(janitor.paths) == [b"/a", b"/b"]
    os.write(pipe[1], b"\0")
    assert janitor.listen()
    assert list(janitor.paths) == [b"/b"]
    assert not janitor.listen()  # nothing more yet
    os.close(pipe[1])
    assert not janitor.listen()  # nothing more ever


def test_what_is_left_is_removed_and_nothing_else(pipe, tmp_path):
    kept, left, folder, elsewhere = (tmp_path / name for name in ("kept", "left", "dir", "real"))
    kept.write_text("mine")
    left.write_text("a part of a file")
    folder.mkdir()
    (folder / "inside").touch()
    elsewhere.mkdir()
    (tmp_path / "link").symlink_to(elsewhere, target_is_directory=True)
    janitor = Janitor(pipe[0])
    for sign, path in ((b"+", kept), (b"+", left), (b"+", folder), (b"-", kept)):
        janitor.take(sign, os.fsencode(path))
    janitor.take(b"+", os.fsencode(tmp_path / "link"))
    janitor.take(b"+", os.fsencode(tmp_path / "never"))
    janitor.clean()
    assert sorted(one.name for one in tmp_path.iterdir()) == ["kept", "real"]


def test_a_process_that_is_left_is_killed_and_one_that_ended_is_not(pipe):
    words = [sys.executable, "-c", "import sys; sys.stdin.read()"]
    left, done = (subprocess.Popen(words, stdin=subprocess.PIPE) for _ in range(2))
    janitor = Janitor(pipe[0])
    for process in (left, done):
        janitor.take(b"*", str(process.pid).encode())
    janitor.take(b"/", str(done.pid).encode())
    janitor.clean()
    left.communicate(timeout=20)
    assert left.returncode == -9
    assert done.poll() is None
    done.communicate(timeout=20)
    assert done.returncode == 0


def test_nothing_stands_for_a_process_that_is_gone():
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait(60)
    assert handle_of(process.pid) is None
