"""Evaluation and cross-validation against training by hand; what fails is told once."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.config import DetectorConfig, TrainingConfig
from skyline_viz.detector import Detector
from skyline_viz.evaluation.cross_validation import (
    assign,
    chosen_methods,
    cross_validate,
    evaluate,
)
from skyline_viz.method import MethodError
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.running.batch import Failure
from testing.detections import HEIGHT, WIDTH


@pytest.fixture
def gone(items, tmp_path):
    """A photo that cannot be read, between the first and the second one."""
    return sv.DatasetItem("p05", tmp_path / "gone.png", items[0].truth_path)


def errors(results):
    return [one.a_err for one in results]


def test_skylines_of_a_data_set_are_compared_with_its_truths(items):
    found = evaluate(items, Detector())
    (results,) = found.results.values()
    assert found.failures == ()
    assert [one.name for one in results] == ["p0", "p1", "p2", "p3", "p4"]
    assert max(one.a_err for one in results) < 2
    assert all((one.height, one.width) == (HEIGHT, WIDTH) for one in results)
    assert all(one.seconds > 0 for one in results)


def test_bad_photos_and_bad_truths_are_failures(items, tmp_path):
    (tmp_path / "short.csv").write_text("column,row,visible\n0,3,1\n")
    bad = [
        sv.DatasetItem("gone", tmp_path / "gone.png", items[0].truth_path),
        sv.DatasetItem("bare", items[0].photo_path),
        sv.DatasetItem("short", items[0].photo_path, tmp_path / "short.csv"),
    ]
    found = evaluate([*bad, items[1]])
    assert [one.name for one in found.results["default"]] == ["p1"]
    assert [failure.name for failure in found.failures] == ["gone", "bare", "short"]
    assert str(found.failures[1]) == "bare: there is no truth."
    assert str(found.failures[2]) == f"short: the photo is {WIDTH} columns wide, the truth 1."


def test_each_fold_is_tested_with_the_sum_of_the_others(items, monkeypatch):
    gathered = []
    plain = Detector.gather
    monkeypatch.setattr(
        Detector,
        "gather",
        lambda self, item, seed: gathered.append(item) or plain(self, item, seed),
    )
    config = DetectorConfig(delta=2)
    assigned = assign(list(items)[::-1], [Detector(config=config)], 2, seed=7)
    assert sorted(item.name for item in gathered) == [item.name for item in items]  # each once
    (tasks,) = assigned.tasks.values()
    assert [task.name for task in tasks] == [item.name for item in items]
    banks = {task.name: task.method.bank for task in tasks}
    assert {task.method.config for task in tasks} == {config}
    training = TrainingConfig(detector=config)
    for fold in (0, 1):
        others = [items[index] for index in range(len(items)) if index % 2 != fold]
        expected = sv.train([(i.photo(), i.truth()) for i in others], seed=7, config=training)
        for item in items[fold::2]:
            np.testing.assert_array_equal(banks[item.name].samples, expected.samples)
            np.testing.assert_allclose(banks[item.name].filters, expected.filters, atol=1e-6)


def test_a_photo_that_fails_in_training_keeps_the_folds_of_the_others(items, gone):
    assigned = assign([*items, gone], [Detector()], 2)
    (tasks,) = assigned.tasks.values()
    (failures,) = assigned.failures.values()
    assert [failure.name for failure in failures] == ["p05"]
    # in order: p0 (fold 0), p05 (1, fails), p1 (0), p2 (1), p3 (0), p4 (1)
    images = {task.name: task.method.bank.provenance.images for task in tasks}
    assert images == {"p0": 2, "p1": 2, "p2": 3, "p3": 2, "p4": 3}


@pytest.mark.parametrize("folds", [-1, 0, 1, 6])
def test_too_few_and_too_many_folds_are_refused(items, folds):
    with pytest.raises(ValueError, match=f"from 2 to the 5 photos, not {folds}"):
        cross_validate(items, folds=folds)


def test_a_cross_validation_finds_the_lines(items):
    found = cross_validate(items, folds=5)
    assert found.failures == ()
    assert max(errors(found.results["default"])) < 2


def test_any_number_of_processes_comes_to_the_same(items):
    alone = cross_validate(items, ["default", "sift-hog-edges"], 2)
    shared = cross_validate(items, ["default", "sift-hog-edges"], 2, workers=2)
    assert alone.failures == shared.failures == ()
    for name, results in alone.results.items():
        assert errors(results) == errors(shared.results[name])


def test_adding_comes_to_the_same_as_learning_anew_for_each_fold(items):
    class Slow:
        """Our detector, without what adds up."""

        def __init__(self, detector=None):
            self.detector = detector or Detector()
            self.name, self.family = "slow", "slow"
            self.detect = self.detector.detect

        def fit(self, items, seed=0):
            return Slow(self.detector.fit(items, seed))

        def sharing(self, other):
            return other

    found = cross_validate(items, [Detector(), Slow()], 2)
    assert errors(found.results["slow"]) == errors(found.results["default"])
    assert found.failures == ()


def test_what_every_method_fails_on_is_told_once_by_its_own_name(items, gone):
    methods = [Detector(), Detector(config=DetectorConfig.paper()), EdgesOnly()]
    for found in (evaluate([*items, gone], methods), cross_validate([*items, gone], methods, 2)):
        assert [failure.name for failure in found.failures] == ["p05"]
        assert {name: len(one) for name, one in found.results.items()} == {
            "default": 5,
            "paper": 5,
            "edges": 5,
        }


def test_what_only_one_method_fails_on_names_it(items):
    class Poor(EdgesOnly):
        def detect(self, photo):
            raise ValueError("it rains.")

    found = evaluate(items[:1], [Detector(), Poor()])
    assert found.failures == (Failure("p0, edges", "it rains."),)
    assert (len(found.results["default"]), found.results["edges"]) == (1, [])


def test_a_method_that_cannot_learn_is_one_failure_and_others_go_on(items):
    class Poor(EdgesOnly):
        family = "poor"

        def fit(self, items, seed=0):
            raise ValueError("it rains.")

        def sharing(self, other):
            return self

    found = cross_validate(items, [Poor(), Detector()], 2)
    assert found.results["edges"] == []
    assert len(found.results["default"]) == 5
    assert found.failures == (Failure("edges", "it rains."),)
    assert list(found.methods) == ["default"]


def test_photos_without_a_visible_line_teach_nothing_and_that_is_a_sentence(items):
    blind = sv.Skyline(np.full(WIDTH, 20.0), np.zeros(WIDTH, bool))
    photos = [sv.LoadedItem(name, items[0].photo(), blind) for name in "ab"]
    found = cross_validate(photos, folds=2)
    assert found.results == {"default": []}
    assert [one.name for one in found.failures] == ["default"]
    assert "at least one photo with a visible true skyline" in str(found.failures[0])


def test_methods_are_one_or_several_texts_or_objects():
    assert [one.name for one in chosen_methods("edges")] == ["edges"]
    assert [one.name for one in chosen_methods(Detector())] == ["default"]
    assert [one.name for one in chosen_methods(["paper", EdgesOnly()])] == ["paper", "edges"]
    with pytest.raises(MethodError, match="two methods are called edges"):
        chosen_methods(["edges", EdgesOnly()])


def test_a_method_that_has_learned_nothing_is_one_sentence(items):
    with pytest.raises(MethodError, match="svm-dcsi has learned nothing yet"):
        evaluate(items, "svm-dcsi")


def test_a_data_set_can_be_evaluated_as_it_is(items):
    dataset = sv.open_dataset(items[0].photo_path.parents[1])
    found = evaluate(dataset, "edges")
    assert len(found.results["edges"]) == len(dataset)


class _Level:
    name = "level"

    def detect(self, photo):
        return np.full(photo.shape[1], 7.0)


@pytest.mark.parametrize("several", [set, list, iter], ids=["set", "list", "iterator"])
def test_methods_may_come_in_any_collection(several):
    methods = several([sv.Detector(), "edges", _Level()])
    assert {one.name for one in chosen_methods(methods)} == {"default", "edges", "level"}


@pytest.mark.parametrize("no_method", [3, [3], {"default", 3}], ids=["number", "list", "set"])
def test_what_is_no_method_is_refused_with_a_sentence(no_method):
    with pytest.raises(MethodError, match=r"^3 is no method: it has no detect\(photo\)\.$"):
        sv.evaluate([], no_method)


@pytest.mark.parametrize(
    ("items", "says"),
    [
        ([], "there are no photos to work on"),
        ("web_dataset", "web_dataset is a path; open it with sv.open_dataset"),
        ([(np.zeros((3, 3, 3), np.uint8), None)], "this is a tuple"),
        (7, "this is a int"),
    ],
)
def test_what_is_no_data_set_is_refused_in_a_sentence(items, says):
    for ask in (sv.evaluate, sv.cross_validate):
        with pytest.raises(ValueError, match=says):
            ask(items, "default")


def test_nothing_to_test_and_what_has_learned_already_are_refused(items, tmp_path):
    with pytest.raises(MethodError, match="there are no methods to test"):
        sv.evaluate(items, [])
    sv.Detector().save(tmp_path / "d.npz")
    with pytest.raises(MethodError, match=r"d\.npz has learned already"):
        sv.cross_validate(items, [str(tmp_path / "d.npz")])
