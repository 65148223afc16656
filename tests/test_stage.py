"""Stages as data: what every detection says of itself."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.methods.sky_boundary import detect_boundary
from skyline_viz.rendering import render
from skyline_viz.tensor import tensor_map

PHOTO = render("clear", 1, 180, 120).photo
SKY = (np.arange(120, dtype=np.float32)[:, None] < 50).repeat(180, axis=1).astype(np.float32)
FOUND = {
    "ours": sv.Detector().detect(PHOTO),
    "edges": EdgesOnly().detect(PHOTO),
    "gradient": GradientCost().detect(PHOTO),
    "boundary": detect_boundary("boundary", PHOTO, SKY, {}),
}


@pytest.mark.parametrize("found", FOUND.values(), ids=FOUND)
def test_every_stage_has_values_where_it_says(found):
    height, width = found.edges.shape
    shapes = {
        "mask": (height, width),
        "photo": (height, width),
        "edges": found.edge_rows.shape,
        "columns": (width,),
    }
    assert {"edges", "score", "cost", "path"} <= set(found.stages)
    for name, stage in found.stages.items():
        assert (stage.name, stage.values.shape) == (name, shapes[stage.where])
        assert stage.about
        assert isinstance(stage.unit, str)
        assert isinstance(stage.colour_map, str)


def test_stages_cannot_be_changed():
    with pytest.raises(TypeError):
        FOUND["ours"].stages["sky"] = FOUND["ours"].stages["cost"]
    with pytest.raises(ValueError, match="read-only"):
        FOUND["ours"].stages["score"].values[0] = 1


def test_our_stages_are_those_of_the_method_in_order():
    names = [
        "sky",
        "edges",
        "strength",
        "coherence",
        "orientation",
        "bin",
        "score",
        "score and strength",
        "cost",
        "path",
    ]
    assert list(FOUND["ours"].stages) == names


def test_the_tensor_is_there_for_all_pixels_when_asked_for():
    stages, tensor = FOUND["ours"].stages, tensor_map(PHOTO)
    for name in ("strength", "coherence", "orientation"):
        assert np.array_equal(stages[name].dense(), getattr(tensor, name))
    assert stages["score"].map() is None
    assert stages["path"].map() is None


def test_bins_have_words_and_a_colour_each():
    found = FOUND["ours"]
    legend = found.stages["bin"].legend
    assert len(legend) == found.bank.bins.count
    assert [words for words, _ in legend] == [
        found.bank.bins.label(index) for index in range(found.bank.bins.count)
    ]


def test_methods_bring_stages_of_their_own():
    assert np.array_equal(FOUND["boundary"].stages["sky probability"].values, SKY)


def test_costs_that_rule_out_are_no_values():
    found = FOUND["edges"]
    assert np.array_equal(found.stages["cost"].values, found.cost)
    shown = found.stages["cost"].map()
    assert np.array_equal(np.isnan(shown), found.cost >= found.non_edge_cost)
    assert np.isfinite(FOUND["gradient"].stages["cost"].map()).all()
