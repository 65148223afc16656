"""Networks from ONNX files: what the file says goes in and comes out."""

import pickle
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.method import MethodError
from skyline_viz.networks import onnx_files
from skyline_viz.networks.onnx_files import (
    HoldsNetwork,
    Network,
    normalised,
    padded,
    probabilities,
    read_header,
    read_network,
    read_notes,
)
from testing.deep import needs_deep
from testing.harm import small_network
from testing.networks import bright_sky


@needs_deep
def test_inputs_without_the_weights_and_outputs():
    header = read_header(small_network())
    assert [(one.name, one.shape, one.whole) for one in header.inputs] == [
        ("photo", (1, 3, 0, 0), False)
    ]
    assert [one.name for one in header.outputs] == ["sky"]


@needs_deep
@given(st.integers(1, 400), st.integers(0, 255))
def test_a_file_that_was_cut_or_changed_is_a_header_or_an_error(cut, byte):
    content = small_network()
    for harmed in (content[:-cut], content[:cut] + bytes([byte]) + content[cut + 1 :]):
        try:
            read_header(harmed)
        except ValueError:
            continue


def test_a_file_says_things_of_itself():
    assert read_notes(bright_sky(notes={"a": "one", "b": ""})) == {"a": "one", "b": ""}
    assert read_notes(bright_sky()) == {}


@pytest.mark.parametrize("content", [b"", b"hello", b"\x80" * 20, b"\x3a\x7f"])
def test_other_files_are_no_networks(content):
    with pytest.raises(MethodError, match=r"n\.onnx is not an ONNX file\."):
        Network(content, "n.onnx")


def test_a_file_that_cannot_be_read_is_a_sentence(tmp_path, monkeypatch):
    with pytest.raises(MethodError, match="no such file or directory"):
        read_network(tmp_path / "gone.onnx")
    with pytest.raises(MethodError, match="it is no file"):
        read_network(tmp_path)
    (tmp_path / "a.onnx").write_bytes(b"12345")
    assert read_network(tmp_path / "a.onnx") == b"12345"
    monkeypatch.setattr(onnx_files, "MOST_BYTES", 4)
    with pytest.raises(MethodError, match="has 5 bytes, and 4 are the limit"):
        read_network(tmp_path / "a.onnx")


@needs_deep
def test_a_network_runs_and_an_input_that_does_not_fit_is_a_sentence():
    network = Network(small_network(), "n.onnx")
    bright = network.run(np.ones((1, 3, 8, 9), np.float32))
    assert bright.shape == (1, 1, 8, 9)
    assert bright[0, 0, 4, 4] > 0.99
    with pytest.raises(MethodError, match=r"n\.onnx cannot be run: "):
        network.run(np.ones((1, 3, 2, 2, 2, 9), np.float32))
    network._net = SimpleNamespace(setInput=lambda *_: None, forward=lambda _: np.array([np.nan]))
    with pytest.raises(MethodError, match="no finite numbers"):
        network.run(np.ones((1, 3, 8, 9), np.float32))


class Holder(HoldsNetwork):
    """Holds an opened network."""


@needs_deep
def test_an_opened_network_stays_in_its_process_and_that_it_was_tried_is_known(monkeypatch):
    holder = Holder()
    holder._network = Network(small_network(), "n.onnx")
    remembered = []
    monkeypatch.setattr(onnx_files, "remember", remembered.append)
    again = pickle.loads(pickle.dumps(holder))
    assert not hasattr(again, "_network")
    assert remembered == [holder._network.digest]


def test_a_photo_becomes_an_input():
    photo = np.zeros((2, 3, 3), np.uint8)
    photo[0, 1] = (255, 51, 0)
    blob = normalised(photo, (0.5, 0.2, 0.0), (0.5, 0.1, 1.0))
    assert blob.shape == (1, 3, 2, 3)
    np.testing.assert_allclose(blob[0, :, 0, 1], [1, 0, 0], atol=1e-6)
    np.testing.assert_allclose(blob[0, :, 1, 2], [-1, -2, 0], atol=1e-6)


@given(st.integers(1, 70), st.integers(1, 70))
def test_padding_repeats_the_lower_and_right_rim(height, width):
    photo = np.random.default_rng(height).integers(0, 256, (height, width, 3), np.uint8)
    larger = padded(photo)
    assert larger.shape[0] % 32 == larger.shape[1] % 32 == 0
    assert larger.shape[0] - height < 32
    np.testing.assert_array_equal(larger[:height, :width], photo)
    assert (larger[height:, :width] == photo[-1]).all()
    assert (larger[:, width:] == larger[:, width - 1 : width]).all()


def test_the_level_of_opencv_comes_back_whatever_the_threads():
    network = Network(bright_sky(), "bright", classic=True)
    blob = np.zeros((1, 3, 12, 16), np.float32)
    networks = [Network(bright_sky(), "bright", classic=True) for _ in range(6)]
    before = cv2.utils.logging.getLogLevel()
    with ThreadPoolExecutor(6) as pool:
        list(pool.map(lambda one: [one.run(blob) for _ in range(50)], networks))
    network.run(blob)
    assert cv2.utils.logging.getLogLevel() == before


@pytest.mark.parametrize(
    ("given", "wanted"),
    [([0.0, 1.0], [0.0, 1.0]), ([-1e-6, 1.000001], [0.0, 1.0]), ([-4.0, 4.0], [0.018, 0.982])],
    ids=["probabilities", "rounded", "logits"],
)
def test_numbers_a_hair_outside_are_probabilities(given, wanted):
    found = probabilities(np.array(given, np.float32))
    np.testing.assert_allclose(found, wanted, atol=1e-3)
    assert found.min() >= 0
    assert found.max() <= 1
