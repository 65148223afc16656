"""Names of the methods."""

import subprocess
import sys

from skyline_viz.methods.names import NAMES


def test_they_differ_and_begin_with_ours():
    assert NAMES[:2] == ("default", "paper")
    assert len(set(NAMES)) == len(NAMES)


def test_they_are_light_to_import():
    code = (
        "import sys, skyline_viz.methods.names;"
        "print({'numpy', 'cv2', 'torch', 'sklearn'} & set(sys.modules) or 'light')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("light\n", "")
