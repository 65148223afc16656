"""A sky model from data sets: photos with truth in, an ONNX file out."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping

from skyline_viz._version import __version__
from skyline_viz.sky_model import SEEN, TRAINED
from skyline_viz.sky_training.choosing import Part
from skyline_viz.sky_training.example_file import ExampleFile
from skyline_viz.sky_training.exporting import exported
from skyline_viz.sky_training.fitting import Progress, fit
from skyline_viz.sky_training.sizes import SIZES, STEPS, SizeName
from skyline_viz.system.fingerprints import packed, telling


def learn(
    examples: ExampleFile,
    size: SizeName = "small",
    *,
    parts: Mapping[str, Part] | None = None,
    steps: int = STEPS,
    seed: int = 0,
    progress: Progress = lambda *_: None,
) -> bytes:
    """The ONNX file of a sky model that has learned from examples.

    Args:
        examples: See `examples.example_of`.
        size: One of `sizes.SIZES`.
        parts: How much of each data set was read; all of it unless given.
        steps: How many batches it sees.
        seed: The same seed and examples give the same model, on the same machine.
        progress: What is told of each step.

    Raises:
        ValueError: There is no example.
    """
    if not len(examples):
        raise ValueError("a sky model needs at least one photo with a true skyline")
    sources, parts = examples.sources, parts or {}
    net = fit(
        examples, sources, SIZES[size], parts=parts, steps=steps, seed=seed, progress=progress
    )
    about: dict[str, object] = {"photos": Counter(sources)}
    if any(part.read < part.of for part in parts.values()):
        about["of"] = {name: part.of for name, part in parts.items()}
    about |= {"size": size, "steps": steps, "seed": seed, "skyline-viz": __version__}
    trained = json.dumps(about)
    seen = packed(telling([one for one in examples.seen if one]))
    return exported(net, {TRAINED: trained, SEEN: seen})
