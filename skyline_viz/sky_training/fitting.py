"""Fitting a sky model: what it is judged by, and how its weights get better."""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence

import numpy as np
import torch
from torch.nn import functional

from skyline_viz.arrays import F64
from skyline_viz.sky_training.examples import Example
from skyline_viz.sky_training.layers import flat, layered, whole
from skyline_viz.sky_training.network import SkyNet
from skyline_viz.sky_training.sizes import Size
from skyline_viz.sky_training.variation import varied

BATCH = 16
"""Photos a step."""

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
    examples: Sequence[Example],
    size: Size,
    *,
    steps: int,
    seed: int = 0,
    progress: Progress = lambda *_: None,
) -> SkyNet:
    """A network that has learned from examples.

    Data sets are drawn by the square root of their number of photos: a large one counts for more,
    but not for all.

    Args:
        examples: At least one.
        size: Its size.
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
    share = shares(examples)
    net.train()
    for step in range(1, steps + 1):
        photos, skies = batch(examples, share, size, rng)
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


def shares(examples: Sequence[Example]) -> F64:
    """How often each example is drawn, ``(n,)``, in sum 1."""
    sources = np.array([one.source for one in examples])
    _, index, counts = np.unique(sources, return_inverse=True, return_counts=True)
    share = 1 / np.sqrt(counts[index])
    return np.asarray(share / share.sum())


def batch(
    examples: Sequence[Example], share: F64, size: Size, rng: np.random.Generator
) -> tuple[torch.Tensor, torch.Tensor]:
    """Photos ``(N, 3, rows, columns)`` and their sky ``(N, 1, rows / 2, columns / 2)``."""
    photos, skies = [], []
    for index in rng.choice(len(examples), BATCH, p=share):
        one = examples[index]
        if one.line is not None and rng.random() < NEW:
            others = [examples[other] for other in rng.choice(len(examples), 6, p=share)]
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
