"""Random fields of the renderer: the same from one generator, and of the range they promise."""

import numpy as np
import pytest

from skyline_viz.rendering.noise import Noise

X = np.linspace(0, 300, 120, dtype=np.float32)[None, :]
Y = np.linspace(0, 200, 80, dtype=np.float32)[:, None]


def noise(seed=3):
    return Noise(np.random.default_rng(seed))


def test_one_generator_makes_one_sequence_of_fields():
    one, same = noise(), noise()
    first = one.smooth(X, Y, 20)
    np.testing.assert_array_equal(first, same.smooth(X, Y, 20))
    assert np.abs(first - one.smooth(X, Y, 20)).max() > 0.3  # each call is another field
    assert np.abs(first - noise(4).smooth(X, Y, 20)).max() > 0.3


def test_rows_and_columns_that_broadcast_give_what_whole_arrays_give():
    x, y = np.broadcast_arrays(X, Y)
    np.testing.assert_allclose(
        noise().smooth(X, Y, 17), noise().smooth(x.copy(), y.copy(), 17), atol=1e-5
    )


def test_bumps_are_as_wide_as_was_asked_for():
    def steepness(size):
        return np.abs(np.diff(noise().smooth(X, Y, size), axis=1)).mean()

    assert steepness(15) > 2 * steepness(60)


@pytest.mark.parametrize(
    ("kind", "low", "high"), [("fractal", -1.6, 1.6), ("ridged", 0, 1), ("billows", 0, 2.2)]
)
def test_fractals_stay_in_their_range_and_have_finer_detail(kind, low, high):
    fine = getattr(noise(), kind)(X, Y, 60, 4)
    coarse = getattr(noise(), kind)(X, Y, 60, 50)
    assert low <= fine.min() < fine.max() <= high
    rough = [np.abs(np.diff(field, n=2, axis=1)).mean() for field in (fine, coarse)]
    assert rough[0] > 1.5 * rough[1]


def test_gullies_run_down_the_slope():
    level, falling = np.zeros((80, 120), np.float32), np.ones((80, 120), np.float32)
    waves = noise().gullies(X, Y, (level, falling), 12)
    assert np.abs(waves).max() <= 1.05
    across, along = (np.abs(np.diff(waves, axis=axis)).mean() for axis in (1, 0))
    assert across > along  # down the slope, which is along the columns of the grid, less changes


def test_mounds_lie_apart_and_there_are_more_of_them_where_more_are_asked_for():
    few, chance = noise().mounds(X, Y, 20, 0.1)
    many, _ = noise().mounds(X, Y, 20, 0.9)
    assert few.min() == 0
    assert few.max() <= 1
    assert (few > 0).mean() < 0.5 * (many > 0).mean()
    assert (chance[few == 0] == 0).all()
    assert chance.max() <= 1


def test_a_cell_has_one_number():
    numbers = noise().cells(X, Y, 50)
    assert 20 < len(np.unique(numbers)) < 80
    assert numbers.min() >= 0
    assert numbers.max() < 1
    assert np.mean(numbers[:, 1:] == numbers[:, :-1]) > 0.9
