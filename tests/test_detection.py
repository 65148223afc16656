"""What a detection holds, and how its stages follow from each other."""

from dataclasses import FrozenInstanceError

import numpy as np
import pytest

from skyline_viz.config import DetectorConfig
from skyline_viz.detecting.pipeline import STAGES
from skyline_viz.detection import solve_detection
from skyline_viz.detector import Detector
from skyline_viz.edges import candidate_edges, edge_pixels, to_grey
from skyline_viz.score import score_at
from skyline_viz.tensor import tensor_at
from testing.detections import BOTH, mountains, random_photo


@pytest.fixture(scope="module")
def detector():
    return Detector()


@BOTH
def test_every_field_has_its_shape_type_and_range(config):
    photo, _ = mountains()
    detection = Detector(config=config).detect(photo)
    height, width = photo.shape[:2]
    count = len(detection.edge_rows)
    assert count > 100
    assert np.array_equal(detection.photo, photo)
    assert detection.skyline.rows.shape == (width,)
    assert detection.skyline.rows.dtype == np.float32
    assert detection.skyline.visible.all()
    assert (detection.skyline.rows % 1 == 0).all()
    assert 0 <= detection.skyline.rows.min() <= detection.skyline.rows.max() <= height - 1
    for name, shape, dtype, low, high in (
        ("edges", (height, width), np.bool_, 0, 1),
        ("edge_rows", (count,), np.int32, 0, height - 1),
        ("edge_columns", (count,), np.int32, 0, width - 1),
        ("strength", (count,), np.float32, 0, np.inf),
        ("coherence", (count,), np.float32, 0, 1),
        ("orientation", (count,), np.float32, 0, 180 - 1e-5),
        ("bins", (count,), np.int32, 0, detection.bank.bins.count - 1),
        ("scores", (count,), np.float32, 0, 1),
        ("cost", (height, width), np.float32, -np.inf, np.inf),
    ):
        array = getattr(detection, name)
        assert array.shape == shape, name
        assert array.dtype == dtype, name
        assert low <= array.min() <= array.max() <= high, name
    assert isinstance(detection.path_cost, float)
    assert np.isfinite(detection.cost).all()
    assert detection.config is config
    assert detection.bank.bins.count == 288
    assert 0 < detection.thresholds[0] <= config.low_threshold
    assert 0 < detection.thresholds[1] <= config.high_threshold


def test_every_stage_is_timed(detector):
    detection = detector.detect(mountains()[0])
    assert list(detection.seconds) == list(STAGES)
    assert all(seconds >= 0 for seconds in detection.seconds.values())
    assert detection.total_seconds == pytest.approx(sum(detection.seconds.values()))


@BOTH
def test_stages_follow_from_each_other(config):
    photo, _ = mountains(seed=2)
    detection = Detector(config=config).detect(photo)
    edges, thresholds = candidate_edges(photo, config, sky=detection.sky)
    assert np.array_equal(detection.edges, edges)
    assert detection.thresholds == thresholds
    rows, columns = edge_pixels(edges)
    assert np.array_equal(detection.edge_rows, rows)
    assert np.array_equal(detection.edge_columns, columns)
    tensor = tensor_at(photo, rows, columns)
    assert np.array_equal(detection.strength, tensor.strength)
    assert np.array_equal(detection.coherence, tensor.coherence)
    assert np.array_equal(detection.orientation, tensor.orientation)
    assert np.array_equal(detection.bins, detection.bank.bins.of(tensor))
    scores = score_at(to_grey(photo), rows, columns, detection.bins, detection.bank.filters)
    assert np.array_equal(detection.scores, scores)


def test_a_detection_is_frozen(detector):
    detection = detector.detect(random_photo(20, 30))
    with pytest.raises(FrozenInstanceError):
        detection.edges = None
    with pytest.raises(FrozenInstanceError):
        detector.config = DetectorConfig.paper()


def test_margins_shrink_when_a_second_line_appears():
    photo = np.full((60, 80, 3), 200, np.uint8)
    photo[20:] = 120
    alone = Detector().detect(photo)
    photo[40:] = 20
    rivalled = Detector().detect(photo)
    assert alone.margins().shape == (80,)
    assert (rivalled.margins() < alone.margins()).all()
    assert (rivalled.margins() > 0).all()


def test_the_arrays_of_a_detection_are_frozen_but_not_the_photo():
    photo = mountains(40, 60)[0]
    detection = Detector().detect(photo)
    for name in ("edges", "edge_rows", "strength", "bins", "scores", "cost"):
        assert not getattr(detection, name).flags.writeable, name
    assert photo.flags.writeable


@pytest.mark.parametrize("names", [("cost",), ("score",), ("sky prob", "sky_prob")])
def test_a_map_never_takes_the_place_of_a_stage_or_of_another_map(names):
    cost = np.zeros((6, 8), np.float32)
    maps = dict.fromkeys(names, cost)
    with pytest.raises(ValueError, match=f"a map cannot be called {names[-1]}: there is"):
        solve_detection(
            "own", np.zeros((6, 8, 3), np.uint8), cost == 0, cost.ravel(), cost, {},
            delta=1, link_weight=0.0, non_edge_cost=1.0, maps=maps,
        )  # fmt: skip
