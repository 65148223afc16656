r"""Sky or terrain: what the photo looks like block by block, edges and learned filters aside.

Ours, not the paper's. The underside of a cloud can be as strong an edge as a ridge, but what lies
below it still looks like sky. A linear model $\mathbf{w}$ of a dozen features $\mathbf{f}$ of 8x8
pixel blocks says so roughly, in about a tenth of a detection's time. Summed down the columns it
tells, for every pixel, how well "all sky above here, all terrain below" fits the photo. In the
centre of a block, where the block itself counts half:

$$
t(i, j) = \frac{1}{H} \sum_{k \le i} \text{clip}(\mathbf{w}^T \mathbf{f}(k, j), -1, 1)
$$
"""

import cv2
import numpy as np

from skyline_viz.arrays import F32, F64, U8, Bool
from skyline_viz.skyline import Skyline

BLOCK = 8
"""Side of a block, in pixels."""

FEATURES = 12
"""Number of features of a block."""

_TOP_SHARE = 12  # the top twelfth of a photo stands for its sky


def block_features(photo: U8, edges: Bool) -> F32:
    """Features of every block, ``(h, w, FEATURES)``.

    How dense edges are here and in two neighbourhoods; brightness, colour and saturation; and how
    the block differs from the top of the photo in colour and in brightness.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        edges: ``(H, W)`` edge map.

    Examples:
        >>> photo = np.full((40, 64, 3), 200, np.uint8)
        >>> block_features(photo, np.zeros((40, 64), bool)).shape
        (5, 8, 12)
    """
    colour = _block_means(photo)
    density = _block_means(edges.view(np.uint8) * np.uint8(255))
    red, green, blue = np.moveaxis(colour, 2, 0)
    brightness = (red + green + blue) / np.float32(3)
    saturation = np.maximum(np.maximum(red, green), blue) - np.minimum(np.minimum(red, green), blue)
    top = colour[: max(1, len(colour) // _TOP_SHARE)].reshape(-1, 3).mean(axis=0)
    return np.stack(
        [
            np.ones_like(brightness),
            np.sqrt(density),
            np.sqrt(cv2.blur(density, (5, 5))),
            np.sqrt(cv2.blur(density, (15, 15))),
            brightness,
            brightness * brightness,
            blue - red,
            np.abs(blue - red),
            green - (red + blue) / 2,
            saturation,
            np.sqrt(((colour - top) ** 2).sum(axis=2)),
            brightness - top.mean(),
        ],
        axis=-1,
        dtype=np.float32,
    )


def terrain_above(photo: U8, edges: Bool, weights: F32) -> F32:
    """How much terrain, rather than sky, seems to lie above the centre of each block.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        edges: ``(H, W)`` edge map.
        weights: ``(FEATURES,)`` of the linear model; -1 means sky, 1 terrain.

    Returns:
        ``(h, w)`` float32, summed over the blocks above, in heights of the photo; -0.3 = three
        tenths of the height above this block are surely sky.

    Examples:
        A model that calls everything sky:

        >>> photo = np.full((40, 8, 3), 200, np.uint8)
        >>> sky = np.zeros(FEATURES, np.float32)
        >>> sky[0] = -1
        >>> terrain_above(photo, np.zeros((40, 8), bool), sky).ravel().round(1)
        array([-0.1, -0.3, -0.5, -0.7, -0.9], dtype=float32)
    """
    looks = np.clip(block_features(photo, edges) @ weights, -1, 1)
    above: F32 = (np.cumsum(looks, axis=0) - looks / 2) * np.float32(BLOCK / len(edges))
    return above


def terrain_sums(photo: U8, edges: Bool, truth: Skyline) -> F64:
    """Gram matrix ``(FEATURES + 1, FEATURES + 1)`` of (features, target) over a photo's blocks.

    Target 1 for terrain, -1 for sky, in between on the line; every block counts a second time
    without its colour, so that the model holds for grey photos.
    """
    grey = np.repeat(cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY)[:, :, None], 3, axis=2)
    sky = (truth.to_mask(edges.shape[0]) * np.uint8(255)).astype(np.uint8)
    sums = np.zeros((FEATURES + 1, FEATURES + 1))
    for version in (photo, grey):
        features = block_features(version, edges)
        centres = np.minimum(np.arange(features.shape[1]) * BLOCK + BLOCK // 2, truth.width - 1)
        samples = np.dstack([features, 1 - 2 * _block_means(sky)])[:, truth.visible[centres]]
        samples = samples.reshape(-1, FEATURES + 1)
        sums += samples.T @ samples
    return sums


def _block_means(image: U8) -> F32:
    """Mean of every whole block, in [0, 1]; what is left over at the right and bottom is cut."""
    height, width = image.shape[:2]
    if min(height, width) < BLOCK:
        image = cv2.resize(image, (max(width, BLOCK), max(height, BLOCK)))
        height, width = image.shape[:2]
    size = (width // BLOCK, height // BLOCK)
    whole = image[: size[1] * BLOCK, : size[0] * BLOCK]
    means: F32 = cv2.resize(whole, size, interpolation=cv2.INTER_AREA).astype(np.float32) / 255
    return means


def solve_terrain(sums: F64) -> F32:
    """Weights ``(FEATURES,)`` of the linear model by least squares, lightly regularised."""
    system = sums[:-1, :-1] + np.eye(FEATURES)
    return np.linalg.solve(system, sums[:-1, -1]).astype(np.float32)
