"""The page's JavaScript that needs no browser, under Node."""

import subprocess
import sys
from pathlib import Path

import pytest

TESTS = sorted((Path(__file__).parents[1] / "page").glob("*.test.mjs"))


@pytest.mark.parametrize("file", TESTS, ids=lambda file: file.name.removesuffix(".test.mjs"))
def test_the_modules_of_the_page(file):
    node = Path(sys.executable).with_name("node")  # of the locked development set
    assert node.exists(), "Node is missing; tools/setup.sh dev installs it"
    done = subprocess.run([node, "--test", file], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
