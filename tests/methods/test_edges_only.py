"""Stable edges, photos without frames, and the two methods that learn nothing."""

from dataclasses import replace

import numpy as np
import pytest

from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.methods.edges_only import EdgesOnly, fill_gaps, ruled_out_but
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline


@pytest.fixture(scope="module")
def scene():
    return render("clear", 8, 320, 200)


def step(height=120, width=160, row=50, sky=220, ground=60):
    photo = np.full((height, width, 3), sky, np.uint8)
    photo[row:] = ground
    return photo


def gaps_by_hand(edges, delta, tog):
    """Dummy nodes of an edge map ``(W, H)``, pixel by pixel, as the method is described."""
    width, height = edges.shape
    dummies = np.zeros_like(edges)

    def reached(column, row):
        rows = [other for other in range(height) if edges[column, other]]
        return sorted((abs(other - row), other) for other in rows if abs(other - row) <= delta)

    for column in range(width - 1):
        for row in np.flatnonzero(edges[column]):
            if reached(column + 1, row):
                continue
            for there in range(column + 2, min(column + tog, width - 1) + 1):
                if found := reached(there, row):
                    slope = (found[0][1] - row) / (there - column)
                    for between in range(column + 1, there):
                        dummies[between, int(row + slope * (between - column) + 0.5)] = True
                    break
    return dummies & ~edges


@pytest.mark.parametrize("seed", range(8))
def test_gaps_are_filled_as_by_hand(seed):
    rng = np.random.default_rng(seed)
    edges = rng.random((30, 20)) < (0.02, 0.1)[seed % 2]
    delta, tog = int(rng.integers(1, 6)), int(rng.integers(2, 12))
    assert (fill_gaps(edges, delta, tog) == gaps_by_hand(edges, delta, tog)).all()


def test_a_gap_as_long_as_the_tolerance_is_filled_and_no_longer_one():
    edges = np.zeros((12, 9), bool)
    edges[1, 2] = edges[7, 5] = True
    assert fill_gaps(edges, 3, 6).sum() == 5
    assert not fill_gaps(edges, 3, 5).any()
    assert not fill_gaps(edges, 2, 6).any()


def test_what_is_no_node_is_ruled_out():
    where = np.array([[True, False], [False, True]])
    cost = ruled_out_but(where.shape, where, np.array([0.25, 0.5], np.float32))
    assert cost[where].tolist() == [0.25, 0.5]
    assert (cost[~where] >= 1e4).all()


def test_edges_follow_an_easy_skyline(scene):
    detection = EdgesOnly().detect(scene.photo)
    assert detection.method == "edges"
    assert a_err(detection.skyline, scene.truth) < 2
    assert (detection.scores == 1).all()


def test_of_two_lines_the_upper_one_is_the_skyline():
    photo = step(row=20)
    photo[60:] = 220  # as strong, as straight and nearer the middle
    upper, lower = np.full(160, 20.0), np.full(160, 60.0)
    assert a_err(EdgesOnly().detect(photo).skyline, Skyline(upper)) <= 1
    assert a_err(replace(EdgesOnly(), row_cost=0.0).detect(photo).skyline, Skyline(lower)) <= 1


def test_the_path_begins_and_ends_on_edges_however_low_they_are():
    photo = step(row=115)
    skyline = EdgesOnly().detect(photo).skyline
    assert np.abs(skyline.rows - 115).max() <= 1


def test_a_gap_is_crossed_at_the_cost_of_dummies():
    photo = step()
    photo[50:, 70:80] = 214  # hardly darker than the sky
    detection = EdgesOnly().detect(photo)
    assert not detection.edges[:, 73:77].any()
    assert np.abs(detection.skyline.rows - 50).max() <= 2
    assert (detection.cost[detection.skyline.rows.astype(int), np.arange(160)][72:78] == 100).all()


def test_a_photo_without_edges_gives_a_line():
    photo = np.full((40, 60, 3), 128, np.uint8)
    for method in (EdgesOnly(), GradientCost()):
        assert method.detect(photo).skyline.width == 60


@pytest.mark.parametrize("method", [EdgesOnly(), GradientCost()], ids=["edges", "gradient"])
def test_failures_are_diagnosed(method):
    photo = step(sky=90, ground=88)  # the truth is no edge
    photo[100:] = 250
    detection = method.detect(photo)
    diagnosis = diagnose(detection, Skyline(np.full(160, 50.0)))
    assert not diagnosis.right
    assert diagnose(detection, detection.skyline).right
    if method.name == "edges":
        assert diagnosis.main.cause == "missed edge"
