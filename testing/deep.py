"""Tests of the extra ``deep``; without its packages they are reported by name as not run."""

from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.util import find_spec

import numpy as np
import pytest

from skyline_viz.rendering import render
from skyline_viz.sky_training.example_file import ExampleFile
from skyline_viz.sky_training.examples import COLUMNS, ROWS, Example
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


def sky_examples(count, source="hills"):
    """Examples for sky models: bright sky over dark, rough terrain."""
    rng = np.random.default_rng(0)
    found = []
    for number in range(count):
        line = rng.uniform(80, 300) + 40 * np.sin(np.arange(COLUMNS) / rng.uniform(20, 60))
        sky = np.arange(ROWS)[:, None] < line
        rough = rng.integers(0, 90, (ROWS, COLUMNS, 3))
        photo = np.where(sky[..., None], 200, rough).astype(np.uint8)
        found.append(Example(photo, (sky * 255).astype(np.uint8), source, f"{number:080x}"))
    return found


def lineless(source="hills"):
    """An example whose sky lies below terrain."""
    sky = np.zeros((ROWS, COLUMNS), np.uint8)
    sky[100:200] = 255
    return Example(np.full((ROWS, COLUMNS, 3), 90, np.uint8), sky, source)


def kept(examples):
    """The same in a file, to be closed."""
    file = ExampleFile(len(examples))
    for one in examples:
        file.append(one)
    return file
