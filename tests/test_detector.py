"""The detector as a whole: every field it returns, what it finds, and what it must survive."""

import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.bins import Bins
from skyline_viz.config import DetectorConfig, TrainingConfig
from skyline_viz.cost import normalised
from skyline_viz.detector import Detector
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.filter_bank import FilterBank, Provenance
from skyline_viz.path import margins, path_tables
from skyline_viz.sky_model import SkyModel
from skyline_viz.skyline import Skyline
from skyline_viz.system.settings import MethodError
from testing.detections import BOTH, mountains, random_photo
from testing.examples import examples
from testing.networks import bright_model, bright_sky

STEADY = examples(25)

STAGES = ("skyline", "edges", "edge_rows", "edge_columns", "strength", "coherence")
STAGES += ("orientation", "bins", "scores", "cost", "path_cost", "thresholds", "sky")


@pytest.fixture(scope="module")
def detector():
    return Detector()


def margins_of(detection):
    config = detection.config
    tables = path_tables(detection.cost, config.delta, config.link_weight)
    return margins(tables.min_marginals)


def assert_same(one, other):
    for stage in STAGES:
        first, second = getattr(one, stage), getattr(other, stage)
        if isinstance(first, np.ndarray):
            assert np.array_equal(first, second), stage
        else:
            assert first == second, stage


# What a detection holds


def test_the_papers_cost_is_the_fusion_of_score_and_strength():
    config = replace(DetectorConfig.paper(), v=0.3, strength_percentile=80)
    detection = Detector(config=config).detect(mountains()[0])
    strength = normalised(detection.strength, 80)
    fused = np.float32(0.3) * (1 - detection.scores) + np.float32(0.7) * (1 - strength)
    found = detection.cost[detection.edge_rows, detection.edge_columns]
    assert np.allclose(found, fused, atol=1e-6)
    assert (detection.cost[~detection.edges] == 3).all()


@BOTH
def test_the_skyline_is_the_cheapest_path(config):
    detection = Detector(config=config).detect(mountains()[0])
    rows = detection.skyline.rows.astype(int)
    changes = np.abs(np.diff(rows))
    assert changes.max() <= config.delta
    nodes = detection.cost[rows, np.arange(len(rows))].astype(float).sum()
    total = nodes + config.link_weight * changes.sum()
    assert detection.path_cost == pytest.approx(total)
    tables = path_tables(detection.cost, config.delta, config.link_weight)
    assert detection.path_cost == pytest.approx(tables.min_marginals.min())


def test_clear_sky_changes_the_cost():
    photo, _ = mountains()
    plain = replace(DetectorConfig(), clear_sky=0)
    without = Detector(config=plain).detect(photo).cost
    cleared = Detector(config=replace(plain, clear_sky=0.05)).detect(photo).cost
    added = cleared - without
    assert (added >= 0).all()
    assert (np.diff(added, axis=0) >= -1e-5).all()
    assert added[-1].min() > 0


# What it finds


@BOTH
@pytest.mark.parametrize("seed", range(4))
def test_a_simple_ridge_is_found_within_a_pixel(config, seed):
    height, width = 110, 170
    columns = np.arange(width)
    rows = np.round(50 + 12 * np.sin(columns / 21 + seed) + 4 * np.sin(columns / 9 + seed))
    truth = Skyline(rows)
    photo = np.where(truth.to_mask(height)[:, :, None], (170, 195, 230), (70, 75, 60))
    photo = cv2.GaussianBlur(photo.astype(np.uint8), (0, 0), 0.7)
    found = Detector(config=config).detect(photo).skyline
    assert np.abs(found.rows - truth.rows).max() <= 1


@pytest.mark.parametrize("seed", range(3))
def test_a_textured_mountain_is_found(detector, seed):
    photo, truth = mountains(seed=seed)
    assert a_err(detector.detect(photo).skyline, truth) < 1


def test_a_steep_peak_is_followed_as_far_as_delta_allows():
    height, width = 150, 100
    rows = 120 - np.clip(120 - 3 * np.abs(np.arange(width) - 50), 0, 100)
    truth = Skyline(rows)
    photo = np.where(truth.to_mask(height)[:, :, None], (170, 195, 230), (70, 75, 60))
    photo = photo.astype(np.uint8)
    assert a_err(Detector().detect(photo).skyline, truth) < 1.5
    assert a_err(Detector(config=DetectorConfig.paper()).detect(photo).skyline, truth) > 3


@pytest.mark.parametrize("seed", range(4))
def test_a_flipped_photo_has_a_flipped_skyline(detector, seed):
    photo, _ = mountains(seed=seed)
    here = detector.detect(photo)
    there = detector.detect(photo[:, ::-1])
    assert np.abs(there.skyline.rows[::-1] - here.skyline.rows).mean() < 0.5
    assert there.path_cost == pytest.approx(here.path_cost, rel=0.03)


# What it must survive


WITHOUT_SKY = pytest.mark.parametrize(
    "config", [DetectorConfig(sky_weight=0.0), DetectorConfig.paper()], ids=["default", "paper"]
)


@WITHOUT_SKY
@pytest.mark.parametrize("value", [0, 60, 128, 255])
@pytest.mark.parametrize("shape", [(40, 60), (41, 7), (7, 90)])
def test_without_an_edge_the_line_is_level_and_nothing_is_sure(config, value, shape):
    detection = Detector(config=config).detect(np.full((*shape, 3), value, np.uint8))
    assert not detection.edges.any()
    assert set(detection.skyline.rows.tolist()) == {shape[0] // 2}
    assert (detection.cost == config.non_edge_cost).all()
    for name in ("edge_rows", "strength", "coherence", "orientation", "bins", "scores"):
        assert getattr(detection, name).shape == (0,)
    if shape[0] > 20:
        assert margins_of(detection).tolist() == [0] * shape[1]


def test_without_an_edge_the_line_follows_the_map_of_the_sky_model():
    photo = np.linspace(250, 20, 240).astype(np.uint8)[:, None, None].repeat(90, 1).repeat(3, 2)
    found = Detector(sky=bright_model()).detect(photo)
    assert not found.edges.any()
    middle = (found.stages["sky"].values > 0.5).sum(axis=0)
    assert 10 < middle.min() < 230
    assert np.abs(found.skyline.rows - middle).max() <= 240 / len(found.sky)
    paid = found.cost - found.config.non_edge_cost
    np.testing.assert_allclose(paid, found.cost_model["sky"].map(), atol=1e-6)


def test_a_map_that_says_nothing_leaves_the_line_level_in_the_middle():
    unsure = SkyModel("unsure", bright_sky(24, 32, sharpness=0.0))
    found = Detector(sky=unsure).detect(np.full((40, 60, 3), 128, np.uint8))
    assert set(found.skyline.rows.tolist()) == {20}
    assert margins_of(found).tolist() == [0] * 60


@BOTH
@pytest.mark.parametrize(
    "shape",
    [(2, 2), (2, 3), (3, 2), (3, 3), (4, 4), (5, 300), (300, 5), (2, 50), (50, 2), (9, 9), (17, 8)],
)
def test_tiny_photos(config, shape):
    for photo in (random_photo(*shape), np.zeros((*shape, 3), np.uint8)):
        detection = Detector(config=config).detect(photo)
        assert detection.skyline.width == shape[1]
        assert detection.cost.shape == shape
        assert 0 <= detection.skyline.rows.min() <= detection.skyline.rows.max() < shape[0]


@STEADY
@given(st.integers(2, 40), st.integers(2, 40), st.integers(0, 2**32 - 1))
def test_photos_of_any_size(height, width, seed):
    detection = Detector().detect(random_photo(height, width, seed))
    assert detection.skyline.width == width
    assert np.isfinite(detection.cost).all()


@pytest.mark.parametrize("chosen", [{"frame": 10_000}, {"delta": 100_000}, {"v": 0}, {"v": 1}])
def test_extreme_settings(chosen):
    detection = Detector(config=DetectorConfig(**chosen)).detect(mountains(40, 60)[0])
    assert detection.skyline.width == 60
    assert detection.edges.any()


def test_thresholds_of_zero():
    config = DetectorConfig(low_threshold=0, high_threshold=0)
    assert Detector(config=config).detect(mountains(40, 60)[0]).edges.any()


VIEWS = {
    "flipped": lambda photo: photo[:, ::-1],
    "upside down": lambda photo: photo[::-1],
    "other channels": lambda photo: photo[:, :, ::-1],
    "every second pixel": lambda photo: photo[::2, 1::2],
    "crop": lambda photo: photo[7:90, 11:150],
    "transposed": lambda photo: photo.transpose(1, 0, 2),
    "columns first in memory": np.asfortranarray,
}


@pytest.mark.parametrize("view", VIEWS.values(), ids=VIEWS)
def test_views_are_seen_like_copies(detector, view):
    seen = view(mountains()[0])
    assert not seen.flags.c_contiguous
    assert_same(detector.detect(seen), detector.detect(seen.copy(order="C")))


def test_the_photo_is_left_alone(detector):
    photo, _ = mountains()
    before = photo.copy()
    detector.detect(photo)
    assert np.array_equal(photo, before)
    photo.setflags(write=False)
    assert_same(detector.detect(photo), detector.detect(before))


@pytest.mark.parametrize(
    ("photo", "error", "message"),
    [
        (np.zeros((9, 9, 3)), TypeError, "uint8 array .* not float64"),
        (np.zeros((9, 9, 3), np.int8), TypeError, "not int8"),
        ([[[0, 0, 0]]], TypeError, "not list"),
        (None, TypeError, "not NoneType"),
        (np.zeros((9, 9), np.uint8), ValueError, r"\(H, W, 3\), not \(9, 9\)"),
        (np.zeros((9, 9, 4), np.uint8), ValueError, r"not \(9, 9, 4\)"),
        (np.zeros((1, 9, 9, 3), np.uint8), ValueError, "shape"),
        (np.zeros((0, 9, 3), np.uint8), ValueError, "at least 2 by 2 pixels, not 9x0"),
        (np.zeros((9, 1, 3), np.uint8), ValueError, "not 1x9"),
    ],
)
def test_what_is_no_photo_is_refused(detector, photo, error, message):
    with pytest.raises(error, match=message):
        detector.detect(photo)


# Repeating, sharing, sending


def test_the_same_photo_gives_the_same_detection(detector):
    photo, _ = mountains()
    assert_same(detector.detect(photo), detector.detect(photo))
    assert_same(detector.detect(photo), Detector().detect(photo.copy()))


def test_threads_share_a_detector(detector):
    photos = [mountains(seed=seed)[0] for seed in range(4)]
    expected = [detector.detect(photo) for photo in photos]
    with ThreadPoolExecutor(4) as threads:
        found = list(threads.map(detector.detect, photos * 4))
    assert len(found) == 16
    for index, detection in enumerate(found):
        assert_same(detection, expected[index % 4])


def test_a_detector_can_be_sent_to_another_process(detector):
    photo, _ = mountains()
    sent = pickle.loads(pickle.dumps(detector))
    assert sent.config == detector.config
    assert np.array_equal(sent.bank.filters, detector.bank.filters)
    assert_same(sent.detect(photo), detector.detect(photo))


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"delta": 2},
        {"link_weight": 0.4},
        {"v": 0.9},
        {"clear_sky": 0.0},
        {"sky_weight": 0.0},
        {"sky_weight": 2.0, "sky_cap": 0.3},
        {"sky_edges": 0.1},
        {"sky_edges": 1.0},
        {"sky_weight": 0.0, "sky_edges": 1.0},
        {"strength_percentile": 80.0},
        {"non_edge_cost": 1.5},
        {"frame": 0},
        {"edge_source": "grey"},
        {"low_threshold": 20.0, "high_threshold": 90.0, "fit_thresholds": False},
    ],
    ids=str,
)
def test_detecting_again_gives_what_detecting_gives(detector, changes):
    photo, _ = mountains()
    found = detector.detect(photo)
    other = Detector(config=replace(DetectorConfig(), **changes))
    assert_same(other.again(found), other.detect(photo))
    assert other.again(found).config == other.config


def test_detecting_again_with_another_bank(detector):
    photo, _ = mountains()
    found = detector.detect(photo)
    bins = Bins(coherences=2, strengths=3, orientations=4)
    taps = np.random.default_rng(0)
    for other in (Bins(), bins):
        filters = taps.normal(0, 0.1, (other.count, 5, 5))
        bank = FilterBank(filters, np.full(other.count, 99), bins=other)
        again = Detector(bank).again(found)
        assert_same(again, Detector(bank).detect(photo))
        assert again.bank is bank


def test_the_map_of_the_sky_is_made_once(monkeypatch):
    photo, _ = mountains()
    runs = []
    whole = SkyModel._map
    monkeypatch.setattr(SkyModel, "_map", lambda *given: runs.append(given) or whole(*given))
    detector = Detector(sky=bright_model())
    found = detector.detect(photo)
    assert len(runs) == 1
    for changes in ({"delta": 2}, {"sky_weight": 1.0}, {"edge_source": "grey"}, {"v": 0.9}):
        again = found.again(replace(found.config, **changes))
        assert again.sky is found.sky
        assert again.seconds["sky"] == 0
        assert again.detector.sky == detector.sky
    without = found.again(replace(found.config, sky_weight=0.0))
    assert without.sky is None
    assert len(runs) == 1
    assert_same(without.again(found.config), found)  # asked again, as the map was dropped
    assert len(runs) == 2
    assert Detector(sky=bright_model(6, 8)).again(found).sky.shape == (3, 4)


def test_a_sky_model_that_is_switched_off_is_not_even_opened():
    nothing = SkyModel("nothing", b"this is no network")
    photo, _ = mountains()
    for config in (DetectorConfig(sky_weight=0.0), DetectorConfig.paper()):
        found = Detector(config=config, sky=nothing).detect(photo)
        assert found.sky is None
        assert "sky" not in found.stages
        assert found.cost_model["sky"].weight == 0
    with pytest.raises(MethodError, match="the sky model nothing is not an ONNX file"):
        Detector(sky=nothing).detect(photo)


def test_the_sky_model_decides_between_two_ridges():
    photo = np.full((120, 200, 3), 220, np.uint8)
    photo[40:] = 190  # a far ridge, bright as the sky
    photo[80:] = 30
    config = DetectorConfig(clear_sky=0, v=0)
    plain = Detector(config=replace(config, sky_weight=0)).detect(photo)
    assert set(plain.skyline.rows.tolist()) == {80}
    for ridge, brightness in ((40, 205), (80, 110)):
        logit = 40 * (brightness / 255 - 0.5)
        model = SkyModel("sure", bright_sky(24, 32, bias=-20 - logit))
        found = Detector(config=config, sky=model).detect(photo)
        assert set(found.skyline.rows.tolist()) == {ridge}


def test_the_stage_sky_is_a_map_of_the_photo():
    photo, _ = mountains()
    found = Detector(sky=bright_model()).detect(photo)
    stage = found.stages["sky"]
    assert next(iter(found.stages)) == "sky"
    assert stage.where == "photo"
    assert stage.values.shape == photo.shape[:2]
    assert 0 <= stage.values.min() < 0.01 < 0.99 < stage.values.max() <= 1
    assert not stage.values.flags.writeable
    assert "Sky model bright." in found.about()


def test_the_given_bank_scores():
    photo, _ = mountains()
    bank = FilterBank.default()
    silent = replace(bank, filters=np.zeros_like(bank.filters))
    detection = Detector(silent).detect(photo)
    assert not detection.scores.any()
    assert detection.bank is silent
    assert Detector(bank).detect(photo).scores.any()


# How it learns


def test_it_learns_as_its_bank_did_where_that_saw_the_same(detector):
    made = Provenance("hills", 4, edges="colour", smoothness=3, reach=1, pooling=2)
    bank = replace(detector.bank, provenance=made)
    training = replace(detector, bank=bank).training
    assert (training.reach, training.smoothness, training.pooling) == (1, 3, 2)
    paper = Detector(bank, DetectorConfig.paper())
    assert paper.training == TrainingConfig.of(DetectorConfig.paper())
    assert paper.family != detector.family
    unknown = replace(detector, bank=replace(bank, provenance=Provenance()))
    assert unknown.training == TrainingConfig()
