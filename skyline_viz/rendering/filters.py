"""Curves and filters of the renderer, made of operations that every CPU rounds alike."""

import numpy as np

from skyline_viz.arrays import F32


def ramp(low: float, high: float, values: F32) -> F32:
    """Smooth step from 0 at `low` to 1 at `high`; falling where `low` exceeds `high`."""
    t: F32 = np.clip((values - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def mix(first: F32, second: F32, weight: F32 | float) -> F32:
    """`first` where `weight` is 0, `second` where it is 1."""
    mixture: F32 = first + (second - first) * weight
    return mixture


def box_blur(values: F32, radius: int) -> F32:
    """Mean of `values` ``(N, W)`` over squares of ``2 * radius + 1``, edges repeated.

    The sums are those of integers, steps of 1/64, so that their order does not matter.
    """
    sums = np.pad(np.rint(values * 64).astype(np.int64), radius, mode="edge")
    size = 2 * radius + 1
    for axis in (0, 1):
        total = np.insert(np.cumsum(sums, axis=axis), 0, 0, axis=axis)
        upper = np.take(total, range(size, total.shape[axis]), axis=axis)
        lower = np.take(total, range(total.shape[axis] - size), axis=axis)
        sums = upper - lower
    return sums.astype(np.float32) / np.float32(64 * size * size)


def soften(values: F32, weight: float) -> F32:
    """Blur of the first two axes over three pixels: ``weight, 1 - 2 weight, weight``."""
    for axis in (0, 1):
        padding = [(1, 1) if a == axis else (0, 0) for a in range(values.ndim)]
        padded = np.pad(values, padding, mode="edge")
        first, middle, last = (
            np.take(padded, range(k, k + values.shape[axis]), axis=axis) for k in range(3)
        )
        values = middle * (1 - 2 * weight) + (first + last) * weight
    return values


def enlarge(values: F32, shape: tuple[int, int], step: int) -> F32:
    """Linear interpolation of samples ``values[i, j]`` that stand at ``(i * step, j * step)``."""
    for axis in (0, 1):
        place = np.arange(shape[axis]).astype(np.float32) / np.float32(step)
        last = values.shape[axis] - 1
        low = np.minimum(place.astype(np.intp), last)
        part = (place - low).astype(np.float32)
        part = part[:, None] if axis == 0 else part[None, :]
        first = np.take(values, low, axis=axis)
        values = mix(first, np.take(values, np.minimum(low + 1, last), axis=axis), part)
    return values


def slopes(height: F32, steps: tuple[F32 | float, F32 | float]) -> tuple[F32, F32]:
    """Slopes ``(N, W)`` of `height` along its columns and its rows, which are `steps` apart."""
    x_slope: F32 = np.empty_like(height)
    x_slope[:, 1:-1] = (height[:, 2:] - height[:, :-2]) * np.float32(0.5)
    x_slope[:, 0] = height[:, 1] - height[:, 0]
    x_slope[:, -1] = height[:, -1] - height[:, -2]
    y_slope: F32 = np.empty_like(height)
    y_slope[1:-1] = (height[2:] - height[:-2]) * np.float32(0.5)
    y_slope[0] = height[1] - height[0]
    y_slope[-1] = height[-1] - height[-2]
    return x_slope / steps[0], y_slope / steps[1]
