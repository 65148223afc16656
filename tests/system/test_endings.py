"""However a command ends, it leaves no process and no temporary file; and it says how it ended."""

import signal

import pytest

from testing.programs.ends import CASES, SERVING, ended, write_set

SIGNALS = {signal.SIGTERM: 143, signal.SIGHUP: 129, signal.SIGINT: 130, signal.SIGKILL: -9}
TRIED = [  # every command killed, and what is asked to end in every way
    *((name, signal.SIGKILL) for name in CASES),
    *(("detect", ending) for ending in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT)),
    *((name, signal.SIGTERM) for name in ("evaluate", "gallery", "inspect --save")),
    *(("open", ending) for ending in (signal.SIGTERM, signal.SIGHUP)),
]


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    return write_set(tmp_path_factory.mktemp("data") / "hills", photos=150)


@pytest.mark.parametrize(("name", "ending"), TRIED)
def test_nothing_is_left(name, ending, data, tmp_path):
    left = ended(name, ending, data, tmp_path)
    assert (left.processes, left.files) == ([], [])
    if ending == signal.SIGKILL:
        return
    if name in SERVING:
        assert (left.status, left.said) == (0, "")
    else:
        assert left.status == SIGNALS[ending]
        assert left.said.count("was written is whole") == 1, left.said
        assert left.said.endswith("every file that was written is whole.\n")
