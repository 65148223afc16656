"""How far two passes agree."""

import numpy as np
import pytest

from annotate.agreement import paired
from annotate.store.store import Store
from skyline_viz.skyline import Skyline
from testing.labelling import write_hills
from testing.labels import label


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


def test_only_columns_that_both_see_are_compared(folder):
    label(folder, "ann", row=10)
    label(folder, "bob", row=20)
    store = Store(folder)
    first, second = list(store.labels("ann")), list(store.labels("bob"))
    store.close()
    visible = np.arange(70) < 7
    object.__setattr__(first[0], "skyline", Skyline(rows=first[0].skyline.rows, visible=visible))
    assert [len(pair.differences) for pair in paired(first[:1], second)] == [7]
