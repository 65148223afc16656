"""A data set is diagnosed photo by photo, each as its fold finds it."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.detector import Detector
from skyline_viz.diagnosis.data_set import diagnose_photos
from skyline_viz.diagnosis.worth import worth_trying, worths
from skyline_viz.evaluation.cross_validation import assign
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.running.resume import Kept
from testing.detections import WIDTH, slanting


@pytest.fixture(scope="module")
def items():
    """Two photos with their truths, and one whose truth lies 20 rows too high."""
    scenes = [slanting(number) for number in range(3)]
    raised = [0, 0, 20]
    return [
        sv.LoadedItem(f"p{number}", photo, sv.Skyline(truth.rows - raised[number]))
        for number, (photo, truth) in enumerate(scenes)
    ]


def tasks_of(items, method, folds=None):
    (tasks,) = assign(items, [method], folds).tasks.values()
    return tasks


def test_the_wrong_photo_has_a_cause_and_remedies(items):
    found, failures = diagnose_photos(tasks_of(items, Detector()))
    assert failures == []
    assert [one.diagnosis.right for one in found] == [True, True, False]
    assert found[2].a_err == pytest.approx(20, abs=1)
    assert found[2].remedies
    assert found[2].diagnosis.segments[0].cause


def test_right_photos_are_tried_with_what_helps_the_wrong_one(items):
    found, _ = diagnose_photos(tasks_of(items, Detector()))
    names = [{remedy.name for remedy in one.remedies} for one in found]
    assert names[0] == names[1] == worth_trying(found[2:])
    assert names[0] < names[2]
    assert {one.name for one in worths(found)} == names[0]


def test_a_photo_alone_does_not_wait(items):
    ((one,), _) = diagnose_photos(tasks_of(items[:1], Detector()))
    assert one.diagnosis.right
    assert len(one.remedies) > 25


def test_a_run_that_was_interrupted_knows_both_passes(items, tmp_path):
    kept = Kept(tmp_path)
    (tasks,) = assign(items, [Detector()], kept=kept).tasks.values()
    first, _ = diagnose_photos(tasks, kept=kept)
    again, _ = diagnose_photos(tasks, kept=kept)
    assert (kept.known, kept.asked) == (3, 6)
    assert [one.remedies for one in first] == [one.remedies for one in again]


def test_only_our_detector_has_settings_to_try(items):
    (one,), _ = diagnose_photos(tasks_of(items[2:], EdgesOnly()))
    assert not one.diagnosis.right
    assert one.remedies == ()


def test_remedies_are_left_out_where_nobody_asks(items):
    found, _ = diagnose_photos(tasks_of(items, Detector()), remedies=False)
    assert {one.remedies for one in found} == {()}


def test_each_fold_is_diagnosed_with_what_the_others_taught(items):
    tasks = tasks_of(items, Detector(), folds=3)
    assert [task.method.bank.provenance.images for task in tasks] == [2, 2, 2]
    found, _ = diagnose_photos(tasks, remedies=False)
    assert [one.name for one in found] == ["p0", "p1", "p2"]


def test_a_photo_that_cannot_be_diagnosed_is_a_failure(items):
    bare = sv.LoadedItem("bare", items[0].pixels)
    narrow = sv.LoadedItem("narrow", items[0].pixels, sv.Skyline(np.zeros(3)))
    found, failures = diagnose_photos(tasks_of([bare, narrow, items[0]], Detector()))
    assert [one.name for one in found] == ["p0"]
    assert list(map(str, failures)) == [
        "bare: there is no truth.",
        f"narrow: the photo is {WIDTH} columns wide, the truth 3.",
    ]


def test_another_tolerance_is_another_diagnosis(items, tmp_path):
    kept = Kept(tmp_path)
    (tasks,) = assign(items[2:], [Detector()], kept=kept).tasks.values()
    for known, tolerance in ((0, 0.0), (1, 0.0), (1, 30.0)):
        (one,), _ = diagnose_photos(tasks, tolerance, remedies=False, kept=kept)
        assert kept.known == known
        assert one.diagnosis.right == (tolerance > 20)
