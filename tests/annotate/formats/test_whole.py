"""``labels.json``: labels with everything that is known about them."""

from dataclasses import replace

import numpy as np
import pytest

from annotate.engine.hidden import Hidden
from annotate.store.labels import TAGS
from testing.exports import label, put, there_and_back


@pytest.fixture
def photos(tmp_path):
    put(tmp_path / "photos", "a.png")
    return tmp_path / "photos"


def test_json_carries_everything(tmp_path, photos):
    hidden = (Hidden(0, 2, "fog"), Hidden(3, 5))
    given_label = replace(label(photos, "a.png", tags=TAGS), hidden=hidden)
    _, (found,) = there_and_back(tmp_path, photos, "json", [given_label])
    before, after = dict(vars(given_label)), dict(vars(found.label))
    np.testing.assert_array_equal(before.pop("origin"), after.pop("origin"))
    assert before == after
