"""A small data set for all tests of the evaluation."""

import pytest

from testing.detections import write_slanting


@pytest.fixture(scope="session")
def items(tmp_path_factory):
    return write_slanting(tmp_path_factory.mktemp("evaluation") / "hills")
