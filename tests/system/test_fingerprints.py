"""Fingerprints: copies are known again, other photos are not."""

import cv2
import numpy as np
import pytest

from skyline_viz.rendering import render
from skyline_viz.system.fingerprints import (
    clip_of,
    fingerprint,
    known_as,
    near_groups,
    packed,
    telling,
    unpacked,
)


@pytest.fixture(scope="module")
def photos():
    kinds = ("clear", "hazy", "snow", "spires", "foreground")
    return [render(kind, 4, 480, 320).photo for kind in kinds]


def smaller(photo):
    small = cv2.resize(photo[..., ::-1], None, fx=0.4, fy=0.4, interpolation=cv2.INTER_AREA)
    _, packed = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, 60])
    return np.ascontiguousarray(cv2.imdecode(packed, cv2.IMREAD_COLOR)[..., ::-1])


def test_copies_are_known_again_and_other_photos_are_not(photos):
    learned = [fingerprint(one) for one in photos]
    for place, photo in enumerate(photos):
        assert known_as(fingerprint(photo), learned) == "exact"
        assert known_as(fingerprint(smaller(photo)), learned) == "near"
        others = learned[:place] + learned[place + 1 :]
        assert known_as(fingerprint(photo), others) == ""


def test_copies_are_a_group(photos):
    prints = [fingerprint(one) for photo in photos for one in (photo, smaller(photo))]
    assert near_groups(prints) == [place - place % 2 for place in range(len(prints))]


def test_files_keep_each_once_and_give_them_back(photos):
    prints = [fingerprint(one, "clip1-2") for one in photos]
    assert unpacked(packed([*prints, *prints])) == tuple(sorted(prints))
    assert unpacked(packed([])) == ()
    for other in ("a", "a" * 95, "?" * 96, 4, None, packed(prints)[:-4]):
        with pytest.raises(ValueError, match=r"\w"):
            unpacked(other)


def test_frames_of_a_clip_are_known_by_names_and_size(photos):
    one, other = photos[:2]
    learned = [fingerprint(one, "day/clip7-001.png")]
    assert known_as(fingerprint(other, "elsewhere/clip7-9"), learned) == "clip"
    assert known_as(fingerprint(other[:-1], "clip7-002"), learned) == ""
    assert known_as(fingerprint(other, "clip8-001"), learned) == ""
    assert known_as(fingerprint(other), learned) == ""
    assert clip_of("IMG_2195.JPG") == clip_of("R_GImag0001") == clip_of("clip7-") == ""
    assert len(fingerprint(one, "clip\udcfc1-2")) == len(learned[0])


def test_a_name_that_all_have_tells_of_no_clip(photos):
    prints = [fingerprint(one, f"set2_{place}") for place, one in enumerate(photos)]
    assert near_groups(prints) == [*range(len(photos))]
    two = [*prints, fingerprint(photos[0][:, ::-1].copy(), "set3_1")]
    assert near_groups(two) == [0] * len(photos) + [len(photos)]
    assert telling(two) == tuple(two)
