"""Lines of pixels: their colour, and the shares of pixels that differ."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.frames.lines import away, border, colour_of, constant, differ, end, lighter
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
@given(SEEDS, st.integers(1, 12), st.integers(1, 12), EVERY)
def test_lines_of_one_colour_end_at_the_first_other_one(seed, same, others, every):
    lines = noise(same + others, 40, seed)
    lines[:same] = colour = [255, 0, 255]
    found, width, stray = constant(lines, every, 24, 0.02, 0.5)
    assert (found.tolist(), width, stray) == (colour, same, 0.0)


def test_other_colours_within_are_counted():
    lines = np.zeros((10, 20, 3), np.uint8)
    lines[4:6, :5] = 255
    assert constant(lines, 1, 24, 0.02, 0.25)[1:] == (10, pytest.approx(0.05))
    assert constant(lines, 1, 24, 0.02, 0.2)[1:] == (4, 0.0)


def test_lines_of_one_colour_begin_with_one_of_few_others():
    lines = np.zeros((10, 20, 3), np.uint8)
    lines[0, :2] = 50
    assert constant(lines, 1, 24, 0.02, 0.5)[1:] == (0, 0.0)
    assert constant(lines, 1, 24, 0.2, 0.5)[1:] == (10, pytest.approx(0.01))


@STEADY
@given(SEEDS, EVERY, LIMITS)
def test_an_end_is_where_lines_differ_and_the_last_is_of_one_colour(seed, every, limit):
    last, first = noise(2, 40, seed)
    colour = colour_of(first, every)
    found = end(last, first, every, 30, colour, limit)
    assert found == (differ(last, first, every, 30), away(last, every, colour, limit))


@STEADY
@given(st.integers(0, 8), st.integers(1, 8), st.booleans())
def test_a_border_ends_where_all_gets_lighter_or_darker(wide, widest, dark):
    lines = np.full((9, 30, 3), 120, np.uint8)
    lines[:wide] = 40 if dark else 200
    assert border(lines, widest, 2, 12, 0.5) == (wide if wide <= widest else 0)


def test_views_are_read_like_copies():
    lines = noise(30, 20).transpose(1, 0, 2)[::-1]
    assert not lines.flags.c_contiguous
    copy = np.ascontiguousarray(lines)
    assert differ(lines[0], lines[1], 1, 30) == differ(copy[0], copy[1], 1, 30)
    assert colour_of(lines[3], 2).tolist() == colour_of(copy[3], 2).tolist()
