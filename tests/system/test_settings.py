"""Settings: spelt, read back, checked."""

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import ClassVar, Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.config import DetectorConfig
from skyline_viz.system.settings import (
    Configured,
    SettingError,
    from_texts,
    nearest_name,
    spelt,
    within,
)
from testing.examples import examples
from testing.methods import configurations


@dataclass(frozen=True)
class Fine(Configured):
    """A method with a setting of each kind."""

    PRESETS: ClassVar = {"fine": {}, "coarse": {"size": 9}}

    size: int = within(3, 1, 9)
    weight: float = 0.5
    bright: bool = False
    way: Literal["up", "down"] = "up"
    file: Path | None = None
    columns: int | None = None


def texts(**given):
    return from_texts(given, Fine().kinds(), "fine")


def test_values_are_read_from_text():
    read = texts(size="4", weight="1e-3", bright="TRUE", way="down", file="a b.pth", columns="7")
    assert read == {
        "size": 4,
        "weight": 0.001,
        "bright": True,
        "way": "down",
        "file": Path("a b.pth"),
        "columns": 7,
    }
    assert Fine().with_settings(read).settings() == read
    assert texts(columns="none", file="None") == {"columns": None, "file": None}


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"size": "0"}, "size is a whole number from 1 to 9, not 0"),
        ({"size": "4.5"}, "size is a whole number from 1 to 9, not '4.5'"),
        ({"size": "many"}, "size is a whole number from 1 to 9, not 'many'"),
        ({"weight": "nan"}, "weight is a number from 0 to 1,000,000, not nan"),
        ({"weight": "-1"}, "weight is a number from 0 to 1,000,000, not -1"),
        ({"bright": "1"}, "bright is true or false, not '1'"),
        ({"way": "left"}, "way is one of up, down, not 'left'"),
        ({"sise": "3"}, r"fine has no setting sise; did you mean size\?"),
        ({"zzz": "3"}, "fine has no setting zzz; it has size, weight, bright, way"),
        ({"label": "x"}, "fine has no setting label"),
    ],
)
def test_other_values_are_one_sentence(given, says):
    with pytest.raises(SettingError, match=says):
        Fine().with_settings(texts(**given))


def test_a_method_is_called_after_the_nearest_preset():
    assert Fine().name == "fine"
    assert Fine(size=9).name == "coarse"
    assert Fine(size=9, weight=1.0).name == "coarse:weight=1"
    assert Fine(size=8, bright=True).name == "fine:size=8,bright=true"
    assert Fine(size=8).labelled("small").name == "small"
    assert Fine(size=8, label="small").own_name() == "fine:size=8"


def test_names_of_configurations():
    assert DetectorConfig().name == "default"
    assert DetectorConfig.paper().name == "paper"
    assert DetectorConfig(delta=10, v=0.9).name == "default:v=0.9,delta=10"
    paper = DetectorConfig.paper().with_settings({"link_weight": 0.1, "delta": 4})
    assert paper.name == "paper:delta=4,link_weight=0.1"


@examples(60)
@given(configurations)
def test_a_name_says_all_settings(config):
    base, _, rest = config.name.partition(":")
    changed = dict(one.split("=") for one in rest.split(",") if one)
    made = from_texts(changed, DetectorConfig.kinds(), base)
    assert DetectorConfig.presets()[base].with_settings(made) == config
    presets = {name: asdict(one) for name, one in DetectorConfig.presets().items()}
    assert nearest_name(asdict(config), presets) == config.name


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_are_spelt_exactly(number):
    assert float(spelt(number)) == number
