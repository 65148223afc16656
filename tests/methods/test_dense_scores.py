"""Dense scores of a support vector machine: the filter is the machine, fusions are equations."""

import subprocess
import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.edges import find_edges, to_grey
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.method import Learner, MethodError
from skyline_viz.methods.gradient import gradient_cost
from skyline_viz.methods.names import NAMES as ALL
from skyline_viz.methods.registry import make_method
from skyline_viz.methods.score_images import BAND, LEAST_DEVIATION, patches
from skyline_viz.methods.stable_edges import stable_edges
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline

NAMES = [name for name in ALL if name.startswith("svm-")]
SCENE = render("clear", 7, 150, 90)


@pytest.fixture(scope="module")
def trained(items):
    return make_method("svm-dcsi").fit(items, seed=3)


def found(trained, name, **settings):
    return replace(make_method(name).sharing(trained), **settings).detect(SCENE.photo)


def test_all_five_are_there():
    assert len(NAMES) == 5
    assert {make_method(name).family for name in NAMES} == {"svm-dcsi"}
    assert all(isinstance(make_method(name), Learner) for name in NAMES)


def test_decisions_are_dot_products_with_patches(trained):
    rng = np.random.default_rng(0)
    photo = np.concatenate([SCENE.photo, rng.integers(0, 256, (20, 150, 3), dtype=np.uint8)])
    photo[:30, :30] = 77  # nothing to see, even for the deviation
    rows = np.append(rng.integers(0, len(photo), 60), [0, 0, len(photo) - 1, 10])
    columns = np.append(rng.integers(0, 150, 60), [0, 149, 149, 10])
    seen = patches(to_grey(photo), rows, columns)
    by_hand = []
    for patch in seen.astype(np.float64):
        form = (patch - patch.mean()) / np.sqrt(patch.var() + LEAST_DEVIATION**2)
        by_hand.append((trained.model["weights"] * form).sum() + trained.model["bias"][0])
    assert np.ptp(by_hand) > 1
    np.testing.assert_allclose(trained.decisions(photo)[rows, columns], by_hand, atol=1e-3)
    slope, offset = trained.model["logistic"]
    scores = 1 / (1 + np.exp(-(slope * np.array(by_hand) + offset)))
    np.testing.assert_allclose(trained.dense_score(photo)[rows, columns], scores, atol=1e-3)


def test_the_skyline_scores_high(trained):
    dense = trained.dense_score(SCENE.photo)
    on_line = dense[SCENE.truth.pixel_rows(90), np.arange(150)]
    off_line = dense[np.abs(np.arange(90)[:, None] - SCENE.truth.rows) > BAND]
    assert on_line.mean() > off_line.mean() + 0.1


def ridge(seed):
    """A bright sky above dark, rough ground, as an item of a data set."""
    rng = np.random.default_rng(seed)
    rows = np.round(50 + 9 * np.sin(np.arange(180) / 17 + seed))
    sky = np.arange(100)[:, None] < rows
    grey = np.where(sky, 200 + rng.normal(0, 2, sky.shape), 80 + rng.normal(0, 15, sky.shape))
    photo = np.repeat(grey.clip(0, 255).astype(np.uint8)[..., None], 3, axis=2)
    return SimpleNamespace(photo=lambda: photo, truth=lambda: Skyline(rows=rows))


def test_it_finds_the_skyline_of_a_photo_that_it_has_not_seen():
    trained = make_method("svm-dcsi").fit([ridge(seed) for seed in range(3)])
    new = ridge(9)
    for name in NAMES:
        detection = make_method(name).sharing(trained).detect(new.photo())
        assert a_err(detection.skyline, new.truth()) < 2


@pytest.mark.parametrize("name", NAMES)
def test_detections_hold_together(trained, name):
    detection = found(trained, name)
    assert detection.method == name
    assert len(detection.scores) == detection.edges.sum() == len(detection.edge_rows)
    dense = trained.dense_score(SCENE.photo)
    np.testing.assert_array_equal(detection.scores, dense[detection.edges])
    assert 0 <= dense.min() < 0.1 < 0.9 < dense.max() <= 1
    assert ("dense score" in detection.maps) == (not detection.edges.all())
    assert detection.cost_model.edge_rest.min() > -1e-6
    assert (detection.cost <= detection.non_edge_cost).all()


def test_no_fusion_costs_what_the_score_lacks(trained):
    detection = found(trained, "svm-dcsi")
    assert detection.edges.all()
    np.testing.assert_array_equal(detection.cost, 1 - trained.dense_score(SCENE.photo))


def test_fusion_with_the_gradient(trained):
    detection = found(trained, "svm-dcsi-gradient", w2=0.3)
    dense = trained.dense_score(SCENE.photo)
    np.testing.assert_allclose(
        detection.cost, 0.3 * (1 - dense) + 0.7 * gradient_cost(SCENE.photo), atol=1e-6
    )


def test_fusion_with_edges(trained):
    dense = trained.dense_score(SCENE.photo)
    canny = find_edges(SCENE.photo, "grey", 50, 220)
    for name, edges in (("msee", stable_edges(SCENE.photo)), ("canny", canny)):
        detection = found(trained, f"svm-dcsi-{name}", w3=0.6)
        np.testing.assert_array_equal(detection.edges, edges)
        cost = 0.6 * (1 - dense) + np.where(edges, 0, 0.4)
        np.testing.assert_allclose(detection.cost, cost, atol=1e-6)
        np.testing.assert_array_equal(detection.maps["dense score"], dense)


def test_training_is_determined_by_the_seed(items, trained):
    again, other = (make_method("svm-dcsi").fit(items, seed=seed) for seed in (3, 4))
    for part, array in trained.model.items():
        np.testing.assert_array_equal(array, again.model[part])
    assert not np.array_equal(trained.model["weights"], other.model["weights"])


@pytest.mark.parametrize("name", NAMES)
def test_untrained(name):
    with pytest.raises(MethodError, match=f"train DATASET --method {name} "):
        make_method(name).detect(SCENE.photo)


def test_a_name_is_a_label_and_no_switch(trained):
    method = replace(trained, label="svm-dcsi-gradient")
    assert (method.name, method.fusion) == ("svm-dcsi-gradient", "none")
    assert replace(trained, fusion="canny").name == "svm-dcsi-canny"
    assert replace(trained, fusion="best", best=9).name == "svm-mdcsi:best=9"


def test_without_scikit_learn(items, monkeypatch):
    monkeypatch.setitem(sys.modules, "sklearn.svm", None)
    with pytest.raises(MethodError) as caught:
        make_method("svm-mdcsi").fit(items)
    assert str(caught.value).startswith("svm-mdcsi needs scikit-learn to be trained; install it ")


def test_packages_of_extras_are_imported_only_where_needed():
    code = (
        "import pkgutil, sys, importlib, skyline_viz.methods as methods\n"
        "for found in pkgutil.iter_modules(methods.__path__, 'skyline_viz.methods.'):\n"
        "    if found.name.endswith(('parsing_nets', 'parsing_training')):\n"
        "        continue  # which training imports\n"
        "    importlib.import_module(found.name)\n"
        "assert 'skyline_viz.methods.cnn_scores' in sys.modules\n"
        "print(sorted({'sklearn', 'onnx', 'torch'} & set(sys.modules)))"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.strip() == "[]"


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("size", [(2, 2), (9, 40), (40, 9)])
def test_any_photo(trained, name, size):
    photo = np.full((*size, 3), 90, np.uint8)
    detection = make_method(name).sharing(trained).detect(photo)
    assert np.isfinite(detection.cost).all()
    assert detection.skyline.width == size[1]


@pytest.mark.parametrize("name", NAMES)
def test_diagnosis(trained, name):
    detection = found(trained, name)
    shifted = Skyline(rows=np.clip(SCENE.truth.rows + 25 * (np.arange(150) > 60), 0, 89))
    diagnosis = diagnose(detection, shifted)
    assert not diagnosis.right
    assert diagnosis.main.columns[0] > 50
