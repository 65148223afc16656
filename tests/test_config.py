"""Settings: defaults, the published ones, and values that are refused by name."""

import json
from dataclasses import FrozenInstanceError, asdict, dataclass, fields, replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.bins import Bins
from skyline_viz.command_line.methods import described
from skyline_viz.config import FILTER_SIZES, DetectorConfig, TrainingConfig
from skyline_viz.filter_bank import Provenance
from skyline_viz.methods.registry import find_method
from skyline_viz.system.notes import heard_by

RANGES = {
    "low_threshold": (0, 220),
    "high_threshold": (50, 1e5),
    "frame": (0, 10_000),
    "v": (0, 1),
    "strength_percentile": (1, 100),
    "non_edge_cost": (0, 1e6),
    "clear_sky": (0, 1e3),
    "sky_weight": (0, 1e3),
    "sky_cap": (0, 1e6),
    "sky_edges": (0, 1),
    "delta": (0, 100_000),
    "link_weight": (0, 1e6),
}


def test_defaults_find_colour_edges_and_clear_skies():
    config = DetectorConfig()
    assert config.edge_source == "colour"
    assert config.fit_thresholds
    assert (config.low_threshold, config.high_threshold) == (50, 220)
    assert config.v == 0.5
    assert config.clear_sky > 0
    assert config.sky_weight > 0
    # the dearest edge costs 1: the sky model never outbids the only one there is
    assert 0 < config.sky_cap <= config.non_edge_cost - 1
    assert config.delta > 1
    assert config.non_edge_cost > 1


def test_the_published_settings():
    assert DetectorConfig.paper() == DetectorConfig(
        edge_source="grey",
        low_threshold=50,
        high_threshold=220,
        fit_thresholds=False,
        frame=0,
        v=0.5,
        strength_percentile=100,
        non_edge_cost=3,
        clear_sky=0,
        sky_weight=0,
        sky_edges=1,
        delta=1,
        link_weight=0,
    )


def test_every_number_has_a_range():
    numbers = {field.name for field in fields(DetectorConfig)} - {"edge_source", "fit_thresholds"}
    assert set(RANGES) == numbers


@pytest.mark.parametrize("name", RANGES)
def test_both_ends_of_a_range_are_accepted(name):
    for value in RANGES[name]:
        assert getattr(DetectorConfig(**{name: value}), name) == value


@pytest.mark.parametrize(
    "refused",
    [
        lambda: DetectorConfig(terrain_weight=0.0),
        lambda: replace(DetectorConfig(), terrain_weight=0.0),
        lambda: DetectorConfig().with_settings({"terrain_weight": 0.0}),
        lambda: find_method("default:terrain_weight=0"),
        lambda: described(["detect", "a.jpg", "--config.terrain-weight", "0"]),
        lambda: described(["detect", "a.jpg", "--config.terrain_weight=0"]),
    ],
)
def test_a_setting_that_is_gone_is_refused_and_its_heir_is_named(refused):
    with pytest.raises(ValueError, match=r"terrain_weight is gone: .* with the weight sky_weight"):
        refused()


@pytest.mark.parametrize(("weight", "notes"), [(4.0, 1), (0.0, 0), (None, 0), ("4", 0)])
def test_a_setting_that_is_gone_is_left_out_of_a_file_and_that_is_said(weight, notes):
    heard = []
    with heard_by(heard.append):
        told = {"delta": 2, "terrain_weight": weight}
        assert DetectorConfig.from_file(told, "a.npz") == DetectorConfig(delta=2)
        assert DetectorConfig.from_file(told) == DetectorConfig(delta=2)
    assert len(heard) == notes
    assert all(one.startswith("a.npz was made with terrain_weight 4, which is") for one in heard)
    with pytest.raises(TypeError, match="slope"):
        DetectorConfig.from_file({"slope": 1})


BAD = [-1, -0.001, 1e9, np.nan, np.inf, -np.inf, None, "1", True, [1]]


@pytest.mark.parametrize("value", BAD, ids=repr)
@pytest.mark.parametrize("name", RANGES)
def test_values_that_are_refused_by_name(name, value):
    with pytest.raises(ValueError, match=rf"^{name} is a (whole )?number from .* not "):
        DetectorConfig(**{name: value})


@pytest.mark.parametrize(
    ("name", "value"), [("v", 1.001), ("strength_percentile", 100.5), ("strength_percentile", 0)]
)
def test_shares_end_at_one(name, value):
    with pytest.raises(ValueError, match=name):
        DetectorConfig(**{name: value})


@pytest.mark.parametrize("name", ["delta", "frame"])
@pytest.mark.parametrize("value", [1.0, 2.5])
def test_pixels_are_whole_numbers(name, value):
    with pytest.raises(ValueError, match=f"{name} is a whole number from .* not {value}"):
        DetectorConfig(**{name: value})


@pytest.mark.parametrize("source", ["gray", "color", "", None, "Grey"])
def test_other_edge_sources_are_refused(source):
    with pytest.raises(ValueError, match="edge_source is 'grey' or 'colour'"):
        DetectorConfig(edge_source=source)


def test_thresholds_are_in_order():
    with pytest.raises(ValueError, match="low_threshold is at most high_threshold"):
        DetectorConfig(low_threshold=100, high_threshold=99)
    assert DetectorConfig(low_threshold=99, high_threshold=99).low_threshold == 99


@pytest.mark.parametrize("config", [DetectorConfig, TrainingConfig, Bins])
def test_unknown_settings_are_refused_by_name(config):
    with pytest.raises(TypeError, match="lambda_weight"):
        config(lambda_weight=1)


@pytest.mark.parametrize("config", [DetectorConfig(), TrainingConfig(), Bins()], ids=repr)
def test_settings_are_frozen_and_comparable(config):
    name = fields(config)[0].name
    with pytest.raises(FrozenInstanceError):
        setattr(config, name, getattr(config, name))
    assert replace(config) == config
    assert hash(replace(config)) == hash(config)


def test_replacing_checks_too():
    with pytest.raises(ValueError, match="delta"):
        replace(DetectorConfig(), delta=-3)


# Training


def test_training_defaults():
    config = TrainingConfig()
    assert config.bins == Bins()
    assert config.filter_size == 7
    assert config.detector == DetectorConfig()


@pytest.mark.parametrize("size", FILTER_SIZES)
def test_filter_sizes(size):
    assert TrainingConfig(filter_size=size).filter_size == size
    assert size % 2 == 1


@pytest.mark.parametrize("size", [0, 1, 2, 6, 8, 17, -7, 7.0, None, "7"])
def test_other_filter_sizes_are_refused(size):
    with pytest.raises(
        ValueError, match=f"filter_size is (one of|a whole number from) .* not {size!r}"
    ):
        TrainingConfig(filter_size=size)


@pytest.mark.parametrize("name", ["band", "smoothness", "pooling", "reach"])
@pytest.mark.parametrize("value", [-1, np.nan, np.inf])
def test_other_weights_are_refused(name, value):
    with pytest.raises(ValueError, match=name):
        TrainingConfig(**{name: value})


def test_weights_of_zero():
    assert TrainingConfig(band=0, smoothness=0, pooling=0).smoothness == 0


def test_the_published_method_learns_from_the_true_pixels():
    paper = TrainingConfig.of(DetectorConfig.paper())
    assert (paper.reach, paper.smoothness, paper.pooling) == (0, 100, 50)
    assert paper.detector == DetectorConfig.paper()
    steep = DetectorConfig(delta=9)
    assert TrainingConfig.of(steep) == TrainingConfig(detector=steep)


NUMBERS = st.sampled_from([np.float32, np.float64, np.float16, Fraction])
WHOLE = st.sampled_from([np.int16, np.int64, np.uint8])


@given(NUMBERS, WHOLE, st.integers(0, 4))
def test_numbers_of_any_library_are_kept_as_pythons_own(number, whole, quarters):
    value = number(quarters / 4)
    config = DetectorConfig(v=value, delta=whole(quarters))
    training = TrainingConfig(
        Bins(whole(3), coherence_top=number(0.5)), whole(7), number(8), reach=whole(quarters)
    )
    provenance = Provenance(seed=whole(quarters), smoothness=value, reach=whole(2), pooling=value)
    plain = DetectorConfig(v=quarters / 4, delta=quarters)
    assert json.dumps(asdict(config)) == json.dumps(asdict(plain))
    assert config.name == plain.name
    wanted = TrainingConfig(Bins(3, coherence_top=0.5), 7, 8, reach=quarters)
    assert json.dumps(asdict(training)) == json.dumps(asdict(wanted))
    assert json.dumps(asdict(provenance)) == json.dumps(
        asdict(Provenance(seed=quarters, smoothness=quarters / 4, reach=2, pooling=quarters / 4))
    )


def test_equal_settings_are_one_text_and_one_name():
    assert json.dumps(asdict(DetectorConfig(v=1))) == json.dumps(asdict(DetectorConfig(v=1.0)))
    assert DetectorConfig(v=1).changed() == ["v 1"]


@pytest.mark.parametrize("values", [{"coherences": True}, {"strength_range": "x"}], ids=repr)
def test_what_is_no_number_makes_no_bins(values):
    with pytest.raises(ValueError, match="is a number"):
        Bins(**values)


@dataclass(frozen=True)
class Deeper(DetectorConfig):
    depth: float = 0.5


@dataclass(frozen=True)
class Alike(DetectorConfig):
    pass


def test_settings_that_a_class_adds_always_stand_in_the_name():
    assert Deeper().name == "default:depth=0.5"
    assert Deeper.paper().name == "paper:depth=0.5"
    assert Deeper(delta=8, depth=np.float32(0.25)).name == "default:delta=8,depth=0.25"
    assert Deeper().changed() == ["depth 0.5"]
    assert (Alike().name, Alike(delta=8).name) == ("Alike", "Alike:delta=8")
