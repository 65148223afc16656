"""Labels of a folder of two photos, which both have been found."""

import pytest

from annotate.store.store import Store
from testing.labelling import write_hills


@pytest.fixture
def store(tmp_path):
    store = Store(write_hills(tmp_path, count=2))
    store.find()
    yield store
    store.close()
