"""What a line pays, split by term: the parts add up, whatever the method."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.diagnosis.cost_split import split_cost
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.rendering import render
from testing.examples import examples

SCENE = render("hazy", 1)
FOUND = [
    one.detect(SCENE.photo)
    for one in (
        sv.Detector(),
        sv.Detector(config=sv.DetectorConfig.paper()),
        GradientCost(),
        EdgesOnly(),
    )
]
BY_METHOD = pytest.mark.parametrize("found", FOUND, ids=[one.method for one in FOUND])


@BY_METHOD
def test_the_parts_add_up_to_the_path_cost(found):
    rows = found.skyline.rows.astype(np.int32)
    split = split_cost(found, rows)
    whole = sum(split.totals(0, len(rows) - 1).values())
    assert whole == pytest.approx(found.path_cost, rel=1e-5)
    other = split_cost(found, SCENE.truth.rows.astype(np.int32))
    assert sum(other.totals(0, len(rows) - 1).values()) >= whole * (1 - 1e-6)


@BY_METHOD
@examples(20)
@given(st.integers(0, 2**32 - 1))
def test_the_parts_add_up_in_every_column_of_any_line(found, seed):
    height, width = found.edges.shape
    rows = np.random.default_rng(seed).integers(0, height, width).astype(np.int32)
    split = split_cost(found, rows)
    nodal = sum(costs for term, costs in split.terms.items() if term != "link")
    cost = found.cost[rows, np.arange(width)]
    np.testing.assert_allclose(nodal, cost, rtol=1e-5, atol=1e-4)
    link = found.link_weight * np.abs(np.diff(rows)).sum()
    assert split.terms["link"].sum() == pytest.approx(link)


def test_our_detector_names_all_its_terms():
    split = split_cost(FOUND[0], SCENE.truth.rows.astype(np.int32))
    edges = ["score", "strength", "no edge"]
    assert list(split.terms) == [*edges, "clear sky", "sky", "link"]
    assert (np.abs(split.terms["score"]) <= 1).all()
    assert split.terms["sky"].any()
    assert (split.terms["sky"] >= 0).all()
    assert (split.terms["sky"] <= FOUND[0].config.sky_cap).all()


def test_what_other_methods_pay_besides_the_score_is_of_their_edges():
    split = split_cost(FOUND[3], SCENE.truth.rows.astype(np.int32))
    assert list(split.terms) == ["score", "edge", "no edge", "link"]
    assert not (split.terms["edge"] * split.terms["no edge"]).any()
