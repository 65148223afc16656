"""Names of the methods."""

import subprocess
import sys
from typing import get_args

from skyline_viz.methods.names import MethodName


def test_they_differ_and_begin_with_ours():
    names = get_args(MethodName)
    assert names[:2] == ("default", "paper")
    assert len(set(names)) == len(names)


def test_they_are_light_to_import():
    code = (
        "import sys, skyline_viz.methods.names;"
        "print({'numpy', 'cv2', 'torch', 'sklearn'} & set(sys.modules) or 'light')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("light\n", "")
