"""What proposed, as the store keeps it."""

import json

import numpy as np
import pytest

from annotate.store.kept_detectors import pack, unpack
from skyline_viz.datasets.layouts import DatasetItem
from skyline_viz.methods.registry import make_method, method_digest
from skyline_viz.skyline import Skyline
from testing.labelling import hills, write_hills


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path, count=2)


def test_a_method_that_has_learned_comes_back_as_it_was(folder, tmp_path):
    Skyline(rows=np.full(70, 20.0)).write_csv(tmp_path / "truth.csv")
    item = DatasetItem("hill-0", folder / "hill-0.png", tmp_path / "truth.csv")
    method = make_method("svm-dcsi").fit([item])
    kept = pack(method)
    assert json.loads(kept.config) == {"method": "svm-dcsi"}
    again = unpack(kept.config, kept.bank)
    assert method_digest(again) == kept.digest
    photo = hills(5)
    np.testing.assert_array_equal(
        again.detect(photo).skyline.rows, method.detect(photo).skyline.rows
    )
