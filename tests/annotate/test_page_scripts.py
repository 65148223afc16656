"""The page's JavaScript that needs no browser, under Node."""

import pytest

from testing.programs.node import PAGE, node_tests


@pytest.mark.parametrize(
    "name", sorted(file.name.removesuffix(".test.mjs") for file in PAGE.glob("*.test.mjs"))
)
def test_the_modules_of_the_page(name):
    done = node_tests(name)
    assert done.returncode == 0, done.stdout
