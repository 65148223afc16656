"""Pictures that are kept: within their bytes, each made once."""

import threading

import pytest
from hypothesis import given
from hypothesis import strategies as st

from annotate.work.pictures import KeptPictures, Picture


def of(data):
    return Picture(data, "image/png")


@given(st.lists(st.tuples(st.integers(1, 6), st.integers(0, 60)), max_size=60))
def test_the_last_ones_that_fit_together_are_kept(asked):
    kept = KeptPictures(100)
    model = []  # of pairs of a key and a size, the last used one last
    for key, size in asked:
        made = []
        picture = kept.get(key, lambda size=size, made=made: made.append(size) or of(bytes(size)))
        known = dict(model)
        assert made == ([] if key in known else [size])
        assert len(picture.data) == known.get(key, size)
        model = [one for one in model if one[0] != key] + [(key, known.get(key, size))]
        while sum(one for _, one in model) > 100:
            model.pop(0)
        assert kept.total == sum(one for _, one in model) <= 100


def test_what_is_larger_than_all_room_is_given_but_not_kept():
    kept = KeptPictures(10)
    assert kept.get("small", lambda: of(b"12")).data == b"12"
    assert len(kept.get("large", lambda: of(bytes(11))).data) == 11
    assert kept.total == 0


def test_a_picture_that_two_ask_for_is_made_once():
    kept, begun, go_on = KeptPictures(), threading.Event(), threading.Event()

    def slowly():
        begun.set()
        assert go_on.wait(20)
        return of(b"1")

    found = []
    first = threading.Thread(target=lambda: found.append(kept.get("one", slowly)))
    first.start()
    assert begun.wait(20)
    other = kept.get("another", lambda: of(b"2"))  # which does not wait for the first
    second = threading.Thread(target=lambda: found.append(kept.get("one", lambda: of(b"no"))))
    second.start()
    go_on.set()
    first.join()
    second.join()
    assert [one.data for one in (*found, other)] == [b"1", b"1", b"2"]
    assert found[0] is found[1]


def test_what_cannot_be_made_is_said_and_tried_again():
    kept = KeptPictures()

    def broken():
        raise OSError("no")

    for _ in range(2):
        with pytest.raises(OSError, match="no"):
            kept.get("one", broken)
    assert kept.get("one", lambda: of(b"1")).data == b"1"


@given(st.binary(max_size=20), st.binary(max_size=20))
def test_a_tag_tells_pictures_apart(one, other):
    assert (of(one).tag == of(other).tag) == (one == other)
