"""The block model of sky and terrain: its features, its sums and its verdict."""

import numpy as np
import pytest

from skyline_viz.skyline import Skyline
from skyline_viz.terrain import (
    BLOCK,
    FEATURES,
    block_features,
    solve_terrain,
    terrain_above,
    terrain_sums,
)

BRIGHTNESS = 4


def plain(height=80, width=120, colour=(90, 120, 210)):
    return np.full((height, width, 3), colour, np.uint8)


def scene(row=48, height=80, width=120):
    """Blue sky over brown terrain, the edge between them, and the truth."""
    photo = plain(height, width)
    photo[row:] = (90, 80, 60)
    edges = np.zeros((height, width), bool)
    edges[row] = True
    return photo, edges, Skyline(np.full(width, row))


def weights(*, constant=0.0, brightness=0.0):
    found = np.zeros(FEATURES, np.float32)
    found[[0, BRIGHTNESS]] = constant, brightness
    return found


def test_features_of_a_plain_photo():
    features = block_features(plain(), np.zeros((80, 120), bool))
    assert features.shape == (10, 15, FEATURES)
    assert features.dtype == np.float32
    red, green, blue = 90 / 255, 120 / 255, 210 / 255
    brightness = (red + green + blue) / 3
    expected = [1, 0, 0, 0, brightness, brightness**2, blue - red, blue - red]
    expected += [green - (red + blue) / 2, blue - red, 0, 0]
    assert np.allclose(features, expected, atol=1e-5)


def test_edge_density_here_and_around():
    edges = np.zeros((200, 240), bool)
    edges[96:104, 120:128] = True  # one whole block
    features = block_features(plain(200, 240), edges)
    here, near, far = features[..., 1], features[..., 2], features[..., 3]
    assert here[12, 15] == 1
    assert (here > 0).sum() == 1
    assert (near > 0).sum() == 25
    assert near[12, 15] == pytest.approx(np.sqrt(1 / 25), rel=1e-3)
    assert (far > 0).sum() == 225
    assert far[12, 15] == pytest.approx(np.sqrt(1 / 225), rel=1e-3)


def test_difference_from_the_top_of_the_photo():
    photo, edges, _ = scene()
    features = block_features(photo, edges)
    assert np.allclose(features[:6, :, 10:], 0, atol=1e-6)
    change = (np.array([90, 80, 60]) - (90, 120, 210)) / 255
    assert np.allclose(features[6:, :, 10], np.linalg.norm(change), atol=1e-5)
    assert np.allclose(features[6:, :, 11], change.mean(), atol=1e-5)


def test_terrain_is_summed_down_the_columns():
    edges = np.zeros((80, 120), bool)
    above = terrain_above(plain(), edges, weights(constant=0.5))
    assert above.dtype == np.float32
    assert above.shape[1] == 15
    assert np.allclose(above, above[:, :1])
    assert (above[1] > above[0]).all()
    # half of the height above the middle of the last block, which is half a block up
    assert above[-1, 0] == pytest.approx(0.5 * (80 - BLOCK / 2) / 80, abs=0.01)
    assert above[0, 0] == pytest.approx(0.5 * BLOCK / 2 / 80, abs=0.01)


def test_the_verdict_is_clipped():
    edges = np.zeros((80, 120), bool)
    sure = terrain_above(plain(), edges, weights(constant=1))
    assert np.array_equal(terrain_above(plain(), edges, weights(constant=50)), sure)
    assert np.array_equal(terrain_above(plain(), edges, weights(constant=-50)), -sure)
    assert not terrain_above(plain(), edges, weights()).any()


def test_sky_above_terrain_is_cheapest_at_the_skyline():
    photo, edges, _ = scene(row=48)
    above = terrain_above(photo, edges, weights(constant=20, brightness=-50))
    cheapest = above.argmin(axis=0)
    assert set(cheapest.tolist()) <= {5, 6}
    assert (above[:5] < 0).all()


@pytest.mark.parametrize("shape", [(2, 2), (3, 50), (50, 3), (7, 9), (8, 8), (15, 17)])
def test_photos_below_and_between_whole_blocks(shape):
    photo = np.random.default_rng(0).integers(0, 256, (*shape, 3), dtype=np.uint8)
    edges = np.random.default_rng(1).random(shape) < 0.2
    truth = Skyline(np.full(shape[1], shape[0] // 2))
    features = block_features(photo, edges)
    assert np.isfinite(features).all()
    assert terrain_above(photo, edges, weights(constant=1)).shape == features.shape[:2]
    assert np.isfinite(terrain_sums(photo, edges, truth)).all()


# Learning


def test_sums_are_those_of_the_photo_and_its_grey_twin():
    photo, edges, truth = scene(row=48)
    sums = terrain_sums(photo, edges, truth)
    assert sums.shape == (FEATURES + 1, FEATURES + 1)
    assert sums.dtype == np.float64
    assert np.allclose(sums, sums.T)
    blocks = 10 * 15
    assert sums[0, 0] == 2 * blocks
    assert sums[-1, -1] == pytest.approx(2 * blocks)  # every target is 1 or -1
    assert sums[0, -1] == pytest.approx(2 * (60 - 90))  # 4 rows of terrain, 6 of sky
    blue_minus_red = 6
    expected = 90 * (210 - 90) / 255 + 60 * (60 - 90) / 255  # of the colour photo alone
    assert sums[0, blue_minus_red] == pytest.approx(expected, rel=1e-3)


def test_blocks_on_the_line_are_in_between():
    photo, edges, truth = scene(row=44)
    sums = terrain_sums(photo, edges, truth)
    assert sums[-1, -1] == pytest.approx(2 * 9 * 15, abs=0.5)
    assert sums[0, -1] == pytest.approx(2 * (4 - 5) * 15, abs=0.5)


def test_invisible_columns_teach_nothing():
    photo, edges, truth = scene()
    visible = np.ones(truth.width, bool)
    visible[:40] = False
    hidden = Skyline(truth.rows, visible)
    sums = terrain_sums(photo, edges, hidden)
    assert sums[0, 0] == 2 * 10 * 10
    changed = photo.copy()
    changed[:, :40] = 255
    # the top of the photo is a feature of every block, so only changes below it are invisible
    changed[: 2 * BLOCK] = photo[: 2 * BLOCK]
    assert np.allclose(terrain_sums(changed, edges, hidden), sums)
    nothing = Skyline(truth.rows, np.zeros(truth.width, bool))
    assert not terrain_sums(photo, edges, nothing).any()


def test_the_model_learns_to_tell_sky_from_terrain():
    sums = sum(terrain_sums(*scene(row)) for row in (24, 40, 48, 64))
    learned = solve_terrain(sums)
    assert learned.shape == (FEATURES,)
    assert learned.dtype == np.float32
    photo, edges, _ = scene(row=56)
    verdict = block_features(photo, edges) @ learned
    assert verdict[:6].max() < -0.5
    assert verdict[8:].min() > 0.5
    grey = np.repeat(photo.mean(axis=2, keepdims=True), 3, axis=2).astype(np.uint8)
    verdict = block_features(grey, edges) @ learned
    assert verdict[:6].max() < 0 < verdict[8:].min()


def test_solving_is_lightly_regularised_least_squares():
    rng = np.random.default_rng(0)
    samples = rng.normal(size=(500, FEATURES + 1))
    sums = samples.T @ samples
    expected = np.linalg.solve(sums[:-1, :-1] + np.eye(FEATURES), sums[:-1, -1])
    assert np.allclose(solve_terrain(sums), expected, atol=1e-6)
    assert not solve_terrain(np.zeros((FEATURES + 1, FEATURES + 1))).any()
