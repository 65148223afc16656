"""Scores of all pixels: patches, samples, and the best of each column."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from skyline_viz.edges import find_edges
from skyline_viz.methods.dense_scores import normalised
from skyline_viz.methods.registry import make_method
from skyline_viz.methods.score_images import BAND, best_of_columns, draw_samples, patches
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline

SCENE = render("clear", 7, 150, 90)


@pytest.fixture(scope="module")
def trained(items):
    return make_method("svm-dcsi").fit(items, seed=3)


def found(trained, name, **settings):
    return replace(make_method(name).sharing(trained), **settings).detect(SCENE.photo)


def test_a_patch_is_what_lies_around_its_pixel():
    image = np.arange(40 * 50).reshape(40, 50)
    np.testing.assert_array_equal(
        patches(image, np.array([20]), np.array([30]))[0], image[12:28, 22:38]
    )


def test_normalising_takes_light_and_contrast_away():
    patch = np.random.default_rng(1).normal(0, 50, (1, 16, 16)).astype(np.float32)
    np.testing.assert_allclose(normalised(patch), normalised(1.5 * patch + 9), atol=0.01)
    grain = np.random.default_rng(1).normal(0, 0.1, (1, 16, 16)).astype(np.float32)
    assert np.abs(normalised(grain)).max() < 0.2


def test_samples_are_the_line_and_pixels_off_it():
    rows, columns, on_line = draw_samples(SCENE.photo, SCENE.truth, 0)
    line = SCENE.truth.pixel_rows(90)
    np.testing.assert_array_equal(rows[on_line], line[columns[on_line]])
    assert on_line.sum() == 150
    off = np.abs(rows - line[columns])[~on_line]
    assert off.min() > BAND
    edges = find_edges(SCENE.photo, "grey", 50, 220)
    hard = edges & (np.abs(np.arange(90)[:, None] - line) > BAND)
    drawn_hard = hard[rows, columns][~on_line].sum()
    assert drawn_hard >= min(hard.sum(), 150)


def test_hidden_columns_teach_nothing():
    visible = np.arange(150) < 70
    _, columns, _ = draw_samples(SCENE.photo, Skyline(SCENE.truth.rows, visible), 0)
    assert columns.max() < 70


def test_m_best_of_each_column(trained):
    detection = found(trained, "svm-mdcsi", best=7)
    dense = trained.dense_score(SCENE.photo)
    order = np.sort(dense, axis=0)
    for column in range(150):
        kept = detection.edges[:, column]
        assert kept.sum() >= 7
        assert dense[kept, column].min() == order[-7, column]
    np.testing.assert_array_equal(detection.cost, np.where(detection.edges, 1 - dense, 3))


def test_more_than_all_are_all():
    assert best_of_columns(np.eye(3, dtype=np.float32), 5).all()


def test_a_truth_that_does_not_fit():
    misfit = SimpleNamespace(photo=lambda: SCENE.photo, truth=lambda: Skyline(rows=[4, 5, 6]))
    with pytest.raises(ValueError, match="3 columns, the photo 150"):
        make_method("svm-dcsi").fit([misfit])
