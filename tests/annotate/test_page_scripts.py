"""The page's JavaScript that needs no browser, under Node."""

import shutil
import subprocess
from pathlib import Path

TESTS = Path(__file__).parents[1] / "page"


def test_the_queue_of_the_page_and_what_it_stands_on():
    node = shutil.which("node")
    assert node is not None, "Node is missing; tools/setup.sh dev installs it"
    files = sorted(map(str, TESTS.glob("*.test.mjs")))
    done = subprocess.run([node, "--test", *files], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
