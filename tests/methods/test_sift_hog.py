"""Descriptors, the classifier of edges, and the three methods that use it."""

import sys
from dataclasses import dataclass, replace

import numpy as np
import pytest

from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.method import Learner, MethodError
from skyline_viz.methods import sift_hog
from skyline_viz.methods.descriptors import LENGTH
from skyline_viz.methods.edges_only import RULED_OUT
from skyline_viz.methods.gradient import gradient_cost
from skyline_viz.methods.sift_hog import (
    SiftHogEdges,
    SiftHogScores,
    SiftHogScoresGradient,
    normalised,
    samples,
    train_svm,
)
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline

METHODS = [SiftHogEdges(), SiftHogScores(), SiftHogScoresGradient()]
EACH = pytest.mark.parametrize("method", METHODS, ids=[one.name for one in METHODS])


@dataclass(frozen=True)
class Item:
    """Stands for an item of a data set, without files."""

    scene: object
    known: bool = True

    def photo(self):
        return self.scene.photo

    def truth(self):
        return self.scene.truth if self.known else None


@pytest.fixture(scope="module")
def items():
    return [Item(render("clear", seed, 320, 200)) for seed in (1, 2, 3)]


@pytest.fixture(scope="module")
def fitted(items):
    pytest.importorskip("sklearn")
    return SiftHogEdges().fit(items, seed=7)


@pytest.fixture(scope="module")
def unseen():
    return render("clear", 9, 320, 200)


def test_scores_are_ordered_and_the_boundary_gets_a_half():
    found = normalised(np.array([-90, -1, 0, 1, 90], np.float32))
    assert (np.diff(found) > 0).all()
    assert found[2] == 0.5
    assert found.min() >= 0
    assert found.max() <= 1


def test_the_three_nodal_costs_are_the_equations(unseen):
    rows, columns = np.array([3, 50], np.int32), np.array([8, 90], np.int32)
    scores = np.array([0.9, 0.5], np.float32)

    def of(method):
        return method.nodal_costs(unseen.photo, rows, columns, scores)

    assert of(SiftHogEdges()).tolist() == [1, 1]
    assert of(SiftHogScores()) == pytest.approx([0.1, 0.5])
    even = gradient_cost(unseen.photo)[rows, columns]
    assert of(SiftHogScoresGradient()) == pytest.approx(0.5 * (1 - scores) + 0.5 * even)


@EACH
def test_without_training_there_is_a_plain_error(method, unseen):
    with pytest.raises(MethodError, match=f"train it with: .*--method {method.name}"):
        method.detect(unseen.photo)


@EACH
def test_one_training_serves_all_three(method, fitted, unseen):
    assert isinstance(method, Learner)
    assert method.family == "sift-hog"
    detection = method.sharing(fitted).detect(unseen.photo)
    assert detection.method == method.name
    assert a_err(detection.skyline, unseen.truth) < 1.5
    found = detection.edges[detection.skyline.rows.astype(int), np.arange(320)]
    assert found.mean() > 0.8


@EACH
def test_edges_below_a_half_are_ruled_out_and_the_others_pay_for_their_score(
    method, fitted, unseen
):
    detection = method.sharing(fitted).detect(unseen.photo)
    cost = detection.cost[detection.edge_rows, detection.edge_columns]
    nodes = detection.scores > 0.5
    assert 0.01 < nodes.mean() < 0.9
    assert (cost[~nodes] >= method.gap_cost).all()
    assert (cost[~nodes] == RULED_OUT).any()
    rest = detection.cost_model.edge_rest[nodes]
    if method.name == "sift-hog-edges":
        assert (cost[nodes] == 1).all()
    elif method.name == "sift-hog-scores":
        assert rest == pytest.approx(0, abs=1e-6)
    else:
        assert rest.min() > 0
        assert rest.max() <= 0.5


def test_training_is_seeded_and_the_order_of_photos_does_not_matter(items, fitted):
    again = SiftHogEdges().fit(items, seed=7)
    assert (again.model["weights"] == fitted.model["weights"]).all()
    some, labels = samples(items[0].photo(), items[0].truth(), 7)
    assert (some == samples(items[0].photo(), items[0].truth(), 7)[0]).all()
    assert labels.any()
    assert not labels.all()
    others, _ = samples(items[0].photo(), items[0].truth(), 8)
    assert others.shape != some.shape or (others != some).any()
    back = SiftHogEdges().fit(items[::-1], seed=7).model["weights"]
    assert back == pytest.approx(fitted.model["weights"], abs=0.02)


def test_the_model_is_plain_numbers(fitted):
    assert {name: part.shape for name, part in fitted.model.items()} == {
        "weights": (LENGTH,),
        "bias": (1,),
    }
    assert all(part.dtype == np.float32 for part in fitted.model.values())


def test_weights_are_those_of_plain_descriptors():
    pytest.importorskip("sklearn")
    rng = np.random.default_rng(4)
    descriptors = rng.uniform(0, 0.2, (400, LENGTH)).astype(np.float32)
    labels = descriptors[:, 17] > 0.1
    weights, bias = train_svm(descriptors, labels)
    assert np.abs(weights).argmax() == 17
    assert (((descriptors @ weights + bias) > 0) == labels).mean() > 0.9


def test_photos_without_truth_are_left_out(items, fitted):
    fewer = SiftHogScores().fit([*items, replace(items[0], known=False)], seed=7)
    assert (fewer.model["weights"] == fitted.model["weights"]).all()
    with pytest.raises(ValueError, match="at least one photo"):
        SiftHogScores().fit([replace(items[0], known=False)])


def test_there_have_to_be_edges_on_the_skyline_and_off_it():
    pytest.importorskip("sklearn")
    descriptors = np.zeros((3, LENGTH), np.float32)
    for labels in (np.ones(3, bool), np.zeros(3, bool), np.zeros(0, bool)):
        with pytest.raises(ValueError, match="edges on the true skyline"):
            train_svm(descriptors[: len(labels)], labels)


def test_a_missing_package_is_named(items, monkeypatch):
    monkeypatch.setitem(sys.modules, "sklearn.svm", None)
    with pytest.raises(MethodError, match=r"-m pip install .*scikit-learn") as raised:
        SiftHogScores().fit(items)
    assert "\n" not in str(raised.value)


def test_detection_needs_no_scikit_learn(fitted, unseen, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "sklearn", None)
    monkeypatch.setitem(__import__("sys").modules, "sklearn.svm", None)
    assert fitted.detect(unseen.photo).skyline.width == 320


@EACH
def test_a_photo_without_edges_and_a_tiny_one_give_a_line(method, fitted):
    for shape in ((40, 60, 3), (2, 2, 3)):
        photo = np.full(shape, 128, np.uint8)
        assert method.sharing(fitted).detect(photo).skyline.width == shape[1]


@EACH
def test_detections_can_be_diagnosed(method, fitted, unseen):
    detection = method.sharing(fitted).detect(unseen.photo)
    assert diagnose(detection, detection.skyline).right
    moved = Skyline(np.minimum(unseen.truth.rows + 40, 199))
    diagnosis = diagnose(detection, moved)
    assert not diagnosis.right
    assert diagnosis.main.mean_error > 20


@EACH
def test_edges_that_the_classifier_ruled_out_are_misjudged(method, fitted, monkeypatch):
    photo = np.full((120, 300, 3), 220, np.uint8)
    photo[50:] = 120
    photo[75:] = 30  # another line, within delta

    def wrong_in_the_middle(_photo, rows, columns, _weights):
        doubtful = (rows < 60) & (columns >= 100) & (columns < 180)
        return np.where(doubtful, -9.0, 9.0).astype(np.float32)

    monkeypatch.setattr(sift_hog, "project", wrong_in_the_middle)
    detection = method.sharing(fitted).detect(photo)
    diagnosis = diagnose(detection, Skyline(np.full(300, 50.0)))
    assert not diagnosis.right
    assert diagnosis.causes == ("misjudged",)
