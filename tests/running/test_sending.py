"""What is sent to other processes: as it was, or a sentence that names what cannot be."""

import pickle
from functools import partial
from threading import Lock
from types import SimpleNamespace

import pytest

from skyline_viz.datasets.item import LoadedItem
from skyline_viz.evaluation.tasks import PhotoTask, compare_photo
from skyline_viz.methods.finding.plugins import as_method
from skyline_viz.rendering import render
from skyline_viz.running.sending import Unsendable, packed, unpacked

SCENE = render("clear", 3, 80, 60)
ITEM = LoadedItem("photo", SCENE.photo, SCENE.truth)


class Locked:
    def __init__(self):
        self.lock = Lock()

    def detect(self, photo):
        raise AssertionError


def local():
    class Inside:
        def detect(self, photo):
            raise AssertionError

    return Inside()


def test_what_can_be_sent_comes_as_it_was():
    function, name = unpacked(packed((compare_photo, "a"), "a"))
    assert (function, name) == (compare_photo, "a")


@pytest.mark.parametrize(
    ("work", "named"),
    [
        ((compare_photo, PhotoTask(ITEM, as_method(Locked()))), "Locked"),
        ((partial(compare_photo, [local()]), ITEM), "Inside"),
        ((compare_photo, PhotoTask(SimpleNamespace(photo=Lock()), None)), "SimpleNamespace"),
        ((lambda task: task, ITEM), "<lambda>"),
    ],
    ids=["method", "class inside of a function", "item", "function"],
)
def test_what_cannot_be_sent_is_named(work, named):
    with pytest.raises(Unsendable) as caught:
        packed(work, "photo")
    said = str(caught.value)
    assert said.startswith(f"{named} cannot be sent to other processes")
    assert said.endswith("use --workers 1.")


def test_what_is_not_found_over_there_is_named(monkeypatch):
    sent = packed(Locked, "x")
    monkeypatch.delattr(f"{__name__}.Locked")
    with pytest.raises(Unsendable, match=r"^Locked cannot be sent.*--workers 1\.$"):
        unpacked(sent)


def test_errors_of_sending_are_sent_themselves():
    assert str(pickle.loads(pickle.dumps(Unsendable("said.")))) == "said."
