"""Pictures of a filter bank: a cell a bin, in its colours, and what each stands for."""

import re

import numpy as np
import pytest

from skyline_viz.bins import Bins
from skyline_viz.filter_bank import STARVED_SAMPLES, FilterBank
from skyline_viz.viewer.bank_pictures import cell_box, draw_bank

BINS = Bins(2, 3, 4, 0.7, 10, 99)


def bank(samples):
    filters = np.zeros((BINS.count, 3, 3), np.float32)
    filters[:, 0], filters[:, 2] = 1, -1
    filters[-1] = 0
    return FilterBank(filters, np.array(samples), bins=BINS)


def test_cells_lie_apart_in_the_order_of_the_bins():
    cells = draw_bank(bank([500] * BINS.count)).cells
    assert set(np.unique(cells)) == set(range(BINS.count + 1))
    for index in range(BINS.count):
        left, top, right, bottom = cell_box(index, BINS)
        rows, columns = np.nonzero(cells == index + 1)
        assert (columns.min(), rows.min()) == (left, top)
        assert (columns.max(), rows.max()) == (right - 1, bottom - 1)
    assert cell_box(4, BINS)[0] == cell_box(0, BINS)[0]  # the next row


def test_a_filter_is_red_where_it_is_positive_and_blue_where_it_is_negative():
    pictures = draw_bank(bank([500] * BINS.count))
    left, top, right, bottom = cell_box(0, BINS)
    upper, lower = pictures.filters[top + 3, right - 3], pictures.filters[bottom - 3, right - 3]
    assert upper[0] > upper[2] + 50
    assert lower[2] > lower[0] + 50
    left, top, right, bottom = cell_box(BINS.count - 1, BINS)
    empty = pictures.filters[top:bottom, left:right]
    assert (empty > 240).all()  # a filter of zeros is white


def test_starved_bins_have_a_corner_and_others_none():
    samples = [500] * BINS.count
    samples[1] = STARVED_SAMPLES - 1
    pictures = draw_bank(bank(samples))
    for picture in (pictures.filters, pictures.samples):
        marked = []
        for index in range(BINS.count):
            left, top, _, _ = cell_box(index, BINS)
            marked.append(picture[top + 1, left + 1].tolist() == [230, 150, 0])
        assert np.flatnonzero(marked).tolist() == [1]


def test_more_samples_are_brighter():
    pictures = draw_bank(bank([10 ** (1 + index % 4) for index in range(BINS.count)]))
    light = []
    for index in range(4):
        left, _, right, bottom = cell_box(index, BINS)
        light.append(int(pictures.samples[bottom - 2, left + 1 : right].sum()))
    assert light == sorted(light)


@pytest.mark.parametrize("bins", [BINS, Bins()])
def test_words_say_which_tensors_fall_into_a_bin(bins):
    from skyline_viz.tensor import Tensor  # noqa: PLC0415

    random = np.random.default_rng(0)
    strength = random.uniform(0, 250, 60).astype(np.float32)
    coherence = random.uniform(0, 1, 60).astype(np.float32)
    orientation = random.uniform(0, 180, 60).astype(np.float32)
    found = bins.of(Tensor(strength, coherence, orientation))
    number = r"(-?[\d.]+)"
    for place, index in enumerate(found.tolist()):
        words = bins.label(index)
        for name, value in (("coherence", coherence), ("strength", strength)):
            if between := re.search(rf"{name} {number} to {number}", words):
                low, high = map(float, between.groups())
                assert low - 0.6 <= value[place] <= high + 0.6
            elif above := re.search(rf"{name} {number} and more", words):
                assert value[place] >= float(above[1]) - 0.6
            else:
                assert f"{name} any" in words
        first, last = map(float, re.search(rf"orientation {number} to {number}°", words).groups())
        around = (orientation[place] - first + 0.6) % 180  # the words are whole degrees
        assert around <= (last - first) % 180 + 1.2
