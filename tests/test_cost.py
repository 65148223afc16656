"""Nodal costs: the formula at edges, the constant elsewhere, and what a model tells of itself."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.cost import TERMS, CostModel, normalised
from skyline_viz.rendering import render
from skyline_viz.terms import ClearSky, EdgeTerm, Link, NoEdge, Term
from testing.examples import examples

STEADY = examples(60)


def float32(*values):
    return np.array(values, np.float32)


def cost_of(edges, at_edges, non_edge=2.0, clear_sky=0.0):
    terms = (
        EdgeTerm(name="score", weight=1.0, edges=edges, good=1 - at_edges),
        NoEdge(name="no edge", weight=non_edge, edges=edges),
        ClearSky(name="clear sky", weight=clear_sky, edges=edges),
    )
    return CostModel(nodal=terms, link=Link(weight=0.0, delta=1), edges=edges).total()


def edge_cost(scores, strength, v):
    edges = np.ones((1, len(scores)), bool)
    terms = (
        EdgeTerm(name="score", weight=v, edges=edges, good=scores),
        EdgeTerm(name="strength", weight=1 - v, edges=edges, good=strength),
        NoEdge(name="no edge", weight=2.0, edges=edges),
    )
    return CostModel(nodal=terms, link=Link(weight=0.0, delta=1), edges=edges).total()[0]


# Strength


def test_full_strength_is_a_percentile_of_the_photos_own():
    strength = np.arange(1, 102).astype(np.float32)
    found = normalised(strength, 95)
    assert found.dtype == np.float32
    assert np.allclose(found, np.minimum(strength / 96, 1))
    assert normalised(strength, 100)[-1] == 1
    assert normalised(strength, 100)[0] == pytest.approx(1 / 101)


@STEADY
@given(
    st.lists(st.floats(0, 1e6, width=32), min_size=1, max_size=20),
    st.floats(1, 100),
)
def test_normalised_strength_stays_between_0_and_1(values, percentile):
    found = normalised(float32(*values), percentile)
    assert found.dtype == np.float32
    assert 0 <= found.min() <= found.max() <= 1


@pytest.mark.parametrize("count", [0, 1, 5])
def test_no_strength_at_all(count):
    found = normalised(np.zeros(count, np.float32), 95)
    assert found.dtype == np.float32
    assert found.tolist() == [0] * count


def test_mostly_zero_strength():
    found = normalised(np.append(np.zeros(99), 5).astype(np.float32), 50)
    assert found.tolist() == [0] * 100


# Edge pixels


@pytest.mark.parametrize(
    ("score", "strength", "v", "cost"),
    [
        (1, 1, 0.5, 0),
        (0, 0, 0.5, 1),
        (1, 0, 0.5, 0.5),
        (0.25, 0.5, 0.5, 0.625),
        (0.25, 0.5, 1, 0.75),
        (0.25, 0.5, 0, 0.5),
        (0.2, 0.9, 0.3, 0.31),
    ],
)
def test_score_and_strength_are_fused(score, strength, v, cost):
    found = edge_cost(float32(score), float32(strength), v)
    assert found.dtype == np.float32
    assert found[0] == pytest.approx(cost, abs=1e-6)


def test_costs_stand_at_their_edge_pixels():
    edges = np.zeros((5, 7), bool)
    edges[[0, 2, 4, 4], [6, 1, 0, 3]] = True
    cost = cost_of(edges, float32(0.125, 0.25, 0.5, 0.75), non_edge=2.5)
    assert cost.shape == (5, 7)
    assert cost.dtype == np.float32
    expected = np.full((5, 7), 2.5, np.float32)
    expected[[0, 2, 4, 4], [6, 1, 0, 3]] = float32(0.125, 0.25, 0.5, 0.75)
    assert np.array_equal(cost, expected)


def test_columns_lie_together_in_memory():
    assert cost_of(np.zeros((5, 7), bool), float32()).T.flags.c_contiguous


def test_without_edges_every_pixel_costs_the_same():
    cost = cost_of(np.zeros((30, 20), bool), float32(), non_edge=3, clear_sky=0.5)
    assert (cost == 3).all()


# The model of a detection


@pytest.fixture(scope="module", params=["default", "paper"])
def found(request):
    config = sv.DetectorConfig.paper() if request.param == "paper" else sv.DetectorConfig()
    return sv.Detector(config=config).detect(render("hazy", 1, 240, 160).photo)


def test_the_maps_of_the_terms_add_up_to_the_cost(found):
    model = found.cost_model
    assert len(model.nodal) == len(TERMS)
    whole = sum(term.map().astype(np.float64) for term in model.nodal)
    np.testing.assert_allclose(whole, found.cost, atol=1e-5)
    assert np.array_equal(model.total(), found.cost)


def test_a_weight_of_zero_takes_a_term_away(found):
    for setting, term in (("clear_sky", "clear sky"), ("sky_weight", "sky")):
        whole = found.again(replace(found.config, sky_edges=1.0))  # of the same edges as without
        without = whole.again(replace(whole.config, **{setting: 0.0}))
        gone = whole.cost - whole.cost_model[term].map()
        np.testing.assert_allclose(without.cost, gone, atol=1e-5)
        assert not without.cost_model[term].map().any()


def test_the_settings_are_fields_of_the_configuration(found):
    settings = found.cost_model.settings
    assert {"v", "non_edge_cost", "clear_sky", "sky_weight", "link_weight"} <= set(settings)
    assert all(hasattr(found.config, one) for one in settings)


@STEADY
@given(st.integers(0, 2**32 - 1), st.booleans())
def test_more_edges_cost_what_a_photo_with_them_would(seed, at_the_rim):
    rng = np.random.default_rng(seed)
    edges = rng.random((20, 40)) < 0.2
    first, last = (0, 39) if at_the_rim else (5, 34)
    columns = np.arange(first, last + 1) if at_the_rim else np.arange(15, 25)
    rows = rng.integers(0, 20, len(columns))
    columns, rows = columns[~edges[rows, columns]], rows[~edges[rows, columns]]
    more = edges.copy()
    more[rows, columns] = True

    def model(edges):
        good = np.full(edges.sum(), 0.75, np.float32)
        terms = (
            EdgeTerm(name="score", weight=1.0, edges=edges, good=good),
            NoEdge(name="no edge", weight=2.0, edges=edges),
            ClearSky(name="clear sky", weight=0.5, edges=edges),
        )
        return CostModel(nodal=terms, link=Link(weight=0.0, delta=1), edges=edges)

    change = model(edges).more_edges(rows, columns, 0.25, first, last)
    expected = (model(more).total() - model(edges).total())[:, first : last + 1]
    np.testing.assert_allclose(change.T, expected, atol=1e-4)


def test_a_typical_score_saves_what_lower_ones_lack(found):
    saved = found.cost_model.saved(float32(0.2, 0.7, 0.9), 0.7)
    np.testing.assert_allclose(saved, [found.config.v * 0.5, 0, 0], atol=1e-6)


@pytest.mark.parametrize("who", ["edges", "others", "all"])
def test_the_cost_is_the_sum_of_its_terms_whoever_pays(found, who):
    @dataclass(frozen=True, eq=False, kw_only=True)
    class Own(Term):
        """A term that says in `add` alone what is paid."""

        paid_by = who

        def add(self, cost):
            pays = {"edges": self.edges, "others": ~self.edges, "all": True}[who]
            cost += np.where(pays, np.float32(self.weight), np.float32(0))

    own = Own(name="own", weight=0.75, edges=found.edges)
    model = replace(found.cost_model, nodal=(*found.cost_model.nodal, own))
    parts = sum(term.map().astype(np.float64) for term in model.nodal)
    np.testing.assert_allclose(model.total(), parts, atol=1e-4)
    rows = found.skyline.rows.astype(np.int32)
    nodal = sum(paid for name, paid in model.split(rows).items() if name != "link")
    np.testing.assert_allclose(nodal, model.total()[rows, np.arange(len(rows))], atol=1e-4)
