"""Dense scores of a network: what OpenCV runs on a photo is what PyTorch trained on patches."""

import sys

import cv2
import numpy as np
import pytest

from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.edges import to_grey
from skyline_viz.method import Learner, MethodError
from skyline_viz.methods import cnn_scores
from skyline_viz.methods.cnn_scores import (
    CHANNELS,
    CnnScores,
    locally_normalised,
    onnx_graph,
    patch_network,
    train_network,
)
from skyline_viz.methods.names import NAMES as ALL
from skyline_viz.methods.registry import make_method
from skyline_viz.methods.score_images import BAND, LEAST_DEVIATION, patches
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline
from testing.deep import deep

NAMES = [name for name in ALL if name.startswith("cnn-")]
SCENE = render("clear", 7, 150, 90)


@pytest.fixture(scope="module")
def trained(items):
    deep("onnx")
    deep("torch")
    return make_method("cnn-dcsi").fit(items, seed=3)


@pytest.fixture(scope="module")
def network():
    """Weights after a few steps, on patches that say nothing about skylines."""
    rng = np.random.default_rng(5)
    samples = rng.normal(size=(600, 16, 16)).astype(np.float32)
    return train_network(deep("torch"), samples, samples[:, 8, 8] > 0, 1, epochs=2)


def of(weights):
    """A method with these weights."""
    graph = np.frombuffer(onnx_graph(deep("onnx"), weights), np.uint8)
    return CnnScores({"onnx": graph})


def test_all_five_are_there():
    assert len(NAMES) == 5
    assert {make_method(name).family for name in NAMES} == {"cnn-dcsi"}
    assert all(isinstance(make_method(name), Learner) for name in NAMES)


@pytest.mark.parametrize("strip", [512, 33])
def test_opencv_on_a_photo_is_pytorch_on_patches(network, monkeypatch, strip):
    torch = deep("torch")
    monkeypatch.setattr(cnn_scores, "STRIP", strip)
    rows, columns = (grid.ravel() for grid in np.mgrid[0:90:7, 0:150:11])
    rows, columns = np.append(rows, [89, 89, 32, 33]), np.append(columns, [0, 149, 70, 70])
    seen = patches(locally_normalised(SCENE.photo), rows, columns)
    weights = {name: torch.from_numpy(array) for name, array in network.items()}
    values = patch_network(torch, weights, torch.from_numpy(seen)[:, None])
    assert np.ptp(values.numpy()) > 0.1
    dense = of(network).dense_score(SCENE.photo)
    assert dense.shape == (90, 150)
    np.testing.assert_allclose(dense[rows, columns], torch.sigmoid(values).numpy(), atol=1e-5)


def test_every_weight_counts(network):
    before = of(network).dense_score(SCENE.photo)
    for name, array in network.items():
        changed = of({**network, name: array * 1.5 + 0.1}).dense_score(SCENE.photo)
        assert not np.allclose(before, changed, atol=1e-4), name


def test_local_normalisation():
    grey = to_grey(SCENE.photo).astype(np.float64)
    seen = patches(grey, np.array([40]), np.array([70]))[0].astype(np.float64)
    wanted = (grey[40, 70] - seen.mean()) / np.sqrt(seen.var() + LEAST_DEVIATION**2)
    assert locally_normalised(SCENE.photo)[40, 70] == pytest.approx(wanted, abs=1e-4)


def test_the_network_learns():
    torch = deep("torch")
    rng = np.random.default_rng(2)
    samples = rng.normal(0, 0.3, (3000, 16, 16)).astype(np.float32)
    labels = rng.random(3000) < 0.3
    samples[labels, 8:] += 1  # a step at the middle row
    weights = train_network(torch, samples[:2500], labels[:2500], 0)
    given = {name: torch.from_numpy(array) for name, array in weights.items()}
    values = patch_network(torch, given, torch.from_numpy(samples[2500:])[:, None]).numpy()
    assert ((values > 0) == labels[2500:]).mean() > 0.95


def test_training_is_determined_by_the_seed(network):
    torch = deep("torch")
    samples = np.random.default_rng(5).normal(size=(600, 16, 16)).astype(np.float32)
    torch.manual_seed(99)  # which does not matter
    again = train_network(torch, samples, samples[:, 8, 8] > 0, 1, epochs=2)
    other = train_network(torch, samples, samples[:, 8, 8] > 0, 2, epochs=2)
    for name, array in network.items():
        np.testing.assert_array_equal(array, again[name])
    assert not np.array_equal(network["first"], other["first"])


def test_training_leaves_the_threads_as_they_were():
    torch = deep("torch")
    threads = torch.get_num_threads()
    samples = np.zeros((4, 16, 16), np.float32)
    train_network(torch, samples, np.arange(4) > 1, 0, epochs=1)
    assert torch.get_num_threads() == threads


def test_model_is_the_graph(trained):
    graph = trained.model["onnx"]
    assert set(trained.model) == {"onnx"}
    assert graph.dtype == np.uint8
    assert graph.ndim == 1
    model = deep("onnx").load_from_string(graph.tobytes())
    shapes = {tensor.name: tuple(tensor.dims) for tensor in model.graph.initializer}
    assert shapes["first"] == (CHANNELS[0], 1, 5, 5)
    assert not cv2.dnn.readNetFromONNX(graph).empty()


@pytest.mark.parametrize("name", NAMES)
def test_detections_hold_together(trained, name):
    detection = make_method(name).sharing(trained).detect(SCENE.photo)
    dense = trained.dense_score(SCENE.photo)
    assert detection.method == name
    np.testing.assert_array_equal(detection.scores, dense[detection.edges])
    assert detection.cost_model.edge_rest.min() > -1e-6
    shifted = Skyline(rows=np.clip(SCENE.truth.rows + 25 * (np.arange(150) > 60), 0, 89))
    assert not diagnose(detection, shifted).right


def test_the_skyline_scores_high(trained):
    dense = trained.dense_score(SCENE.photo)
    on_line = dense[SCENE.truth.pixel_rows(90), np.arange(150)]
    off_line = dense[np.abs(np.arange(90)[:, None] - SCENE.truth.rows) > BAND]
    assert on_line.mean() > off_line.mean() + 0.1


@pytest.mark.parametrize("size", [(2, 2), (9, 40)])
def test_any_photo(network, size):
    assert of(network).detect(np.full((*size, 3), 90, np.uint8)).skyline.width == size[1]


@pytest.mark.parametrize("name", NAMES)
def test_untrained(name):
    with pytest.raises(MethodError, match=f"train DATASET --method {name} "):
        make_method(name).detect(SCENE.photo)


@pytest.mark.parametrize("missing", ["torch", "onnx"])
def test_without_a_package(items, monkeypatch, missing):
    for module in ("torch", "onnx"):
        monkeypatch.setitem(sys.modules, module, None if module == missing else sys)
    with pytest.raises(MethodError) as caught:
        make_method("cnn-dcsi-canny").fit(items)
    assert str(caught.value).startswith(f"cnn-dcsi-canny needs {missing} to be trained; install ")
