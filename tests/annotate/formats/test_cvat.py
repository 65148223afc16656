"""CVAT: points, and XML that is made to do harm."""

import pytest

from testing.exports import put, refused


@pytest.fixture
def photos(tmp_path):
    put(tmp_path / "photos", "a.png")
    return tmp_path / "photos"


@pytest.mark.parametrize("number", ["nan", "inf", "-inf", "1e999", "1e300", "-5000", "x", ""])
def test_points_that_are_no_place_in_a_photo(tmp_path, photos, number):
    def content(whole):
        return whole.replace(b'points="0.50,4.00', f'points="0.50,{number}'.encode())

    refused(tmp_path, photos, "cvat", content)


def test_entities_are_refused_before_they_are_expanded(tmp_path, photos):
    bomb = b'<!DOCTYPE a [<!ENTITY b "bb"><!ENTITY c "&b;&b;">]><annotations>&c;</annotations>'
    for content in (bomb, bomb.decode().encode("utf-16")):
        refused(tmp_path, photos, "cvat", content)
