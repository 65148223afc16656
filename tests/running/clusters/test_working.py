"""A cluster of two: order, bad photos, lost workers, and work of other versions."""

import os
import select
import signal
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import pytest

from skyline_viz.photo import PhotoError
from skyline_viz.running.batch import BatchError, Failure
from skyline_viz.running.clusters import requirements
from skyline_viz.running.clusters import working as module
from skyline_viz.running.clusters.connecting import cluster_at
from skyline_viz.system.notes import heard_by, note


@dataclass(frozen=True)
class Photo:
    name: str


def work(folder, task):
    """What a worker does: it leaves a mark, fails, dies, or notes something."""
    with Path(folder, task.name).open("a") as file:
        file.write("x")
    if task.name == "bad":
        raise PhotoError("bad is empty (0 bytes).")
    if task.name == "full":
        raise OSError(28, "No space left on device")
    if task.name == "noted":
        note("noted is odd.")
    if task.name == "deadly" or (task.name == "once" and Path(folder, "once").stat().st_size == 1):
        os.kill(os.getpid(), signal.SIGKILL)
    return f"{task.name} done"


@pytest.fixture(scope="module")
def two():
    with cluster_at("local:2") as cluster:
        yield cluster


def marks(folder):
    return {path.name: path.stat().st_size for path in Path(folder).iterdir()}


def test_values_come_in_order_and_bad_photos_are_passed(two, tmp_path):
    names = [f"p{number}" for number in range(30)]
    names[7], names[11] = "bad", "noted"
    heard = []
    with heard_by(heard.append):
        found = list(two.run(partial(work, tmp_path), [*map(Photo, names)]))
    wanted = [f"{name} done" for name in names]
    wanted[7] = Failure("bad", "bad is empty (0 bytes).")
    assert found == wanted
    assert heard == ["noted is odd."]
    assert set(marks(tmp_path).values()) == {1}


def test_a_worker_that_is_lost_costs_its_photos_only(two, tmp_path):
    names = ["once", *(f"p{number}" for number in range(40))]
    found = list(two.run(partial(work, tmp_path), [*map(Photo, names)]))
    assert found == [f"{name} done" for name in names]
    again = {name for name, times in marks(tmp_path).items() if times > 1}
    assert "once" in again
    lost = module._A_THREAD * module._MOST_A_TASK * 2
    assert len(again) <= lost


def test_fewer_threads_than_before_do_the_rest(two, tmp_path, monkeypatch):
    """More tasks are under way then than the threads that are left would get."""
    counts = iter([9, 9])
    monkeypatch.setattr(module, "_COUNT_EVERY", 0.0)
    monkeypatch.setattr(two.client, "nthreads", lambda: {"tcp://w:1": next(counts, 0)})
    names = [f"p{number}" for number in range(200)]
    found = list(two.run(partial(work, tmp_path), [*map(Photo, names)]))
    assert found == [f"{name} done" for name in names]


def test_a_photo_of_which_workers_die_fails_and_no_other_one(two, tmp_path):
    names = [*(f"p{number}" for number in range(12)), "deadly"]
    two.client.run_on_scheduler(_forgive, 0)
    found = list(two.run(partial(work, tmp_path), [*map(Photo, names)]))
    assert found[:-1] == [f"{name} done" for name in names[:-1]]
    died = "1 workers died of it, one by one, probably for want of memory"
    assert found[-1] == Failure("deadly", died)


def _forgive(times, dask_scheduler):
    dask_scheduler.allowed_failures = times


def test_a_full_disk_ends_it(two, tmp_path):
    with pytest.raises(OSError, match="No space left"):
        list(two.run(partial(work, tmp_path), [Photo("full")]))


def test_what_cannot_be_sent_is_named(two):
    with pytest.raises(BatchError, match="cannot be sent"):
        list(two.run(lambda task: task, [Photo("a")]))


def test_work_of_other_versions_is_refused_by_workers(two, tmp_path, monkeypatch):
    monkeypatch.setattr(module, "versions", lambda: {**requirements.versions(), "numpy": "1.0"})
    with pytest.raises(BatchError, match=r"a worker has numpy .*, and this program 1\.0; install"):
        list(two.run(partial(work, tmp_path), [Photo("a")]))


def held_up(folder, task):
    """What a worker does: p0 waits for p60, and then says which ones have begun."""
    begun, pipe = Path(folder), os.open(Path(folder, "pipe"), os.O_RDWR)
    (begun / task.name).touch()
    try:
        if task.name == "p60":
            os.write(pipe, b"x")
        if task.name == "p0" and not select.select([pipe], [], [], 60)[0]:
            return None
    finally:
        os.close(pipe)
    return {int(path.name[1:]) for path in begun.glob("p[0-9]*")}


def test_a_slow_photo_holds_up_those_far_behind_it_alone(two, tmp_path, monkeypatch):
    """A worker has tasks of eight photos: three under way, and four with those that have ended."""
    monkeypatch.setattr(module, "_KEPT", 4)
    os.mkfifo(tmp_path / "pipe")
    pipe = os.open(tmp_path / "pipe", os.O_RDWR)  # what p60 says stays in it until p0 listens
    photos = [Photo(f"p{at}") for at in range(100)]
    begun, *others = two.run(partial(held_up, tmp_path), photos)
    os.close(pipe)
    assert 60 in begun
    assert max(begun) < 2 * 4 * 8
    assert len(others) == 99


def test_a_cluster_that_goes_away_is_said_to_be_gone(tmp_path):
    with cluster_at("local:2") as cluster:
        found = cluster.run(partial(work, tmp_path), [Photo(f"p{at}") for at in range(500)])
        next(found)
        cluster.client.close()
        with pytest.raises(BatchError, match="the cluster is gone"):
            list(found)
