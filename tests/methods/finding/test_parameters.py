"""Settings of objects, read from attributes that are called like parameters."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.methods.finding.parameters import UNTOLD, checked, kinds_of, made_with
from skyline_viz.system.settings import SettingError


class Row:
    def __init__(self, row, blur: float = 2.0, file: Path | None = None, *, model=None):
        self.row, self.blur, self.file, self.model = row, blur, file, model


@dataclass
class Field:
    row: int = 3
    size: int = None


class Hidden:
    def __init__(self, row=3):
        self._row = row


class Rest:
    def __init__(self, *rows, **more):
        self.rows, self.more = rows, more


@given(
    st.integers() | st.booleans() | st.text(min_size=1) | st.floats(allow_nan=False),
    st.floats(allow_nan=False),
)
def test_settings_of_an_object_make_it_again(row, blur):
    told = made_with(Row(row, blur))
    again = Row(**told)
    assert (again.row, again.blur) == (row, blur)
    assert ("blur" in told) == (blur != 2.0)
    assert checked(told, kinds_of(Row)) == told


def test_fields_of_a_dataclass_are_settings_and_default_ones_are_not_told():
    assert made_with(Field()) == {}
    assert made_with(Field(5)) == {"row": 5}
    assert made_with(Row(3, file=Path("a"))) == {"row": 3, "file": Path("a")}


def test_numbers_become_pythons_own():
    assert [type(one) for one in made_with(Row(np.int64(3), np.float32(0.5))).values()] == [
        int,
        float,
    ]


@pytest.mark.parametrize(
    "inner",
    [Hidden(), Rest(1), Row(np.zeros(3)), Row(Path("a")), Row([1]), Field(size=3.5), object],
    ids=["hidden", "rest", "array", "path", "list", "another kind", "type"],
)
def test_what_cannot_be_told_is_nothing(inner):
    assert made_with(inner) is None


def test_kinds_are_annotations_or_those_of_defaults():
    assert kinds_of(Row) == {"row": UNTOLD, "blur": float, "file": Path | None}
    with pytest.raises(SettingError, match="there is no setting rows"):
        checked({"rows": 3}, kinds_of(Row))
    with pytest.raises(SettingError, match="blur is a number"):
        checked({"blur": "x"}, kinds_of(Row))
