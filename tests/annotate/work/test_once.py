"""What is made once for all who ask at the same time, and not kept."""

import gc
import threading

import pytest

from annotate.work.once import Once


class Thing:
    """Something that can be let go."""


def test_a_thing_is_shared_while_somebody_has_it():
    once = Once()
    one = once.get("a", Thing)
    assert once.get("a", Thing) is one
    assert once.get("b", Thing) is not one
    del one
    gc.collect()
    made = []
    once.get("a", lambda: made.append(1) or Thing())
    assert made == [1]


def test_two_who_ask_at_the_same_time_get_the_same():
    once, begun, go_on, found = Once(), threading.Event(), threading.Event(), []

    def slowly():
        begun.set()
        assert go_on.wait(20)
        return Thing()

    threads = [
        threading.Thread(target=lambda: found.append(once.get("a", slowly))) for _ in range(4)
    ]
    threads[0].start()
    assert begun.wait(20)
    other = once.get("b", Thing)  # which does not wait
    for thread in threads[1:]:
        thread.start()
    go_on.set()
    for thread in threads:
        thread.join()
    assert len(set(map(id, found))) == 1
    assert other is not found[0]


def test_what_cannot_be_made_is_said_and_tried_again():
    once = Once()

    def broken():
        raise OSError("no")

    for _ in range(2):
        with pytest.raises(OSError, match="no"):
            once.get("a", broken)
    assert isinstance(once.get("a", Thing), Thing)
