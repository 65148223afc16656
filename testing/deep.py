"""Tests of the extra ``deep``; without its packages they are reported by name as not run."""

from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.util import find_spec

import numpy as np
import pytest

from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline

needs_deep = pytest.mark.skipif(
    find_spec("torch") is None or find_spec("onnx") is None,
    reason="not run, the extra 'deep' is not installed",
)


def deep(module):
    """A module of the extra ``deep``, say ``torch``; skips the test where it is missing."""
    try:
        return import_module(module)
    except ImportError as error:
        pytest.skip(f"not run, the extra 'deep' is not installed: {error}")


@dataclass(frozen=True, eq=False)
class Rendered:
    """A photo of a data set that was never on a disk."""

    scene: object
    hidden: tuple = (0, 0)

    def photo(self):
        return self.scene.photo

    def truth(self):
        visible = np.ones(self.scene.truth.width, bool)
        visible[slice(*self.hidden)] = False
        return Skyline(self.scene.truth.rows, visible)


@cache
def scene(seed):
    return render("clear", seed, 160, 120)


def rendered(seeds):
    return [Rendered(scene(seed)) for seed in seeds]
