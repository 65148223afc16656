"""The networks of scene parsing, in PyTorch: FCN-32s, FCN-16s and FCN-8s, and SegNet, over VGG-16.

Each gives a logit of sky for every pixel of photos whose sides are multiples of 32; sky against
terrain needs no more than one. What differs from the published networks:

* ``width`` scales the channels of every layer; 1 is the published size.
* Without pretrained weights, FCNs have batch normalisation after every convolution, as SegNet
  always has: from scratch, 15 layers do not learn without.
* FCNs keep the photo's size by a padding of 3 in ``fc6``, instead of one of 100 before the first
  layer that the crops after it undo.

This module needs PyTorch; `methods.parsing` imports it when a network is trained.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import torch
from torch import nn
from torch.nn import functional as fn

from skyline_viz.method import MethodError
from skyline_viz.methods.parsing import Architecture

STAGES = ((64, 2), (128, 2), (256, 3), (512, 3), (512, 3))
"""Channels and number of the convolutions of VGG-16 between its five poolings."""

DENSE = 4096
"""Channels of the two dense layers, which are convolutions here."""

Tensor: TypeAlias = Any


def build(architecture: Architecture, width: float, normalised: bool) -> SceneNet:
    """A network with random weights.

    Args:
        architecture: Which.
        width: Share of the published channels.
        normalised: Whether an FCN has batch normalisation.
    """
    if architecture == "segnet":
        return SegNet(width)
    return Fcn({"fcn-8s": 3, "fcn-16s": 4, "fcn-32s": 5}[architecture], width, normalised)


class SceneNet(nn.Module):  # type: ignore[misc]  # torch is not read by mypy
    """The stages of VGG-16."""

    def __init__(self, width: float, normalised: bool) -> None:
        super().__init__()
        self.channels = [scaled(channels, width) for channels, _ in STAGES]
        self.stages = nn.ModuleList()
        before = 3
        for channels, (_, count) in zip(self.channels, STAGES, strict=True):
            self.stages.append(convolutions([before] + [channels] * count, normalised))
            before = channels

    def backbone(self) -> Iterator[tuple[str, nn.Conv2d]]:
        """The 13 convolutions of VGG-16, by the names they have in files: ``features.N``."""
        number = 0
        for stage in self.stages:
            for layer in stage:
                if isinstance(layer, nn.Conv2d):
                    yield f"features.{number}", layer
                    number += 2  # a ReLU stands between
            number += 1  # and a pooling behind


class Fcn(SceneNet):
    """Fully convolutional networks (Long et al., 2015): scores of coarse stages, scaled up.

    Scores of stage 5, of stride 32, are scaled up by 2 and added to those of the pooling before as
    often as there are finer stages, and then to the size of the photo at once.
    """

    def __init__(self, finest: int, width: float, normalised: bool) -> None:
        """`finest` is the pooling whose scores come last: 5 for FCN-32s, 4 and 3 for the others."""
        super().__init__(width, normalised)
        self.finest = finest
        dense = scaled(DENSE, width)
        self.fc6 = convolutions([self.channels[-1], dense], normalised, size=7)
        self.fc7 = convolutions([dense, dense], normalised, size=1)
        self.score = nn.Conv2d(dense, 1, 1)
        self.skips = nn.ModuleList(
            nn.Conv2d(self.channels[pool - 1], 1, 1) for pool in range(4, finest - 1, -1)
        )
        self.ups = nn.ModuleList(enlarging(2) for _ in self.skips)
        self.last = enlarging(2**finest)
        for layer in (self.score, *self.skips):  # as published: they begin with no opinion
            nn.init.zeros_(layer.weight)
            nn.init.zeros_(layer.bias)

    def forward(self, photos: Tensor) -> Tensor:
        """Logits ``(N, 1, H, W)`` of photos ``(N, 3, H, W)``."""
        x, pools = photos, []
        for stage in self.stages:
            x = fn.max_pool2d(stage(x), 2)
            pools.append(x)
        x = fn.dropout(self.fc6(x), 0.5, self.training)
        x = fn.dropout(self.fc7(x), 0.5, self.training)
        x = self.score(x)
        for pool, skip, up in zip(pools[3::-1], self.skips, self.ups, strict=False):
            x = up(x) + skip(pool)
        return self.last(x)


class SegNet(SceneNet):
    """SegNet (Badrinarayanan et al., 2017).

    The decoder mirrors VGG-16, and puts values back where the poolings took them from.
    """

    def __init__(self, width: float) -> None:
        super().__init__(width, normalised=True)
        self.decoder = nn.ModuleList()
        nexts = [*self.channels[-2::-1], self.channels[0]]
        for channels, after, (_, count) in zip(
            self.channels[::-1], nexts, STAGES[::-1], strict=True
        ):
            self.decoder.append(convolutions([channels] * count + [after], normalised=True))
        self.score = nn.Conv2d(self.channels[0], 1, 3, padding=1)

    def forward(self, photos: Tensor) -> Tensor:
        """Logits ``(N, 1, H, W)`` of photos ``(N, 3, H, W)``."""
        x, pooled = photos, []
        for stage in self.stages:
            full = stage(x)
            x = fn.max_pool2d(full, 2)
            pooled.append((full, x))
        for (full, top), stage in zip(pooled[::-1], self.decoder, strict=True):
            x = stage(put_back(x, full, top))
        return self.score(x)


def put_back(values: Tensor, full: Tensor, top: Tensor) -> Tensor:
    """Unpooling: each value goes where its window had its maximum, the first one among equals.

    The same as ``max_unpool2d`` with the indices of ``max_pool2d``, which neither exporter nor
    OpenCV know; of comparisons and strided slices, which both do.

    Args:
        values: ``(N, C, h, w)`` what is put back.
        full: ``(N, C, 2 h, 2 w)`` what was pooled.
        top: ``(N, C, h, w)`` its maxima.

    Returns:
        ``(N, C, 2 h, 2 w)``, zero elsewhere.
    """
    channels = int(values.shape[1])
    whole, free = None, None
    for row in (0, 1):
        for column in (0, 1):
            hit = (full[:, :, row::2, column::2] >= top).to(values.dtype)
            first = hit if free is None else hit * free
            free = 1 - first if free is None else free - first
            corner = np.zeros((channels, 1, 2, 2), np.float32)  # by numpy: a constant in the file
            corner[:, 0, row, column] = 1
            part = fn.conv_transpose2d(
                first * values, torch.from_numpy(corner), stride=2, groups=channels
            )
            whole = part if whole is None else whole + part
    return whole


def convolutions(channels: list[int], normalised: bool, size: int = 3) -> nn.Sequential:
    """Convolutions with ReLU that keep the size, between so many channels."""
    layers: list[nn.Module] = []
    for before, after in pairwise(channels):
        layers.append(nn.Conv2d(before, after, size, padding=size // 2))
        nn.init.kaiming_normal_(layers[-1].weight, nonlinearity="relu")
        nn.init.zeros_(layers[-1].bias)
        if normalised:
            layers.append(nn.BatchNorm2d(after))
        layers.append(nn.ReLU())
    return nn.Sequential(*layers)


def enlarging(factor: int) -> nn.ConvTranspose2d:
    """A transposed convolution that scales one channel up by a power of two; bilinear at first."""
    layer = nn.ConvTranspose2d(1, 1, 2 * factor, stride=factor, padding=factor // 2, bias=False)
    away = torch.arange(2 * factor) - (factor - 0.5)
    line = 1 - away.abs() / factor
    layer.weight.data[0, 0] = line[:, None] * line[None, :]
    return layer


def scaled(channels: int, width: float) -> int:
    """Channels of a layer at some width, at least 2."""
    return max(round(channels * width), 2)


def load_backbone(net: SceneNet, path: Path) -> None:
    """Read pretrained weights of the backbone: a state dict of VGG-16, ``features.N.weight``.

    Other entries (its classifier) are left alone.

    Raises:
        MethodError: The file cannot be read, or does not hold these layers in these shapes.
    """
    try:
        state = torch.load(path, map_location="cpu", weights_only=True)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise MethodError(f"{path} cannot be read: {reason}.") from error
    except Exception as error:  # whatever unpickling foreign bytes ends in
        raise MethodError(f"{path} is not a PyTorch file of weights.") from error
    if not isinstance(state, dict):
        raise MethodError(f"{path} holds no state dict of VGG-16, but a {type(state).__name__}.")
    for name, layer in net.backbone():
        for part in ("weight", "bias"):
            own, given = getattr(layer, part), state.get(f"{name}.{part}")
            if not isinstance(given, torch.Tensor):
                raise MethodError(f"{path} has no {name}.{part}, which VGG-16 has.")
            if given.shape != own.shape:
                raise MethodError(
                    f"{path} has {name}.{part} of the shape {tuple(given.shape)}, and the network "
                    f"{tuple(own.shape)}; published weights need a width of 1."
                )
            own.data.copy_(given)
