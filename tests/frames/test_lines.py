"""Lines of pixels: their colour, and the shares of pixels that differ."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.frames.lines import away, colour_of, constant, differ, lighter
from testing.examples import examples
from testing.scenes import noise

STEADY = examples(40)
SEEDS = st.integers(0, 2**16)
EVERY = st.integers(1, 7)
LIMITS = st.integers(0, 255)


def largest(difference):
    return np.abs(difference).max(axis=-1)


@STEADY
@given(SEEDS, st.integers(1, 50), EVERY, LIMITS)
def test_shares_are_those_of_every_so_many_pixels(seed, length, every, limit):
    lines = noise(2, length, seed)
    line, other = lines.astype(int)[:, ::every]
    colour = colour_of(lines[0], every)
    assert colour.tolist() == line.mean(axis=0).astype(int).tolist()
    assert away(lines[0], every, colour, limit) == (largest(line - colour) > limit).mean()
    assert differ(lines[0], lines[1], every, limit) == (largest(line - other) > limit).mean()
    change = other - line
    up, down = (change.max(axis=1) > limit), (change.min(axis=1) < -limit)
    assert lighter(lines[0], lines[1], every, limit) == pytest.approx(up.mean() - down.mean())


@STEADY
@given(SEEDS, st.integers(0, 12), st.integers(1, 12), EVERY)
def test_lines_of_one_colour_end_at_the_first_other_one(seed, same, others, every):
    lines = noise(same + others, 40, seed)
    lines[:same] = colour = np.array([255, 0, 255], np.uint8)
    found = constant(lines, every, colour.astype(np.int16), 24, 0.5)
    assert found == (same, 0.0)


def test_other_colours_within_are_counted():
    lines = np.zeros((10, 20, 3), np.uint8)
    lines[4:6, :5] = 255
    black = np.zeros(3, np.int16)
    assert constant(lines, 1, black, 24, 0.25) == (10, pytest.approx(0.05))
    assert constant(lines, 1, black, 24, 0.2) == (4, 0.0)


def test_views_are_read_like_copies():
    lines = noise(30, 20).transpose(1, 0, 2)[::-1]
    assert not lines.flags.c_contiguous
    copy = np.ascontiguousarray(lines)
    assert differ(lines[0], lines[1], 1, 30) == differ(copy[0], copy[1], 1, 30)
    assert colour_of(lines[3], 2).tolist() == colour_of(copy[3], 2).tolist()
