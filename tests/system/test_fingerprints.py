"""Fingerprints: copies are known again, other photos are not."""

import cv2
import numpy as np
import pytest

from skyline_viz.rendering import render
from skyline_viz.system.fingerprints import fingerprint, is_fingerprint, known_as, near_groups


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


def test_only_fingerprints_are_taken_for_such(photos):
    assert is_fingerprint(fingerprint(photos[0]))
    for other in ("", "a" * 95, "g" * 96, 4, None):
        assert not is_fingerprint(other)
