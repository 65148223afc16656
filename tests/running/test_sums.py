"""Sums of parts: by processes, and by what works in their place."""

from dataclasses import dataclass

from skyline_viz.running.batch import Failure, run, working_on
from skyline_viz.running.sums import sums_of


@dataclass(frozen=True)
class Number:
    name: str
    value: int


def value(task):
    if task.value < 0:
        raise ValueError(f"{task.name} is negative.")
    return task.value


PARTS = [[Number("a", 1), Number("b", -1), Number("c", 2)], [], [Number("d", -2)], [Number("e", 5)]]
FAILED = [Failure("b", "b is negative."), Failure("d", "d is negative.")]


class Elsewhere:
    """Notes what it was asked for."""

    def __init__(self):
        self.asked = []

    def run(self, function, tasks, *, title="photos"):
        self.asked.append([one.name for one in tasks])
        yield from ("done" for _ in tasks)

    def summed(self, function, tasks, *, title="photos"):
        self.asked.append([one.name for one in tasks])
        good = [one.value for one in tasks if one.value >= 0]
        bad = [Failure(one.name, f"{one.name} is negative.") for one in tasks if one.value < 0]
        return (sum(good) if good else None), bad


def test_each_part_has_its_sum_past_what_fails():
    assert sums_of(value, PARTS) == ([3, None, None, 5], FAILED)


def test_a_cluster_is_asked_for_sums_alone():
    there = Elsewhere()
    with working_on(there):
        assert sums_of(value, PARTS) == ([3, None, None, 5], FAILED)
        assert there.asked == [["a", "b", "c"], [], ["d"], ["e"]]
        assert [*run(value, PARTS[0], workers=2)] == ["done"] * 3
    assert [*run(value, PARTS[3])] == [5]
