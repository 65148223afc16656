"""Compiled loops are loaded once a process."""

from skyline_viz.detector import Detector
from skyline_viz.running.warming import warm_up


def test_the_second_call_detects_nothing(monkeypatch):
    warm_up()

    def detect(*_):
        raise AssertionError("it is warm already")

    monkeypatch.setattr(Detector, "detect", detect)
    warm_up()
