"""Nothing is left behind by a program that ends by itself; `test_endings` kills real ones."""

import os
import select
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

import pytest

from skyline_viz.system import aftermath
from skyline_viz.system.aftermath import (
    ended,
    passing,
    passing_folder,
    passing_temporaries,
    started,
)


@pytest.fixture
def told(monkeypatch):
    """What the janitor is told."""
    lines = []
    monkeypatch.setattr(
        aftermath._WATCH, "tell", lambda sign, what: lines.append((sign, str(what))) is None
    )
    return lines


def test_a_path_is_told_for_as_long_as_the_block_lasts(told, tmp_path):
    with pytest.raises(RuntimeError), passing(tmp_path / "part"):
        assert told == [("+", str(tmp_path / "part"))]
        raise RuntimeError
    assert told[1:] == [("-", str(tmp_path / "part"))]


def test_a_relative_path_is_told_in_full(told, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with passing("part"):
        monkeypatch.chdir("/")
    assert {path for _, path in told} == {str(tmp_path / "part")}


def test_a_passing_folder_goes_with_all_that_is_in_it(told, tmp_path):
    with passing_folder("x-", tmp_path) as folder:
        assert folder.parent == tmp_path
        assert folder.name.startswith("x-")
        (folder / "file").touch()
    assert not folder.exists()
    assert told == [("+", str(folder)), ("-", str(folder))]


def test_temporary_files_of_libraries_go_into_a_folder_of_their_own(told, monkeypatch):
    monkeypatch.setenv("TMPDIR", "/somewhere")
    monkeypatch.delenv("TEMP", raising=False)
    with passing_temporaries() as folder:
        assert os.environ["TMPDIR"] == os.environ["TEMP"] == str(folder)
    assert os.environ["TMPDIR"] == "/somewhere"
    assert "TEMP" not in os.environ
    assert not folder.exists()


def test_a_process_has_a_folder_for_its_temporary_files_which_goes_with_it(told, tmp_path):
    program = (
        "import pathlib, sys, tempfile; pathlib.Path(tempfile.mkdtemp(), 'file').touch();"
        "print(tempfile.gettempdir(), flush=True); sys.stdin.read()"
    )
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    process = started([sys.executable, "-c", program], **pipes)
    folder = Path(process.stdout.readline().decode().strip())
    assert folder != Path(tempfile.gettempdir())
    assert list(folder.glob("*/file"))
    ended(process)
    process.communicate()
    assert process.returncode is not None
    assert not folder.exists()
    number = str(process.pid)
    assert told == [("+", str(folder)), ("*", number), ("/", number), ("-", str(folder))]


def test_a_program_that_cannot_be_started_leaves_no_folder(told):
    with pytest.raises(OSError, match="no-such-program"):
        started(["/no-such-program"])
    (sign, folder), last = told
    assert (sign, last) == ("+", ("-", folder))
    assert not Path(folder).exists()


@pytest.mark.skipif(os.name != "posix", reason="there is no janitor elsewhere")
def test_what_a_killed_program_left_is_removed(tmp_path):
    program = (
        "import os, pathlib, signal, sys; from skyline_viz.system.aftermath import passing_folder;"
        "around = passing_folder(parent=sys.argv[1]); folder = around.__enter__();"
        "(folder / 'file').touch();"
        "from skyline_viz.system.aftermath import _WATCH; print(_WATCH.process.pid, flush=True);"
        "os.kill(os.getpid(), signal.SIGKILL)"
    )
    words = [sys.executable, "-c", program, tmp_path]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == -9
    with suppress(ProcessLookupError):  # it is done already
        janitor = os.pidfd_open(int(done.stdout))
        assert select.select([janitor], [], [], 60)[0]
        os.close(janitor)
    assert list(tmp_path.iterdir()) == []
