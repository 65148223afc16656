"""Pictures of a report: how large they are, and that no line is lost when they are made smaller."""

import base64
import io

import numpy as np
import pytest
from PIL import Image

from skyline_viz.reports.pictures import (
    encoded,
    photo_picture,
    reduced_size,
    stage_pictures,
)
from testing import detections
from testing.detections import random_photo


def opened(picture):
    kind, data = picture.address.split(",", 1)
    assert kind == "data:image/webp;base64"
    found = Image.open(io.BytesIO(base64.b64decode(data)))
    assert found.size == (picture.width, picture.height)
    return np.asarray(found.convert("RGB")), len(data) * 3 / 4


def test_a_picture_is_as_large_as_it_is_looked_at():
    pixels, _ = opened(photo_picture(random_photo(300, 400), 200, 100_000))
    assert pixels.shape == (150, 200, 3)
    assert reduced_size(2, 9000, 100) == (1, 100)


@pytest.mark.parametrize("most", [60_000, 15_000, 3_000])
def test_whatever_a_photo_shows_it_keeps_within_its_bytes(most):
    _, size = opened(encoded(random_photo(300, 400), most))
    assert size <= most + 3


def test_the_stages_are_those_of_figure_1_and_what_we_add(hazy):
    titles = [one.title for one in hazy.stages]
    assert titles[0] == "Edges"
    assert any(title.startswith("Score and strength") for title in titles)
    assert any(title.startswith("Nodal cost") for title in titles)
    assert [bool(one.scale) for one in hazy.stages] == [False, *[True] * (len(titles) - 1)]


def test_a_level_line_is_there_in_every_column_of_every_stage():
    detection = detections.flat()
    for stage in stage_pictures(detection, 100, 1_000_000):
        pixels, _ = opened(stage.picture)
        assert pixels.shape == (40, 100, 3)
        bright = pixels.astype(int).sum(axis=2)
        there = bright[18:22].max(axis=0)
        elsewhere = np.delete(bright, range(16, 24), axis=0).max(axis=0)
        assert (there > elsewhere + 20).all(), stage.title
