"""A detection that is wrong, and one that is right."""

import pytest

from testing import detections


@pytest.fixture(scope="session")
def hazy():
    return detections.hazy()


@pytest.fixture(scope="session")
def flat():
    return detections.flat()
