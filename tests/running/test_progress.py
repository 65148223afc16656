"""A progress bar on a terminal, and a line now and then elsewhere."""

import io
import operator
import sys
from types import SimpleNamespace

import pytest

from skyline_viz.running import progress
from skyline_viz.running.batch import run


def tasks(count):
    return [SimpleNamespace(name=f"photo {number}") for number in range(count)]


class _Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_bar_on_a_terminal(monkeypatch):
    terminal = _Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr(progress, "PROGRESS_AFTER", 0.0)
    monkeypatch.setenv("TERM", "xterm")
    list(run(operator.attrgetter("name"), tasks(3), title="mountains"))
    assert "mountains" in terminal.getvalue()


def test_no_bar_for_a_moment(monkeypatch):
    terminal = _Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr(progress, "PROGRESS_AFTER", 1e9)
    list(run(operator.attrgetter("name"), tasks(3)))
    assert terminal.getvalue() == ""


@pytest.mark.parametrize(
    ("title", "counted"), [("photos", "2 of 4 photos"), ("training", "training: 2 of 4")]
)
def test_a_line_now_and_then_in_a_file(monkeypatch, capsys, title, counted):
    times = iter([0.0, 30.0, 90.0, 100.0, 300.0])
    monkeypatch.setattr(progress, "perf_counter", lambda: next(times))
    list(run(operator.attrgetter("name"), tasks(4), title=title))
    assert capsys.readouterr().err == f"{counted} after 2 min, about 2 min left\n"


def test_no_bar_in_a_file(monkeypatch, capsys):
    monkeypatch.setattr(progress, "PROGRESS_AFTER", 0.0)
    list(run(operator.attrgetter("name"), tasks(3)))
    assert capsys.readouterr().err == ""
