"""A detector is one file: bank, settings and name come back, whatever wrote it."""

import json
import zipfile
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given

import skyline_viz as sv
from skyline_viz.filter_bank import Provenance
from skyline_viz.rendering import render
from skyline_viz.system import headed_npz
from testing.examples import examples
from testing.methods import configurations, write_bank

SCENE = render("desert", 3, 120, 90)
STEEP = sv.DetectorConfig.paper().with_settings({"delta": 4, "link_weight": 0.1})


@pytest.mark.parametrize("config", [sv.DetectorConfig(), sv.DetectorConfig.paper(), STEEP])
@pytest.mark.parametrize("label", ["", "steep", "Steile Wände, 2"])
def test_a_detector_comes_back_as_it_was(config, label, tmp_path):
    detector = sv.Detector(config=config, label=label)
    detector.save(tmp_path / "d.npz")
    again = sv.Detector.load(tmp_path / "d.npz")
    assert (again.config, again.label, again.name) == (config, label, detector.name)
    for name, array in detector.arrays().items():
        np.testing.assert_array_equal(again.arrays()[name], array)
    assert again.bank.provenance == detector.bank.provenance
    found, wanted = again.detect(SCENE.photo), detector.detect(SCENE.photo)
    np.testing.assert_array_equal(found.cost, wanted.cost)
    np.testing.assert_array_equal(found.skyline.rows, wanted.skyline.rows)


def test_the_same_detector_gives_the_same_bytes(tmp_path):
    for name in ("a.npz", "b.npz"):
        sv.Detector(config=STEEP).save(tmp_path / name)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_a_bank_is_read_out_of_a_detector(tmp_path):
    sv.Detector(config=STEEP).save(tmp_path / "d.npz")
    bank = sv.FilterBank.load(tmp_path / "d.npz")
    np.testing.assert_array_equal(bank.filters, sv.FilterBank.default().filters)


@examples(50)
@given(configurations)
def test_any_configuration_comes_back(config):
    detector = sv.Detector(config=config)
    with headed_npz.opened(headed_npz.packed(detector.header(), detector.arrays())) as file:
        assert sv.Detector.read(file, b"").config == config


def test_a_bank_brings_the_settings_that_it_was_trained_for(tmp_path):
    training = sv.TrainingConfig(detector=STEEP)
    bank = sv.train([(SCENE.photo, SCENE.truth)], config=training)
    bank.save(tmp_path / "b.npz")
    assert sv.Detector.load(tmp_path / "b.npz").config == STEEP


def test_an_earlier_bank_brings_what_it_knows(tmp_path):
    for edges in ("grey", "colour"):
        bank = replace(sv.FilterBank.default(), provenance=Provenance("hills", edges=edges))
        path = write_bank(bank, tmp_path / "b.npz")
        assert sv.Detector.load(path).config == sv.DetectorConfig(edge_source=edges)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"settings": {"delta": -1}}, "delta is a whole number from 0 to 100000, not -1"),
        ({"settings": {"slope": 1}}, "its settings are none of a detector"),
        ({"settings": None}, "its header names no detector"),
        ({"label": 3}, "its header names no detector"),
        ({"method": "edges"}, "its header names no detector"),
        ({"version": 3}, "of version 3; this program reads version 2"),
    ],
    ids=repr,
)
def test_other_headers_are_one_sentence(changes, says, tmp_path):
    path = tmp_path / "d.npz"
    detector = sv.Detector()
    path.write_bytes(headed_npz.packed({**detector.header(), **changes}, detector.arrays()))
    with pytest.raises(sv.FilterBankError, match=says) as caught:
        sv.Detector.load(path)
    assert str(caught.value).startswith(str(path))


def test_a_model_that_is_not_known_is_not_left_out_in_silence(tmp_path):
    path, detector = tmp_path / "d.npz", sv.Detector()
    arrays = {**detector.arrays(), "sky__weights": np.zeros(3, np.float32)}
    path.write_bytes(headed_npz.packed(detector.header(), arrays))
    with pytest.raises(sv.FilterBankError, match="holds sky__weights, which this version"):
        sv.Detector.load(path)
    assert len(sv.FilterBank.load(path).filters)  # the bank in it is one all the same


def test_the_header_says_what_the_file_is(tmp_path):
    sv.Detector(config=STEEP, label="steep").save(tmp_path / "d.npz")
    with zipfile.ZipFile(tmp_path / "d.npz") as archive:
        assert set(archive.namelist()) == {
            "header.npy",
            "filters.npy",
            "samples.npy",
            "sky__network.npy",
        }
    with np.load(tmp_path / "d.npz") as archive:
        header = json.loads(archive["header"].tobytes())
    assert (header["format"], header["version"]) == ("skyline-viz", 2)
    assert (header["method"], header["label"]) == ("filters", "steep")
    assert header["settings"]["delta"] == 4
    assert header["sky"] == "small"
