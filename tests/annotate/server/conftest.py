"""A server over three small photos, which tests share, or have to themselves."""

import pytest

from testing.labelling import served, write_hills


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return write_hills(tmp_path_factory.mktemp("photos"))


@pytest.fixture(scope="module")
def client(folder):
    with served(folder) as client:
        yield client


@pytest.fixture
def fresh(tmp_path):
    with served(write_hills(tmp_path / "photos")) as client:
        yield client
