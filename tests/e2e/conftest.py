"""One browser for all tests of a module."""

import pytest

from testing.programs.browser import chromium


@pytest.fixture(scope="module")
def browser():
    with chromium() as browser:
        yield browser
