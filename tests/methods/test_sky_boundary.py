"""From sky probabilities to a skyline."""

import numpy as np

from skyline_viz.evaluation.metrics import a_err
from skyline_viz.methods.sky_boundary import boundary_scores, detect_boundary
from skyline_viz.skyline import Skyline

SHAPE = (75, 110)  # no multiples of anything


def scene():
    """A bright sky over dark terrain, and where it ends."""
    columns = np.arange(SHAPE[1])
    truth = Skyline(np.round(38 + 12 * np.sin(columns / 17)).astype(np.float32))
    sky = truth.to_mask(SHAPE[0])
    return np.where(sky[..., None], np.uint8(220), np.uint8(40)).repeat(3, axis=2), truth


def test_the_best_row_of_a_column_is_where_the_fewest_pixels_are_wrong():
    sky = np.random.default_rng(1).random((40, 6)).astype(np.float32)
    for column, scores in zip(sky.T, boundary_scores(sky).T, strict=True):
        wrong = [float((1 - column[:row]).sum() + column[row:].sum()) for row in range(40)]
        assert scores.argmax() == np.argmin(wrong)
        expected = np.exp(-(np.array(wrong) - min(wrong)) / (10 * 40 / 519))
        np.testing.assert_allclose(scores, expected, rtol=1e-4, atol=1e-6)


def test_the_line_passes_over_a_hole_and_a_cloud():
    photo, truth = scene()
    sky = truth.to_mask(SHAPE[0]).astype(np.float32)
    sky[60:70, 20:60] = 1  # a lake
    sky[5:12, 40:90] = 0  # a cloud
    sky[:, 70] = 1  # a column that is all sky
    detection = detect_boundary("x", photo, sky, {})
    assert np.abs(detection.skyline.rows - truth.rows).max() <= 2
    naive = Skyline.from_mask(sky > 0.5)
    assert a_err(naive, truth) > 5
    np.testing.assert_allclose(
        detection.cost[detection.edge_rows, detection.edge_columns], 1 - detection.scores
    )
