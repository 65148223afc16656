"""How surely a line is the skyline: what is measured, and what becomes of it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.certainty.confidence import ROWS, confidence, elsewhere, reduced, wrong_side
from skyline_viz.methods.edges_only import EdgesOnly


def half_sky(columns=4):
    return np.repeat(np.array([[1], [1], [0], [0]], np.float32), columns, axis=1)


@given(st.integers(0, 80), st.integers(1, 50))
def test_the_wrong_side_is_the_distance_from_a_sharp_boundary(row, width):
    shown = np.ones(width, np.bool_)
    found = wrong_side(half_sky(), np.full(width, row), shown, 80)
    assert found == pytest.approx(abs(row - 40) / 80, abs=1e-6)


def test_columns_of_a_frame_do_not_count():
    rows = np.repeat([40, 0], 10)
    shown = np.repeat([True, False], 10)
    assert wrong_side(half_sky(), rows, shown, 80) == pytest.approx(0, abs=1e-6)


def two_ridges(dearer, height=80, width=60):
    cost = np.full((height, width), 2.0, np.float32)
    cost[height // 4], cost[3 * height // 4] = 1.0, 1.0 + dearer
    return cost


def test_another_ridge_counts_by_its_distance_and_less_the_dearer_it_is():
    near, far = elsewhere(two_ridges(0.01), 4, 0.1), elsewhere(two_ridges(0.3), 4, 0.1)
    assert near > 0.4
    assert far < 0.1 * near


@given(st.integers(1, 4), st.floats(0, 0.2))
def test_the_size_of_a_photo_changes_little(by, dearer):
    cost = two_ridges(dearer, ROWS, 120)
    large = cost.repeat(by, axis=0).repeat(by, axis=1)
    assert elsewhere(large, 4, 0.1) == pytest.approx(elsewhere(cost, 4, 0.1), abs=1e-4)


def test_reduced_costs_keep_what_a_line_pays_a_column():
    cost = np.random.default_rng(3).random((3 * ROWS, 91)).astype(np.float32)
    found = reduced(cost)
    assert found.shape == (ROWS, 30)
    assert found[7, 5] == pytest.approx(cost[21:24, 15:18].min(axis=0).mean())
    assert reduced(cost[:ROWS]).shape == (ROWS, 91)


def test_a_line_on_a_wrong_ridge_is_unsure():
    shown, cost = np.ones(60, np.bool_), two_ridges(0.02)
    right = confidence(half_sky(), np.full(60, 40), shown, cost, 4, 0.1)
    wrong = confidence(half_sky(), np.full(60, 20), shown, cost, 4, 0.1)
    assert 0 <= wrong.value < right.value <= 1
    assert "25% of the photo is on the wrong side" in wrong.said


def test_each_method_tells_and_a_wrong_line_is_told():
    scene = sv.render("hazy", 3, 240, 160)
    for method in (sv.Detector(), sv.Detector(config=sv.DetectorConfig.paper()), EdgesOnly()):
        detection = method.detect(scene.photo)
        assert 0 <= detection.confidence <= 1
        assert detection.certainty.wrong_side < 0.5
    upside_down = replace(detection, skyline=sv.Skyline(np.full(240, 158)))
    assert upside_down.confidence < detection.confidence
