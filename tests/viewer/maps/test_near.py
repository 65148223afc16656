"""What a full recording keeps of a large photo: all that is near its lines, and says so."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.rendering import render
from skyline_viz.stage import Quantity
from skyline_viz.tensor import tensor_map
from skyline_viz.viewer import entities, recording
from skyline_viz.viewer.maps import near
from skyline_viz.viewer.maps.near import BLOCK, Near
from skyline_viz.viewer.maps.stage_maps import places_of
from skyline_viz.viewer.maps.value_maps import COARSE, FINE
from testing.examples import examples
from testing.recordings import Read

SCENE = render("clear", 1, 180, 120)


@st.composite
def photos(draw):
    """Height, width, one or two lines, and how many pixels are kept."""
    height, width = draw(st.integers(8, 60)), draw(st.integers(8, 60))
    rows = st.lists(st.floats(0, height - 1, width=32), min_size=width, max_size=width)
    lines = [sv.Skyline(np.array(draw(rows), np.float32)) for _ in range(draw(st.integers(1, 2)))]
    return height, width, lines, draw(st.integers(1, 2000))


@examples(60)
@given(photos())
def test_near_pixels_lie_around_the_lines_and_are_as_many_as_may_be(photo):
    height, width, lines, most = photo
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(near, "NEAR_PIXELS", most)
        found = Near.to((height, width), *lines, None)
    away = np.min([np.abs(np.arange(height)[:, None] - one.rows[None]) for one in lines], axis=0)
    assert (found.mask[away <= found.around - 1]).all()
    assert not found.mask[away > found.around + 1].any()
    np.testing.assert_array_equal(np.nonzero(found.mask), [found.rows, found.columns])
    assert found.mask.sum() <= max(most, 2 * width * len(lines)) + width * len(lines)


@examples(60)
@given(photos(), st.sampled_from([COARSE, FINE]), st.integers(0, 99))
def test_every_pixel_shows_its_own_value_or_that_of_its_block(photo, levels, seed):
    height, width, lines, most = photo
    chance = np.random.default_rng(seed)
    values = chance.random((height, width)).astype(np.float32)
    values[chance.random((height, width)) < 0.1] = np.nan
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(near, "NEAR_PIXELS", most)
        kept = Near.to((height, width), *lines)
    sampled = kept.sample(places_of(values))
    made = kept.map(Quantity("x", low=0.0, high=1.0), sampled, levels)
    middle = [
        np.minimum(np.arange(length) // BLOCK * BLOCK + BLOCK // 2, length - 1)
        for length in (height, width)
    ]
    wanted = np.where(kept.mask, values, values[np.ix_(*middle)])
    np.testing.assert_allclose(made.values(), wanted, atol=0.51 / (levels - 1))
    np.testing.assert_array_equal(sampled.exact, values[kept.mask])


@pytest.fixture
def large(monkeypatch):
    """A scene that counts as large."""
    monkeypatch.setattr(recording, "FULL_MEGAPIXELS", 0.001)
    monkeypatch.setattr(near, "NEAR_PIXELS", 180 * 20)
    return sv.Detector().detect(SCENE.photo)


def test_what_is_looked_at_is_exact_and_the_report_says_what_is_not(large, tmp_path):
    with sv.new_recording(tmp_path / "one.rrd", "one") as stream:
        sv.log_detection(stream, large)
    file = Read(tmp_path / "one.rrd")
    mask = Near.to((120, 180), large.skyline).mask
    tensor = tensor_map(SCENE.photo)
    for entity, values in (
        (entities.STRENGTH, tensor.strength),
        (entities.ORIENTATION, tensor.orientation),
        (entities.COST, large.cost),
        (entities.DETOUR, large.uncertainty().detour),
    ):
        exact = np.array(file.last(entity, "exact").as_py(), np.float32)
        np.testing.assert_allclose(exact, values[mask], rtol=1e-3, atol=1e-4)
    said = str(file.last(entities.REPORT, "text"))
    assert (
        "Maps hold every pixel within 10 rows of a line, and elsewhere one of each 8 by 8" in said
    )
    whole = tmp_path / "whole.rrd"
    with sv.new_recording(whole, "one") as stream:
        sv.log_detection(stream, large, fidelity="exact")
    exact = np.array(Read(whole).last(entities.COST, "exact").as_py(), np.float32)
    np.testing.assert_array_equal(exact, large.cost.ravel())
    assert "elsewhere" not in str(Read(whole).last(entities.REPORT, "text"))
