"""Bins: the index formula, the borders, the wrap at 180 degrees, and mirroring."""

from itertools import product
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.bins import Bins
from skyline_viz.tensor import Tensor, tensor_map
from testing.examples import examples

STEADY = examples(80)


def features(coherence, strength, orientation):
    arrays = (np.atleast_1d(np.float32(values)) for values in (coherence, strength, orientation))
    return Tensor(coherence=next(arrays), strength=next(arrays), orientation=next(arrays))


def bin_of(bins, coherence, strength, orientation):
    return int(bins.of(features(coherence, strength, orientation))[0])


def slow_bin(bins, coherence, strength, orientation):
    """The bin of one pixel, in plain Python."""

    def level(share, levels):
        return int(min(max(share, 0), 1) * (levels - 1))

    c = level(coherence / bins.coherence_top, bins.coherences)
    s = level((strength - bins.strength_offset) / bins.strength_range, bins.strengths)
    o = int(orientation / (180 / bins.orientations) + 0.5) % bins.orientations
    return (c * bins.strengths + s) * bins.orientations + o


some_bins = st.builds(
    Bins,
    coherences=st.integers(1, 5),
    strengths=st.integers(1, 8),
    orientations=st.integers(1, 20),
    coherence_top=st.sampled_from([0.5, 0.8, 1.0]),
    strength_offset=st.sampled_from([0.0, 40.0, 64.0]),
    strength_range=st.sampled_from([64.0, 180.0]),
)


def test_published_bins():
    bins = Bins()
    assert bins.shape == (3, 6, 16)
    assert bins.count == 288
    assert (bins.coherence_top, bins.strength_offset, bins.strength_range) == (0.8, 40, 180)


@STEADY
@given(some_bins, st.integers(0, 2**32 - 1))
def test_every_pixel_has_a_bin(bins, seed):
    rng = np.random.default_rng(seed)
    tensor = features(rng.random(500), rng.exponential(150, 500), rng.random(500) * 180)
    found = bins.of(tensor)
    assert found.dtype == np.int32
    assert found.shape == (500,)
    assert 0 <= found.min() <= found.max() < bins.count
    columns = zip(tensor.coherence, tensor.strength, tensor.orientation, strict=True)
    expected = [slow_bin(bins, *(float(value) for value in pixel)) for pixel in columns]
    assert np.mean(found == expected) > 0.99  # float32 moves a pixel on a border now and then


@STEADY
@given(some_bins)
def test_every_bin_can_be_reached_and_has_its_index(bins):
    for index, (c, s, o) in enumerate(product(*(range(n) for n in bins.shape))):
        coherence = (c + 0.5) / max(bins.coherences - 1, 1) * bins.coherence_top
        above = (s + 0.5) / max(bins.strengths - 1, 1) * bins.strength_range
        orientation = o * 180 / bins.orientations
        assert bin_of(bins, coherence, bins.strength_offset + above, orientation) == index


@pytest.mark.parametrize(
    ("coherence", "level"), [(0, 0), (0.39, 0), (0.41, 1), (0.79, 1), (0.81, 2), (1, 2)]
)
def test_levels_of_coherence(coherence, level):
    assert bin_of(Bins(), coherence, 0, 0) == level * 6 * 16


@pytest.mark.parametrize(
    ("strength", "level"),
    [(0, 0), (40, 0), (75, 0), (77, 1), (111, 1), (113, 2), (183, 3), (219, 4), (220, 5), (9e4, 5)],
)
def test_levels_of_strength(strength, level):
    assert bin_of(Bins(), 0, strength, 0) == level * 16


@pytest.mark.parametrize(
    ("orientation", "level"),
    [(0, 0), (5.6, 0), (5.65, 1), (11.25, 1), (90, 8), (174.3, 15), (174.4, 0), (179.9999, 0)],
)
def test_the_first_orientation_is_centred_on_the_wrap(orientation, level):
    assert bin_of(Bins(), 0, 0, orientation) == level


def test_a_single_bin():
    bins = Bins(1, 1, 1)
    assert bins.count == 1
    assert bins.of(features([0, 1, 0.5], [0, 900, 100], [0, 179, 90])).tolist() == [0, 0, 0]
    assert bins.mirrored().tolist() == [0]


def test_maps_keep_their_shape():
    photo = np.random.default_rng(0).integers(0, 256, (7, 9, 3), dtype=np.uint8)
    assert Bins().of(tensor_map(photo)).shape == (7, 9)


def test_no_pixel():
    none = np.zeros(0, np.float32)
    empty = SimpleNamespace(coherence=none, strength=none, orientation=none)
    assert Bins().of(empty).shape == (0,)


# Mirroring


@STEADY
@given(some_bins)
def test_mirroring_twice_changes_nothing(bins):
    mirrored = bins.mirrored()
    assert sorted(mirrored.tolist()) == list(range(bins.count))
    assert np.array_equal(mirrored[mirrored], np.arange(bins.count))


def test_mirroring_turns_the_orientation_alone():
    mirrored = Bins(2, 3, 4).mirrored()
    assert mirrored[:4].tolist() == [0, 3, 2, 1]
    assert np.array_equal(mirrored.reshape(6, 4) // 4, np.arange(24).reshape(6, 4) // 4)


@pytest.mark.parametrize(
    "bins", [Bins(), Bins(2, 3, 5), Bins(orientations=1), Bins(4, 10, 2, 0.6, 10, 300)], ids=repr
)
@pytest.mark.parametrize("seed", range(3))
def test_mirroring_is_what_flipping_a_photo_does(bins, seed):
    blocks = np.random.default_rng(seed).integers(0, 256, (12, 16, 3), dtype=np.uint8)
    photo = cv2.resize(blocks, (64, 48), interpolation=cv2.INTER_NEAREST)
    photo = cv2.GaussianBlur(photo, (0, 0), 0.5)
    here = bins.of(tensor_map(photo))
    there = bins.of(tensor_map(np.ascontiguousarray(photo[:, ::-1])))
    assert len(np.unique(here)) >= min(bins.count, 40) / 3
    assert np.mean(there[:, ::-1] == bins.mirrored()[here]) > 0.999


# What is refused


@pytest.mark.parametrize("name", ["coherences", "strengths", "orientations"])
@pytest.mark.parametrize("value", [0, -1, 1001, 2.5, "3", None])
def test_bad_numbers_of_bins_are_refused(name, value):
    with pytest.raises(ValueError, match=f"{name} is a number of bins from 1 to 1000, not "):
        Bins(**{name: value})


@pytest.mark.parametrize("top", [0, -0.5, 1.01, np.nan])
def test_a_bad_coherence_top_is_refused(top):
    with pytest.raises(ValueError, match="coherence_top"):
        Bins(coherence_top=top)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("strength_offset", np.nan),
        ("strength_offset", np.inf),
        ("strength_range", 0),
        ("strength_range", -1),
        ("strength_range", np.inf),
        ("strength_range", np.nan),
    ],
)
def test_a_bad_range_of_strength_is_refused(name, value):
    with pytest.raises(ValueError, match=name):
        Bins(**{name: value})
