"""Training of a scene-parsing network, in PyTorch, up to the ONNX file.

Photos are shown at their training size, scaled, shifted and mirrored at random. The target of a
pixel is the share of it that is sky, so that small photos teach where between two pixels the line
runs; columns where the truth is not visible do not count.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

import cv2
import numpy as np
import torch
from torch.nn import functional as fn

from skyline_viz.arrays import F32, U8
from skyline_viz.methods.parsing import Architecture
from skyline_viz.methods.parsing_nets import SceneNet, build, load_backbone
from skyline_viz.networks.onnx_files import MEAN, STD, normalised
from skyline_viz.skyline import Skyline

BATCH = 4
"""Photos of a step."""

RATE = 2e-3
"""Highest learning rate."""

WEIGHT_DECAY = 1e-4
"""Of the optimiser (AdamW)."""

SCALES = (0.8, 1.25)
"""Least and largest factor by which a photo is scaled at random."""


Batch: TypeAlias = tuple[Any, Any, Any]
"""Photos ``(N, 3, H, W)``, shares of sky ``(N, H, W)`` and which of them count, as tensors."""


@dataclass(frozen=True, eq=False)
class Lesson:
    """A photo at the training size."""

    photo: U8
    """``(h, w, 3)`` uint8 RGB."""

    target: F32
    """``(h, w, 2)``: the share of each pixel that is known as sky, and the share that is known."""


def train_network(
    pairs: Sequence[tuple[U8, Skyline]],
    architecture: Architecture,
    seed: int,
    *,
    width: float,
    epochs: int,
    columns: int,
    pretrained: Path | None,
) -> bytes:
    """Train a network, and export it.

    Args:
        pairs: Photos ``(H, W, 3)`` uint8 RGB and their truths.
        architecture: Which network.
        seed: Seed of all that is drawn; equal ones give equal networks on the same computer.
        width: Share of the published channels.
        epochs: Times that every photo is shown.
        columns: Columns that photos are scaled to.
        pretrained: File of pretrained weights of the backbone.

    Returns:
        An ONNX file: photos ``(1, 3, h, w)`` in, logits of sky ``(1, 1, h, w)`` out.

    Raises:
        MethodError: The pretrained weights do not fit.
    """
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        net = build(architecture, width, normalised=pretrained is None)
        if pretrained is not None:
            load_backbone(net, pretrained)
        lessons = [lesson(photo, truth, columns) for photo, truth in pairs]
        fit(net, lessons, epochs, np.random.default_rng(seed), pretrained is not None)
    return export(net)


def lesson(photo: U8, truth: Skyline, columns: int) -> Lesson:
    """A photo and its truth, scaled to so many columns."""
    height, width = photo.shape[:2]
    size = (columns, max(round(height * columns / width), 1))
    rows = np.arange(height, dtype=np.float32)[:, None]
    sky = np.clip(truth.rows[None, :] - rows, 0, 1)
    counts = np.broadcast_to(truth.visible[None, :], sky.shape)
    target = np.dstack([sky * counts, counts]).astype(np.float32)
    small = cv2.resize(photo, size, interpolation=cv2.INTER_AREA)
    return Lesson(small, cv2.resize(target, size, interpolation=cv2.INTER_AREA))


def fit(
    net: SceneNet, lessons: Sequence[Lesson], epochs: int, rng: np.random.Generator, gentle: bool
) -> None:
    """Train a network in place; `gentle` is the lower learning rate of pretrained ones."""
    steps = max(epochs * len(lessons) // BATCH, 1)
    rate = RATE / 20 if gentle else RATE
    optimiser = torch.optim.AdamW(net.parameters(), lr=rate, weight_decay=WEIGHT_DECAY)
    batches = shown(lessons, rng)
    net.train()
    for step in range(steps):
        for group in optimiser.param_groups:
            group["lr"] = rate * eased(step / steps)
        photos, target, counts = next(batches)
        loss = fn.binary_cross_entropy_with_logits(net(photos)[:, 0], target, counts)
        optimiser.zero_grad()
        (loss / counts.mean().clamp(min=1e-3)).backward()
        torch.nn.utils.clip_grad_norm_(net.parameters(), 5.0)
        optimiser.step()
    net.eval()
    settle(net, lessons, batches)


def settle(net: SceneNet, lessons: Sequence[Lesson], batches: Iterator[Batch]) -> None:
    """Measure the means and variances of the batch normalisation anew, with the final weights.

    Those gathered in training lag behind the weights; after a short one they are far off.
    """
    layers = [layer for layer in net.modules() if isinstance(layer, torch.nn.BatchNorm2d)]
    for layer in layers:
        layer.reset_running_stats()
        layer.momentum = None  # the plain mean of all batches
        layer.train()
    with torch.no_grad():
        for _ in range(2 * max(len(lessons) // BATCH, 1) if layers else 0):
            net(next(batches)[0])
    net.eval()


def shown(lessons: Sequence[Lesson], rng: np.random.Generator) -> Iterator[Batch]:
    """Batches without end: photos, each varied, all shown equally often."""
    tallest = max(len(one.photo) for one in lessons)
    rows, columns = (side + -side % 32 for side in (tallest, lessons[0].photo.shape[1]))
    order: list[int] = []
    while True:
        while len(order) < BATCH:
            order += rng.permutation(len(lessons)).tolist()
        chosen = [varied(lessons[order.pop(0)], (rows, columns), rng) for _ in range(BATCH)]
        photos = torch.from_numpy(np.concatenate([photo for photo, _ in chosen]))
        target, counts = torch.from_numpy(np.stack([one for _, one in chosen])).unbind(-1)
        yield photos, target, counts


def eased(done: float) -> float:
    """Share of the highest learning rate when a share of the steps is done: up, and slowly down."""
    warm = 0.2
    return (
        (done + 0.01) / (warm + 0.01)
        if done < warm
        else 0.5 + 0.5 * float(np.cos(np.pi * (done - warm) / (1 - warm)))
    )


def varied(one: Lesson, size: tuple[int, int], rng: np.random.Generator) -> tuple[F32, F32]:
    """A photo ``(1, 3, *size)`` scaled, shifted and mirrored at random, and target ``(*size, 2)``.

    What lies outside the photo repeats its rim, as detecting does, and does not count.
    """
    height, width = one.photo.shape[:2]
    scale = float(np.exp(rng.uniform(*np.log(SCALES))))
    room = [side - scale * given for side, given in zip(size, (height, width), strict=True)]
    down, across = (rng.uniform(min(free, 0), max(free, 0)) for free in room)
    matrix = np.array([[scale, 0, across], [0, scale, down]])
    if rng.random() < 0.5:
        matrix[0] = [-scale, 0, across + scale * (width - 1)]
    across_first = size[::-1]
    photo = cv2.warpAffine(
        one.photo, matrix, across_first, flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    light = rng.uniform(0.8, 1.2) * photo.astype(np.float32) + rng.uniform(-20, 20)
    target = cv2.warpAffine(one.target, matrix, across_first, flags=cv2.INTER_LINEAR)
    shares = target[..., 0] / np.maximum(target[..., 1], 1e-3)  # only where they count at all
    target[..., 0] = np.clip(np.where(target[..., 1] > 0.5, shares, 0), 0, 1)
    target[..., 1] = target[..., 1] > 0.5
    return normalised(light.clip(0, 255).astype(np.uint8), MEAN, STD), target


def export(net: SceneNet) -> bytes:
    """A network as an ONNX file, for photos of any size that is a multiple of 32.

    The file names one size: OpenCV 4 takes that for an example, runs others too, and cannot read
    FCN-8s when the size is left open.
    """
    file = io.BytesIO()
    with warnings.catch_warnings():
        # the exporter by tracing is on its way out, but OpenCV reads what it writes
        warnings.simplefilter("ignore")
        torch.onnx.export(
            net,
            (torch.zeros(1, 3, 64, 96),),
            file,
            dynamo=False,
            opset_version=12,
            input_names=["photo"],
            output_names=["sky"],
        )
    return file.getvalue()
