"""A sky model from data sets: photos with truth in, an ONNX file out."""

from __future__ import annotations

import json
from collections.abc import Iterable

from skyline_viz._version import __version__
from skyline_viz.sky_model import SEEN, TRAINED
from skyline_viz.sky_training.examples import Example
from skyline_viz.sky_training.exporting import exported
from skyline_viz.sky_training.fitting import Progress, fit
from skyline_viz.sky_training.sizes import SIZES, STEPS, SizeName
from skyline_viz.system.fingerprints import packed, telling


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
        examples: See `examples.example_of`.
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
    trained = json.dumps({"photos": sources, **about})
    seen = packed(telling([one.seen for one in known if one.seen]))
    return exported(net, {TRAINED: trained, SEEN: seen})
