"""The process that opens and runs a network once, and may die of it."""

import subprocess
import sys

import pytest

from skyline_viz.networks import child
from skyline_viz.networks.child import MEMORY
from testing.deep import needs_deep
from testing.harm import small_network


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
