"""SIFT and HOG descriptors around pixels."""

import cv2
import numpy as np
import pytest

from skyline_viz.edges import to_grey
from skyline_viz.methods.descriptors import LENGTH, SIFT_LENGTH, describe, project
from skyline_viz.rendering import render


@pytest.fixture(scope="module")
def unseen():
    return render("clear", 9, 320, 200)


def test_sift_is_that_of_opencv(unseen):
    rng = np.random.default_rng(0)
    points = [
        cv2.KeyPoint(float(x), float(y), 4 / 1.5, 0.0)
        for x, y in zip(rng.integers(20, 300, 200), rng.integers(100, 180, 200), strict=True)
    ]
    points, wanted = cv2.SIFT_create().compute(to_grey(unseen.photo), points)
    rows = np.array([round(point.pt[1]) for point in points], np.int32)
    columns = np.array([round(point.pt[0]) for point in points], np.int32)
    found = describe(unseen.photo, rows, columns)[:, :SIFT_LENGTH]
    wanted /= np.linalg.norm(wanted, axis=1, keepdims=True)
    alike = (found * wanted).sum(axis=1) / np.linalg.norm(found, axis=1)
    assert np.median(alike) > 0.98


def test_hog_of_a_level_step_points_down_and_is_normalised():
    photo = np.full((80, 80, 3), 200, np.uint8)
    photo[40:] = 50
    hog = describe(photo, np.array([40], np.int32), np.array([40], np.int32))[0, SIFT_LENGTH:]
    blocks = hog.reshape(9, 4, 9)
    assert np.linalg.norm(blocks.reshape(9, 36), axis=1) == pytest.approx(1, abs=1e-4)
    # 90 degrees lie between the bins at 80 and at 100
    assert blocks[4, :, 4] == pytest.approx(blocks[4, :, 5], abs=1e-4)
    assert blocks[4, :, [0, 1, 2, 7, 8]].max() == 0


def test_descriptors_do_not_depend_on_contrast_but_noise_stays_small():
    rng = np.random.default_rng(1)
    grey = cv2.GaussianBlur(rng.uniform(0, 100, (60, 60)).astype(np.float32), (0, 0), 2)
    at = np.array([30], np.int32)

    def of(values):
        return describe(np.repeat(np.round(values)[:, :, None], 3, 2).astype(np.uint8), at, at)

    strong, stronger = of(grey), of(2 * np.round(grey))
    assert stronger == pytest.approx(strong, abs=1e-3)
    assert not of(np.full((60, 60), 9.0)).any()
    faint = np.full((60, 60), 100.0)
    faint[30, 30] = 101
    assert 0 < np.linalg.norm(of(faint)) < 0.2


def test_descriptors_reach_to_the_corners_of_a_photo():
    photo = np.random.default_rng(2).integers(0, 256, (9, 7, 3), dtype=np.uint8)
    rows, columns = (found.ravel().astype(np.int32) for found in np.indices((9, 7)))
    found = describe(photo, rows, columns)
    assert found.shape == (63, LENGTH)
    assert np.isfinite(found).all()
    assert found.min() >= 0
    assert found.max() <= 1
    weights = np.random.default_rng(3).normal(size=LENGTH).astype(np.float32)
    assert project(photo, rows, columns, weights) == pytest.approx(found @ weights, abs=1e-4)
