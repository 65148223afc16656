"""What proposed is kept as the content of its file, and what earlier versions kept is read."""

import json
from dataclasses import asdict

import numpy as np
import pytest

import skyline_viz as sv
from annotate.store.kept_detectors import pack, unpack
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.method import MethodError
from skyline_viz.methods.registry import make_method, method_digest
from skyline_viz.skyline import Skyline
from testing.labelling import hills, write_hills
from testing.methods import write_bank, write_method

STEEP = sv.find_method("steep=paper:delta=4")


@pytest.mark.parametrize("spec", ["default", "paper:delta=4", "steep=paper:delta=4", "edges:tog=9"])
def test_a_method_comes_back_as_it_was(spec):
    method = sv.find_method(spec)
    kept = pack(method)
    again = unpack(kept.config, kept.bank)
    assert (again.name, again.settings()) == (method.name, method.settings())
    assert method_digest(again) == kept.digest
    assert json.loads(kept.config) == {"method": method.name}
    assert method.name in kept.about


def test_what_is_kept_is_a_file(tmp_path):
    (tmp_path / "d.npz").write_bytes(pack(STEEP).bank)
    assert sv.Detector.load(tmp_path / "d.npz").name == "steep"
    assert sv.find_method(str(tmp_path / "d.npz")).config == STEEP.config


def test_what_earlier_versions_kept_is_read(tmp_path):
    config = json.dumps(asdict(STEEP.config), sort_keys=True)
    bank = write_bank(STEEP.bank, tmp_path / "bank.npz").read_bytes()
    again = unpack(config, bank)
    assert again.config == STEEP.config
    np.testing.assert_array_equal(again.bank.filters, STEEP.bank.filters)
    edges = sv.find_method("edges:tog=9")
    file = write_method(tmp_path / "method.npz", "edges", edges.settings())
    assert unpack(json.dumps({"method": "edges"}), file.read_bytes()) == edges


def test_what_is_damaged_is_one_sentence():
    kept = pack(sv.find_method("edges"))
    with pytest.raises(MethodError, match="what proposed is damaged"):
        unpack(kept.config, kept.bank[:-40])
    with pytest.raises(MethodError, match="what proposed is damaged"):
        unpack(kept.config, b"")


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
