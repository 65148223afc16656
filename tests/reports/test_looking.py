"""Photos of a data set, looked at again."""

import pytest

from skyline_viz.detector import Detector
from skyline_viz.evaluation.tasks import photo_tasks
from skyline_viz.reports import look_at
from testing.detections import write_slanting


@pytest.fixture(scope="module")
def tasks(tmp_path_factory):
    items = write_slanting(tmp_path_factory.mktemp("looking") / "hills", count=2)
    return photo_tasks([(item, Detector()) for item in items])


def test_photos_come_in_order_with_their_diagnosis(tasks):
    photos, failures = look_at(tasks)
    assert [one.name for one in photos] == ["p0", "p1"]
    assert failures == []
    assert all(one.diagnosed and one.diagnosed.remedies == () for one in photos)


def test_what_is_known_is_taken(tasks):
    (first, _), _ = look_at(tasks, remedies=True)
    assert first.diagnosed.remedies
    (again, other), _ = look_at(tasks, [first.diagnosed])
    assert again.diagnosed is first.diagnosed
    assert other.diagnosed.remedies == ()


def test_a_photo_that_fails_is_told(tasks, tmp_path):
    (tmp_path / "bad.jpg").write_bytes(b"no photo")
    item = type(tasks[0].item)("bad", tmp_path / "bad.jpg")
    photos, (failure,) = look_at([*tasks, *photo_tasks([(item, Detector())])])
    assert len(photos) == 2
    assert failure.name == "bad"
