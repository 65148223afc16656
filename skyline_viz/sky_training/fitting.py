"""Fitting a sky model: what it is judged by, and how its weights get better."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping, Sequence

import numpy as np
import torch
from torch.nn import functional

from skyline_viz.arrays import F64
from skyline_viz.sky_training.choosing import WHOLE, Part
from skyline_viz.sky_training.example_file import Examples
from skyline_viz.sky_training.layers import flat, layered, whole
from skyline_viz.sky_training.network import SkyNet
from skyline_viz.sky_training.sizes import BATCH, Size
from skyline_viz.sky_training.variation import varied

RATE = 5e-3
"""Highest learning rate."""

NEW = 0.4
"""Share of the photos that are put together from several."""

FLAT = 0.06
"""Share of those that keep their line, and no more: two flat tones."""

MEMORY = 0.998
"""How slowly the average of the weights, which is what is kept, follows them."""

Progress = Callable[[int, float], None]
"""Called with each step, from 1, and its loss."""


def fit(
    examples: Examples,
    sources: Sequence[str],
    size: Size,
    *,
    parts: Mapping[str, Part] | None = None,
    steps: int,
    seed: int = 0,
    progress: Progress = lambda *_: None,
) -> SkyNet:
    """A network that has learned from examples.

    Data sets are drawn by the square root of their number of photos: a large one counts for more,
    but not for all. No example is looked at before it is drawn.

    Args:
        examples: At least one.
        sources: Data set that each of them is from.
        size: Its size.
        parts: How much of each data set was read; all of it unless given.
        steps: How many batches it sees.
        seed: The same seed and examples give the same network, on the same machine.
        progress: What is told of each step.
    """
    torch.manual_seed(seed)
    rng = np.random.default_rng(seed)
    net = SkyNet(size).to(memory_format=torch.channels_last)
    average: SkyNet = copy.deepcopy(net)
    optimiser = torch.optim.AdamW(net.parameters(), lr=RATE, weight_decay=1e-2)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, RATE, total_steps=steps)
    upto = shares(sources, parts or {}).cumsum()
    upto /= upto[-1]
    net.train()
    for step in range(1, steps + 1):
        photos, skies = batch(examples, upto, size, rng)
        loss = judged(net(photos), skies)
        optimiser.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(net.parameters(), 2.0)
        optimiser.step()
        schedule.step()
        follow(average, net, min(MEMORY, step / (step + 20)))
        progress(step, float(loss.detach()))
    average.eval()
    return average


def shares(sources: Sequence[str], parts: Mapping[str, Part]) -> F64:
    """How often each example is drawn, ``(n,)``, in sum 1.

    Args:
        sources: Data set that each of them is from.
        parts: How much of each data set was read, where that is not all of it.
    """
    names, index, counts = np.unique(np.array(sources), return_inverse=True, return_counts=True)
    weights = np.array([parts.get(name, WHOLE).weight for name in names])
    share = (np.sqrt(weights) / np.sqrt(counts))[index]
    return np.asarray(share / share.sum())


def drawn(upto: F64, count: int, rng: np.random.Generator) -> list[int]:
    """Places of examples, with replacement: those that `Generator.choice` gives.

    That adds the shares up anew each time, which takes 0.7 ms for 100,000 of them.

    Args:
        upto: ``(n,)`` the share of each example and of those before it together.
        count: How many.
        rng: What is drawn.
    """
    places: list[int] = upto.searchsorted(rng.random(count), side="right").tolist()
    return places


def batch(
    examples: Examples, upto: F64, size: Size, rng: np.random.Generator
) -> tuple[torch.Tensor, torch.Tensor]:
    """Photos ``(N, 3, rows, columns)`` and their sky ``(N, 1, rows / 2, columns / 2)``.

    Args:
        examples: What to draw from.
        upto: How often, see `drawn`.
        size: That of the network.
        rng: What is drawn.
    """
    photos, skies = [], []
    for index in drawn(upto, BATCH, rng):
        one = examples[index]
        if one.line is not None and rng.random() < NEW:
            others = [examples[other] for other in drawn(upto, 6, rng)]
            layers = layered(one, others, rng)
            if rng.random() < FLAT:
                layers = flat(layers[1], rng)
        else:
            layers = whole(one)
        photo, sky = varied(layers, (size.rows, size.columns), rng)
        photos.append(torch.from_numpy(photo.transpose(2, 0, 1).copy()))
        skies.append(torch.from_numpy(sky)[None])
    stacked = torch.stack(photos).to(memory_format=torch.channels_last)
    return stacked, functional.avg_pool2d(torch.stack(skies), 2)


def judged(logits: torch.Tensor, sky: torch.Tensor) -> torch.Tensor:
    r"""The loss: each region is judged by itself, and each column as a whole.

    A column is sky down to one row. The likelihood of that row $r$ under the map is proportional
    to $\exp \sum_{k < r} x_k$, with $x$ the logits, so the second part asks for the very sum that
    the detector's sky term takes. It says nothing once the right row is far ahead, and all the
    more where another ridge is.

    Args:
        logits: ``(N, 1, h, w)``.
        sky: ``(N, 1, h, w)``, in [0, 1].
    """
    regions = functional.binary_cross_entropy_with_logits(logits, sky)
    height = sky.shape[2]
    rows = sky.sum(2)  # where the sky of each column ends
    places = torch.arange(height, dtype=sky.dtype).view(1, 1, -1, 1)
    above = (rows.unsqueeze(2) - places).clamp(0, 1)
    one_line = (above - sky).abs().mean(2) < 0.02
    sums = functional.pad(logits.cumsum(2), (0, 0, 1, 0))
    likelihood = functional.log_softmax(sums, 2)
    before = rows.floor().clamp(max=height - 1).long().unsqueeze(2)
    share = rows.unsqueeze(2) - before
    of_row = likelihood.gather(2, before) * (1 - share) + likelihood.gather(2, before + 1) * share
    lost = -of_row.squeeze(2).clamp(min=-60) * one_line
    return regions + COLUMN * lost.mean() / height


COLUMN = 1.0
"""Weight of whole columns against single regions."""


def follow(average: SkyNet, net: SkyNet, memory: float) -> None:
    """Move the average of the weights towards the present ones."""
    with torch.no_grad():
        for kept, now in zip(average.state_dict().values(), net.state_dict().values(), strict=True):
            if kept.dtype.is_floating_point:
                kept.lerp_(now, 1 - memory)
            else:
                kept.copy_(now)
