"""A sky model from data sets: photos with truth in, an ONNX file out."""

from __future__ import annotations

import json
from collections.abc import Iterable

import numpy as np

from skyline_viz._version import __version__
from skyline_viz.arrays import U8
from skyline_viz.datasets.item import Item
from skyline_viz.sky_model import SkyModel
from skyline_viz.sky_training.examples import Example, squeezed
from skyline_viz.sky_training.exporting import exported
from skyline_viz.sky_training.fitting import Progress, fit
from skyline_viz.sky_training.sizes import SIZES, SizeName

STEPS = 8000
"""Batches that a model sees unless told otherwise."""


def learn(
    examples: Iterable[Example],
    size: SizeName = "small",
    *,
    steps: int = STEPS,
    seed: int = 0,
    progress: Progress = lambda *_: None,
) -> bytes:
    """The ONNX file of a sky model that has learned from examples.

    Args:
        examples: See `example_of`.
        size: One of `sizes.SIZES`.
        steps: How many batches it sees.
        seed: The same seed and examples give the same model, on the same machine.
        progress: What is told of each step.

    Raises:
        ValueError: There is no example.
    """
    known = list(examples)
    if not known:
        raise ValueError("a sky model needs at least one photo with a true skyline")
    sources: dict[str, int] = {}
    for one in known:
        sources[one.source] = sources.get(one.source, 0) + 1
    net = fit(known, SIZES[size], steps=steps, seed=seed, progress=progress)
    about = {"size": size, "steps": steps, "seed": seed, "skyline-viz": __version__}
    return exported(net, {"trained": json.dumps({"photos": sources, **about})})


def example_of(item: Item, source: str, teacher: SkyModel | None = None) -> Example | None:
    """What there is to learn from a photo of a data set; None for nothing.

    Args:
        item: A photo, with its truth or without.
        source: Name of the data set.
        teacher: A network that says what is sky in a photo without truth.

    Raises:
        PhotoError: The photo cannot be read.
        SkylineError: Its truth does not fit.
    """
    truth = item.truth()
    if truth is not None:
        return Example.of(item.photo(), truth, source) if truth.visible.any() else None
    return taught(item.photo(), teacher, source) if teacher is not None else None


def taught(photo: U8, teacher: SkyModel, source: str) -> Example:
    """The example of a photo ``(H, W, 3)`` of which a teacher says what is sky.

    It sees the photo mirrored as well, and the mean of both is taken.
    """
    mirrored = np.ascontiguousarray(photo[:, ::-1])
    sky = (teacher.sky(photo) + teacher.sky(mirrored)[:, ::-1]) / 2
    levels = np.rint(sky * 255).astype(np.uint8)
    return Example(squeezed(photo), squeezed(levels), source)
