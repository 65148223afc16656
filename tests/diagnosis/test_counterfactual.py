"""What the path would be if one thing were different."""

import numpy as np

import skyline_viz as sv
from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.skyline import Skyline
from testing.detections import WITHOUT_SKY, flat_truth


def test_columns_that_were_never_wrong_are_not_repaired(flat):
    truth = flat_truth(slice(100, 200, 6), 8)
    case = Case(flat, truth, 4.0)
    assert case.repaired(0, flat.skyline.rows.astype(int), 100, 196) == 0
    assert case.repaired(0, truth.rows.astype(int), 100, 196) == 1


def test_without_delta_a_step_of_one_row_is_too_steep():
    photo = np.full((120, 300, 3), 200, np.uint8)
    rows = 60 + np.arange(300) // 12
    for column, row in enumerate(rows):
        photo[row:, column] = 60
    detector = sv.Detector(config=sv.DetectorConfig(delta=0, sky_weight=0))
    truth = Skyline(rows=rows)
    detection = detector.detect(photo)
    assert Case(detection, truth, 4.0).columns_of("too steep", 0, 299).any()
    said = {one.cause for one in diagnose(detection, truth).segments}
    assert "too steep" in said
    default = Case(WITHOUT_SKY.detect(photo), truth, 4.0)
    assert not default.columns_of("too steep", 0, 299).any()


def test_without_any_change_the_search_gives_the_path_back(hazy):
    detection, truth = hazy
    start, rows = Case(detection, truth, 4.0).search((), 100, 300)
    assert start == 0
    np.testing.assert_array_equal(rows, detection.skyline.rows)
