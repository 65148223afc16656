"""The process that opens and runs a network once, and may die of it."""

import os
import subprocess
import sys

import cv2
import pytest

from skyline_viz.networks import child
from skyline_viz.networks.child import MEMORY
from testing.deep import needs_deep
from testing.harm import small_network
from testing.networks import bright_sky


def tried(content, memory=8 << 30, shape=(1, 3, 32, 32)):
    words = [sys.executable, "-P", child.__file__, str(memory), "60", "0", *map(str, shape)]
    return subprocess.run(words, input=content, capture_output=True, timeout=300, check=False)


@needs_deep
def test_a_network_that_runs_is_survived_without_a_word():
    done = tried(small_network())
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")


def test_what_opencv_refuses_in_words_is_survived():
    assert tried(b"no network").returncode == 0


@needs_deep
@pytest.mark.skipif(sys.platform != "linux", reason="memory is limited elsewhere in other ways")
def test_one_that_wants_too_much_memory_is_told_from_others():
    assert tried(small_network(), shape=(1, 3, 60_000, 60_000)).returncode == MEMORY


@pytest.mark.skipif(not hasattr(os, "memfd_create"), reason="files are on the disk elsewhere")
@pytest.mark.skipif(not hasattr(cv2.dnn, "ENGINE_CLASSIC"), reason="the only engine reads contents")
def test_the_classic_engine_reads_a_network_that_is_on_no_disk(tmp_path, monkeypatch):
    read = []
    engine = cv2.dnn.readNetFromONNX

    def reading(path, engine_of_it):
        read.append((path, engine_of_it))
        return engine(path, engine_of_it)

    monkeypatch.setattr(child.tempfile, "tempdir", str(tmp_path / "missing"))
    monkeypatch.setattr(cv2.dnn, "readNetFromONNX", reading)
    child.opened(bright_sky(12, 16), classic=True)
    ((path, engine_of_it),) = read
    assert engine_of_it == cv2.dnn.ENGINE_CLASSIC
    assert not os.path.lexists(path)
