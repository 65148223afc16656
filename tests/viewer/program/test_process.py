"""Pictures of the viewer: a busy machine is waited for, one that does nothing is not."""

import io

import numpy as np
import pytest
from PIL import Image

from skyline_viz.viewer.program import process as viewer
from skyline_viz.viewer.program.rerun_internals import ViewerError


class Clock:
    """Time that passes only when somebody waits, a few seconds at a time."""

    def __init__(self, monkeypatch, step):
        self.now, self.step = 0.0, step
        monkeypatch.setattr(viewer, "monotonic", lambda: self.now)
        monkeypatch.setattr(viewer, "sleep", self.wait)

    def wait(self, _):
        self.now += self.step


class Client:
    """A viewer whose picture changes so many times, and which loads so long."""

    def __init__(self, changes, loads=0, blank=False):
        self.changes, self.loads, self.blank, self.taken = changes, loads, blank, 0

    def take_screenshot(self):
        self.taken += 1
        shade = 0 if self.blank else min(self.taken, self.changes)
        pixels = np.full((4, 4, 3), shade % 200, np.uint8)
        pixels[0] = 0 if self.blank else 255
        file = io.BytesIO()
        Image.fromarray(pixels).save(file, "png")
        return file.getvalue()

    def get_state(self):
        return type("State", (), {"loading": self.taken < self.loads})


def test_a_busy_machine_is_waited_for(monkeypatch):
    clock = Clock(monkeypatch, step=20)
    assert viewer.settled_picture(Client(changes=20, loads=22)).size == (4, 4)
    assert clock.now > 400


class Spinning(Client):
    """A viewer of which a card never comes: nothing moves but a dot."""

    def take_screenshot(self):
        self.taken += 1
        pixels = np.zeros((80, 80, 3), np.uint8)
        pixels[:40] = 200
        pixels[60, self.taken % 3] = 255
        file = io.BytesIO()
        Image.fromarray(pixels).save(file, "png")
        return file.getvalue()


@pytest.mark.parametrize(
    ("client", "says", "waited"),
    [
        (Client(changes=10**6), "no steady picture within 600 s", 600),
        (Spinning(changes=0), "a part of what the viewer shows never came", 60),
        (Client(changes=0, blank=True), "stayed blank for 60 s", 60),
    ],
)
def test_nothing_is_waited_for_in_vain(monkeypatch, client, says, waited):
    clock = Clock(monkeypatch, step=1)
    with pytest.raises(ViewerError, match=says):
        viewer.settled_picture(client)
    assert waited <= clock.now <= waited + 5
