"""Running over many photos: order, bounds, bad photos, bad disks, and what is told meanwhile."""

import errno
import importlib
import operator
import os
import sys
from functools import partial
from types import SimpleNamespace

import pytest

from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.photo import PhotoError
from skyline_viz.running import batch
from skyline_viz.running.batch import BatchError, Failure, chosen_workers, run, sentence
from skyline_viz.skyline import SkylineError

HELPERS = """
import os
from pathlib import Path

def die(task):
    os._exit(9)

def threads(task):
    import cv2
    return cv2.getNumThreads()

def mark(folder, task):
    (Path(folder) / task.name).touch()
    return task.name

def lock(task):
    from threading import Lock
    return Lock()

def full(task):
    raise OSError(28, "No space left on device")
"""


@pytest.fixture
def helpers(tmp_path, monkeypatch):
    """A module that worker processes can import, too."""
    (tmp_path / "batch_helpers.py").write_text(HELPERS)
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.delitem(sys.modules, "batch_helpers", raising=False)
    return importlib.import_module("batch_helpers")


def tasks(count):
    return [SimpleNamespace(name=f"photo {number}") for number in range(count)]


@pytest.mark.parametrize("workers", [1, 2])
def test_values_come_in_order(workers):
    values = list(run(operator.attrgetter("name"), tasks(9), workers=workers))
    assert values == [f"photo {number}" for number in range(9)]


@pytest.mark.parametrize("workers", [1, 2])
def test_a_bad_photo_is_a_failure_in_its_place(workers, tmp_path):
    items = [DatasetItem(name, tmp_path / f"{name}.jpg") for name in ("a", "b")]
    outcomes = list(run(operator.methodcaller("photo"), items, workers=workers))
    assert [outcome.name for outcome in outcomes] == ["a", "b"]
    assert str(outcomes[1]).startswith(f"{tmp_path / 'b.jpg'} cannot be read: ")


def test_nothing_to_do():
    assert list(run(operator.attrgetter("name"), [], workers=3)) == []


def test_work_is_done_when_it_is_asked_for():
    done = []
    outcomes = run(lambda task: done.append(task.name), tasks(5))
    next(outcomes)
    assert done == ["photo 0"]


class _Counted(list):
    """Tasks that count how many were taken."""

    taken = 0

    def __iter__(self):
        for task in super().__iter__():
            self.taken += 1
            yield task


def test_few_photos_are_under_way_at_a_time(helpers, tmp_path):
    marks = tmp_path / "marks"
    marks.mkdir()
    photos = _Counted(tasks(40))
    outcomes = run(partial(helpers.mark, str(marks)), photos, workers=2)
    for done in range(1, 4):
        next(outcomes)
        assert photos.taken <= done + 4
    outcomes.close()
    assert len(list(marks.iterdir())) <= photos.taken


def test_workers_leave_the_other_processors_alone(helpers):
    assert list(run(helpers.threads, tasks(2), workers=2)) == [1, 1]


def test_a_dead_worker_ends_the_run_with_a_sentence(helpers):
    with pytest.raises(BatchError, match=r"a worker process died.*fewer workers"):
        list(run(helpers.die, tasks(4), workers=2))


def test_work_that_cannot_be_sent_is_refused_before_there_are_processes(monkeypatch):
    monkeypatch.setattr(batch, "ProcessPoolExecutor", None)
    with pytest.raises(BatchError, match=r"<lambda> cannot be sent.*use --workers 1\.$"):
        next(run(lambda task: task, tasks(4), workers=2))


def test_an_outcome_that_cannot_be_sent_back_is_one_sentence(helpers):
    with pytest.raises(BatchError, match=r"lock cannot be sent.*use --workers 1\.$"):
        list(run(helpers.lock, tasks(4), workers=2))


@pytest.mark.parametrize("workers", [1, 2])
def test_a_full_disk_ends_the_run(workers, helpers):
    with pytest.raises(OSError, match="No space left") as caught:
        list(run(helpers.full, tasks(3), workers=workers))
    assert caught.value.errno == errno.ENOSPC


def test_an_unwritable_file_is_the_failure_of_one_photo():
    def write(task):
        raise PermissionError(13, "Permission denied", "out/.0a1b.csv")

    outcomes = list(run(write, tasks(2)))
    assert str(outcomes[0]) == "photo 0: out: permission denied."
    assert len(outcomes) == 2


def test_an_interrupt_is_no_failure():
    def interrupted(task):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        list(run(interrupted, tasks(2)))


@pytest.mark.parametrize(
    ("workers", "count", "chosen"),
    [(0, 1, 1), (0, 23, 1), (3, 100, 3), (8, 2, 2), (5, 0, 1)],
)
def test_number_of_workers(workers, count, chosen):
    assert chosen_workers(workers, count) == chosen


def test_many_photos_are_shared_out(monkeypatch):
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    assert chosen_workers(0, 1000) == 2
    monkeypatch.setattr(os, "cpu_count", lambda: 64)
    assert chosen_workers(0, 1000) == 4
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert chosen_workers(0, 1000) == 1


def test_a_negative_number_of_workers_is_refused():
    with pytest.raises(ValueError, match="workers is 0 or more, not -1"):
        list(run(operator.attrgetter("name"), tasks(2), workers=-1))


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (PhotoError("a.jpg is empty (0 bytes)."), "a.jpg is empty (0 bytes)."),
        (SkylineError("the truth has 3 columns"), "the truth has 3 columns"),
        (ValueError("two\nlines"), "two lines"),
        (OSError(28, "No space left on device"), "no space left on device"),
        (IsADirectoryError(21, "Is a directory", "x.csv"), "x.csv: is a directory"),
        (MemoryError(), "it does not fit into memory"),
        (IndexError("7"), "unexpected IndexError: 7"),
        (ValueError(), "unexpected ValueError: "),
    ],
)
def test_errors_as_sentences(error, text):
    assert sentence(error) == text


@pytest.mark.parametrize(
    ("name", "reason", "text"),
    [
        ("a", "x/a.jpg is empty.", "x/a.jpg is empty."),
        ("a", "a.jpg is empty", "a.jpg is empty."),
        ("a", "there is no truth", "a: there is no truth."),
        ("1", "y.jpg is 1x1 pixels.", "1: y.jpg is 1x1 pixels."),
    ],
)
def test_failures_name_the_photo_once(name, reason, text):
    assert str(Failure(name, reason)) == text
