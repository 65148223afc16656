"""The sizes of sky models."""

from typing import get_args

import pytest

from skyline_viz.sky_training.sizes import SIZES, SizeName


def test_each_name_is_a_size():
    assert set(SIZES) == set(get_args(SizeName))


@pytest.mark.parametrize("name", SIZES)
def test_an_input_can_be_halved_at_every_scale(name):
    size = SIZES[name]
    assert (size.rows % 2 ** len(size.widths), size.columns % 2 ** len(size.widths)) == (0, 0)
    assert size.rows > size.columns  # a far ridge is low and wide
