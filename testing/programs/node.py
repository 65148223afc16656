"""The Node of the locked development set, which runs the tests of the page's JavaScript."""

import os
import subprocess
import sys
from pathlib import Path

from testing import ROOT

PAGE = ROOT / "tests" / "page"
"""Where these tests are."""


def node_tests(name, *options, **environment):
    """Run one file of tests.

    Args:
        name: The file, without its endings.
        options: Options of Node.
        environment: Variables that the tests read.

    Returns:
        The process, which has ended.
    """
    node = Path(sys.executable).with_name("node")
    assert node.exists(), "Node is missing; tools/setup.sh dev installs it"
    return subprocess.run(
        [node, "--test", *options, PAGE / f"{name}.test.mjs"],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
