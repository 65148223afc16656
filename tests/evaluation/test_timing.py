"""How long methods take: all of them in the same way, and nothing else is changed by it."""

import cv2
import numpy as np
import pytest

from skyline_viz.evaluation import timing
from skyline_viz.evaluation.timing import SIZE, TIMES, time_methods


class Slow:
    """Takes so many ticks of the clock for a detection."""

    def __init__(self, clock, *ticks):
        self.clock, self.ticks, self.seen = clock, list(ticks), []

    def detect(self, photo):
        self.seen.append((photo.shape[:2], cv2.getNumThreads()))
        self.clock[0] += self.ticks[len(self.seen) - 1]


def test_the_fastest_counts_after_one_that_is_not_measured(monkeypatch):
    clock, threads = [0.0], cv2.getNumThreads()
    monkeypatch.setattr(timing, "perf_counter", lambda: clock[0])
    methods = {"a": Slow(clock, 1, 9, 7, 8), "b": Slow(clock, 0.5, 2, 3, 4)}
    found = time_methods(methods, np.zeros((60, 80, 3), np.uint8))
    assert [(one.name, one.seconds) for one in found] == [("a", 7), ("b", 2)]
    for method in methods.values():
        assert method.seen == [(SIZE, 1)] * (TIMES + 1)
    assert cv2.getNumThreads() == threads


def test_threads_come_back_after_a_failure():
    threads = cv2.getNumThreads()
    with pytest.raises(IndexError):
        time_methods({"a": Slow([0.0])}, np.zeros((60, 80, 3), np.uint8))
    assert cv2.getNumThreads() == threads
