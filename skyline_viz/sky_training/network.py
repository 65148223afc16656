"""The network of a sky model: small photos in, a map of sky out, by a U-Net of separable layers.

What finds a ridge three grey levels from the sky is brightness less its surroundings', over their
deviation. It is computed in the network, from means over coarse blocks, which cost nothing.
"""

from __future__ import annotations

from itertools import pairwise

import torch
from torch import nn
from torch.nn import functional

from skyline_viz.sky_training.sizes import Size

BLOCK = 16
"""Side of the blocks that surroundings are averaged over, in pixels of the input."""


def separable(inputs: int, outputs: int, stride: int = 1) -> nn.Sequential:
    """A 3x3 filter of each channel, then a mix of the channels."""
    return nn.Sequential(
        nn.Conv2d(inputs, inputs, 3, stride, 1, groups=inputs, bias=False),
        nn.BatchNorm2d(inputs),
        nn.ReLU(inplace=True),
        nn.Conv2d(inputs, outputs, 1, bias=False),
        nn.BatchNorm2d(outputs),
        nn.ReLU(inplace=True),
    )


class SkyNet(nn.Module):  # type: ignore[misc]  # torch may be missing
    """``(N, 3, h, w)`` RGB in [0, 1] -> ``(N, 1, h / 2, w / 2)`` logits of sky."""

    def __init__(self, size: Size) -> None:
        super().__init__()
        self.size = size
        widths = size.widths
        pairs = list(pairwise(widths))
        self.stem = nn.Sequential(
            nn.Conv2d(4, widths[0], 3, 2, 1, bias=False), nn.BatchNorm2d(widths[0])
        )
        # means over what is inside the photo: OpenCV's classic engine knows only those over zeros
        # around it, too
        inside = 1 / pooled(torch.ones(1, 1, size.rows, size.columns))
        self.register_buffer("inside", inside, persistent=False)
        # where in the photo it is, from top to bottom
        slope = torch.linspace(-1, 1, size.rows // 2).view(1, 1, -1, 1)
        self.place = nn.Parameter(slope * torch.randn(1, widths[0], 1, 1) * 0.5)
        self.down = nn.ModuleList(
            nn.Sequential(separable(a, b, 2), *(separable(b, b) for _ in range(size.depth)))
            for a, b in pairs
        )
        self.whole = nn.Conv2d(widths[-1], widths[-1], 1)
        self.up = nn.ModuleList(separable(b + a, a) for a, b in pairs)
        self.out = nn.Conv2d(widths[0], 1, 1)

    def forward(self, photo: torch.Tensor) -> torch.Tensor:
        """Logits of sky."""
        grey = photo.mean(1, keepdim=True)
        blocks = pooled(torch.cat([grey, grey * grey], 1)) * self.inside
        around = functional.interpolate(
            blocks, size=photo.shape[-2:], mode="bilinear", align_corners=False
        )
        mean, square = around[:, :1], around[:, 1:]
        deviation = torch.sqrt(functional.relu(square - mean * mean) + 2e-5)
        stem = self.stem(torch.cat([photo * 2 - 1, (grey - mean) / deviation * 0.5], 1))
        levels = [functional.relu(stem) + self.place]
        for block in self.down:
            levels.append(block(levels[-1]))
        coarse = levels.pop()
        coarse = coarse + functional.relu(self.whole(coarse.mean((2, 3), keepdim=True)))
        for block in reversed(self.up):
            fine = levels.pop()
            coarse = block(torch.cat([wider(coarse, fine), fine], 1))
        return self.out(coarse)


def pooled(maps: torch.Tensor) -> torch.Tensor:
    """Means over overlapping blocks, with zeros around the maps."""
    return functional.avg_pool2d(maps, BLOCK, BLOCK // 2, BLOCK // 4)


def wider(coarse: torch.Tensor, like: torch.Tensor) -> torch.Tensor:
    """Maps interpolated to the rows and columns of other ones."""
    size = like.shape[-2:]
    return functional.interpolate(coarse, size=size, mode="bilinear", align_corners=False)
