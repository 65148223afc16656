"""Which photos stay open: as many as fit, and the one that is shown."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from annotate.store.identity import Photo
from annotate.store.opened import BusyError
from annotate.work import open_photos
from annotate.work.open_photos import (
    KEPT,
    OPEN_AT_MOST,
    OPENING,
    SESSION,
    OpenPhotos,
    Room,
    detection_bytes,
    require_room,
)
from testing.labelling import DETECTOR, hills


def test_a_photo_is_opened_once():
    photos = OpenPhotos(Room(100))
    future, mine = photos.take(1, 10)
    assert mine
    assert photos.take(1, 10) == (future, False)
    assert photos.get(1) is future
    assert photos.get(2) is None
    photos.close(1)
    assert photos.get(1) is None


def test_the_least_recently_used_is_closed_but_never_the_shown_one():
    photos = OpenPhotos(Room(100))
    for one in (1, 2, 3):
        photos.take(one, 10)
    photos.show(1)
    photos.take(2, 10)
    photos.take(4, 10)
    assert photos.open == [1, 2, 4]
    photos.take(5, 90)  # no room but beside the shown one
    assert photos.open == [1, 5]
    photos.close_others(5)
    assert photos.open == [1, 5]
    photos.show(5)
    photos.close_others(5)
    assert photos.open == [5]


def test_what_is_kept_beside_a_photo_counts():
    photos = OpenPhotos(Room(100))
    photos.take(1, 40)
    photos.take(2, 20)
    photos.show(1)
    assert photos.fits(60)
    assert not photos.fits(61)
    assert photos.keep_beside(1, 60)
    assert (photos.open, photos.total) == ([1], 100)
    assert not photos.fits(1)
    assert not photos.keep_beside(1, 61)
    assert photos.total == 40  # and nothing is kept any more
    photos.keep_beside(1, 10)
    photos.drop_beside()
    assert photos.total == 40


def test_a_photo_takes_no_more_than_was_counted():
    photos = OpenPhotos(Room(100))
    photos.take(1, 40)
    photos.lighten(1, 50)
    assert photos.total == 40
    photos.lighten(1, 30)
    photos.lighten(2, 1)
    assert (photos.open, photos.total) == ([1], 30)


@given(
    st.lists(
        st.tuples(st.sampled_from(["take", "show", "beside"]), st.integers(1, 5)), max_size=25
    ),
    st.integers(1, 60),
)
def test_photos_never_take_more_than_there_is_but_for_the_two_in_use(steps, size):
    photos, shown, newest = OpenPhotos(Room(100)), None, None
    for what, photo in steps:
        is_open = photo in photos.open
        if what == "take":
            photos.take(photo, size)
        elif what == "show":
            photos.show(photo)
            shown = photo
        else:
            photos.keep_beside(photo, size)
        assert len(photos.open) <= OPEN_AT_MOST
        if not (what == "take" and is_open):  # which makes no room: it took its own before
            newest = photo
        assert photos.total <= 100 or set(photos.open) <= {shown, newest}


def test_a_photo_that_does_not_fit_is_not_opened(monkeypatch):
    photo = Photo(1, "large.png", "", 1000, 2000)
    monkeypatch.setattr(open_photos, "available", lambda: OPENING * 2_000_000)
    require_room(photo)
    monkeypatch.setattr(open_photos, "available", lambda: OPENING * 2_000_000 - 1)
    with pytest.raises(BusyError, match=r"large\.png has 2 megapixels and needs about"):
        require_room(photo)
    monkeypatch.setattr(open_photos, "available", lambda: None)
    require_room(photo)


def test_a_detection_takes_at_least_its_costs():
    detection = DETECTOR.detect(hills(1))
    taken = detection_bytes(detection)
    assert taken >= detection.cost.nbytes + detection.edges.nbytes
    assert taken < 20 * detection.cost.nbytes
    assert np.shares_memory(detection.photo, detection.photo)


def opened(photos, photo, size):
    future, mine = photos.take(photo, size)
    if mine:
        future.set_result(photo)
    return future


def test_people_share_the_room_and_keep_what_they_are_shown():
    room = Room(100)
    ann, bob = OpenPhotos(room), OpenPhotos(room)
    for one in (1, 2):
        opened(ann, one, 30)
    ann.show(1)
    opened(bob, 3, 30)
    bob.show(3)
    assert not bob.fits(41)
    assert bob.fits(40)
    opened(bob, 4, 30)  # ann's spare one makes room for it
    assert (ann.open, bob.open) == ([1], [3, 4])
    opened(ann, 2, 30)  # and bob's for this
    assert (ann.open, bob.open) == ([1, 2], [3])
    assert not ann.keep_beside(1, 41)
    assert ann.keep_beside(1, 40)
    assert ann.open == [1]


def test_what_others_are_just_opening_or_shown_is_not_closed_before_memory_is_short():
    room = Room(100)
    ann, bob = OpenPhotos(room), OpenPhotos(room)
    opened(ann, 1, 60)
    ann.show(1)
    ann.take(2, 60)  # not there yet
    opened(bob, 3, 60)
    assert (ann.open, bob.open) == ([1, 2], [3])
    bob.close_others(3)
    assert (ann.open, bob.open) == ([1, 2], [3])
    bob.close_others(3, shown=True)
    assert (ann.open, bob.open) == ([2], [3])


def test_a_detection_is_kept_where_everybody_s_fit():
    photo = Photo(1, "a.png", "", 10, 10)
    room = Room(2 * 100 * (SESSION + KEPT))
    first = OpenPhotos(room)
    assert first.keeps(photo)
    OpenPhotos(room)
    assert not first.keeps(photo)
