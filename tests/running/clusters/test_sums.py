"""Sums on a cluster: the same as in one process, past bad photos and lost workers."""

import copy
import os
import signal
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from skyline_viz.config import TrainingConfig
from skyline_viz.datasets.item import LoadedItem
from skyline_viz.evaluation.training_runs import train_on_several
from skyline_viz.photo import PhotoError
from skyline_viz.running.batch import BatchError, Failure, working_on
from skyline_viz.running.clusters import sums as module
from skyline_viz.running.clusters.connecting import cluster_at
from skyline_viz.running.clusters.sums import Sum, summed
from skyline_viz.system.notes import heard_by, note
from testing.programs.commands import scene


@dataclass(frozen=True)
class Number:
    name: str
    value: int


def value(folder, task):
    """What a worker gives: a number, a failure, a note, or its death."""
    if task.name == "bad":
        raise PhotoError("bad is empty (0 bytes).")
    if task.name == "noted":
        note("noted is odd.")
    if task.name == "once" and not Path(folder, "once").exists():
        Path(folder, "once").touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return task.value


@pytest.fixture(scope="module")
def two():
    with cluster_at("local:2") as cluster:
        yield cluster


@pytest.mark.parametrize("count", [1, 7, 600])
def test_all_photos_are_summed_once_past_bad_ones_and_a_lost_worker(
    two, tmp_path, monkeypatch, count
):
    monkeypatch.setattr(module, "_MOST_A_TASK", 4)
    tasks = [Number(f"p{number}", 3**number) for number in range(count)]
    if count > 2:
        tasks[1:1] = [Number("bad", 1), Number("noted", 0), Number("once", 0)]
    heard = []
    with heard_by(heard.append):
        total, failures = summed(two, partial(value, tmp_path), tasks)
    assert total == (3**count - 1) // 2
    assert failures == ([Failure("bad", "bad is empty (0 bytes).")] if count > 2 else [])
    assert heard == (["noted is odd."] if count > 2 else [])


def test_where_every_photo_fails_there_is_no_sum(two, tmp_path):
    total, failures = summed(two, partial(value, tmp_path), [Number("bad", 1)] * 3)
    assert (total, len(failures)) == (None, 3)
    assert summed(two, partial(value, tmp_path), []) == (None, [])


def test_what_cannot_be_sent_is_named(two):
    with pytest.raises(BatchError, match="cannot be sent"):
        summed(two, lambda task: task, [Number("a", 1)])


def test_sums_of_failures_and_values_add_up():
    bad = Failure("bad", "x")
    sums = [Sum(None, [bad]), Sum(2), Sum(3, [bad], ["n"])]
    before = copy.deepcopy(sums)
    assert module._add_there(sums) == Sum(5, [bad, bad], ["n"])
    assert sums == before  # those of a worker stay as they are


def test_failures_are_kept_in_place():
    whole = Sum()
    kept = whole.failures
    whole += Sum(None, [Failure("bad", "x")])
    assert whole.failures is kept


def test_a_cluster_trains_the_same_bank_to_the_bit(two):
    sets = {
        name: [LoadedItem(f"{name}{at}", *scene(at)) for at in places]
        for name, places in {"one": range(6), "other": range(6, 9)}.items()
    }
    training = TrainingConfig(filter_size=3)
    with working_on(two):
        there, failed = train_on_several(sets, training)
    here, _ = train_on_several(sets, training)
    assert failed == []
    np.testing.assert_array_equal(there.filters, here.filters)
    np.testing.assert_array_equal(there.samples, here.samples)
    assert (there.provenance, there.seen) == (here.provenance, here.seen)
