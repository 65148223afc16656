"""A label that cannot be read is a sentence that names it."""

import zlib

import pytest

from annotate.store.history import LogError
from annotate.store.lines import LineError
from annotate.store.readable import named, reading_label
from annotate.store.store import Store
from skyline_viz.method import MethodError
from testing.labelling import write_hills


@pytest.fixture
def store(tmp_path):
    store = Store(write_hills(tmp_path, count=1))
    store.find()
    store.begin(1, "ann", 2)
    yield store
    store.close()


@pytest.mark.parametrize(
    ("error", "reason"),
    [
        (LogError("operation 3 of the log is unknown."), "operation 3 of the log is unknown."),
        (LineError("its line\x1b[2J is odd"), r"its line\x1b[2J is odd."),
        (MethodError("its weights is missing"), "what proposed for it is damaged."),
        (KeyError("kind"), "it is damaged."),
        (zlib.error("-3"), "it is damaged."),
        (RecursionError(), "it is damaged."),
    ],
)
def test_what_is_wrong_is_one_sentence(store, error, reason):
    with pytest.raises(LogError) as caught, reading_label(store._connection, 1):
        raise error
    assert str(caught.value) == (
        f"the label of hill-0.png by ann, pass 2, cannot be read: {reason}"
    )


def test_a_fault_of_the_disk_or_an_interrupt_is_none_of_the_label(store):
    for error in (OSError(5, "Input/output error"), KeyboardInterrupt()):
        with pytest.raises(type(error)), reading_label(store._connection, 1):
            raise error


def test_a_label_that_nobody_knows_has_no_name(store):
    assert named(store._connection, 99) == "the label of None by None, pass None,"
