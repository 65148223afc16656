"""What sets the project up tells that it is alive, and what went wrong."""

import re
import subprocess

import pytest

from testing import ROOT

SETUP = (ROOT / "tools" / "setup.sh").read_text()


def function(name):
    """A function of the script."""
    return re.search(rf"^{name}\(\) .*?(?:^}}$|}}$)", SETUP, re.MULTILINE | re.DOTALL)[0]


@pytest.mark.parametrize("status", [0, 3])
def test_a_long_command_is_watched(tmp_path, status):
    script = f"""
        set -euo pipefail
        {function("say")}
        {function("watched")}
        sleep() {{ touch told; }}
        began() {{ until [ -e told ]; do :; done; echo the end; return {status}; }}
        TELL_EVERY=0 watched began
    """
    done = subprocess.run(
        ["bash", "-c", script], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == status
    assert re.match(r"skyline-viz setup: \d+ s: ", done.stderr)
    assert ("the end\n" in done.stderr.splitlines(keepends=True)) == bool(status)
    assert done.stdout == ""


def test_what_takes_long_is_watched():
    assert len(re.findall(r"watched (?:\S*pip\b|\S*python -m pip|npm) ", SETUP)) == 2
    assert "--quiet" not in SETUP
