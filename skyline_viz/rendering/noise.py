"""Random fields over the plane, made of operations that every CPU rounds alike."""

from collections.abc import Callable

import numpy as np

from skyline_viz.arrays import F32, Int
from skyline_viz.rendering.filters import mix

_PERIOD = 256


class Noise:
    """Random fields, each a function of position, all fixed by one generator.

    Positions are float32 arrays ``(N, W)``; a row ``(1, W)`` and a column ``(N, 1)`` broadcast,
    which is faster. Every call gives another field.
    """

    def __init__(self, rng: np.random.Generator) -> None:
        across, along = (2 * rng.random((2, _PERIOD * _PERIOD)) - 1).astype(np.float32)
        length = np.sqrt(across * across + along * along) + np.float32(1e-4)
        self._across: F32 = across / length
        self._along: F32 = along / length
        self._uniform = rng.random(_PERIOD * _PERIOD).astype(np.float32)
        self._shifts: list[tuple[float, float]] = (rng.random((64, 2)) * _PERIOD).tolist()
        self._calls = 0

    def smooth(self, x: F32, y: F32, size: float) -> F32:
        """Gradient noise, about -1 to 1, whose bumps are about `size` wide."""
        x, y = self._place(x, y, size)
        if len(x) == 1 and y.shape[1] == 1:
            return self._smooth(x, y)
        return _in_blocks(self._smooth, x, y)

    def fractal(self, x: F32, y: F32, size: float, smallest: float, *, gain: float = 0.5) -> F32:
        """Sum of noises from `size` halving down to `smallest`, each `gain` times the last."""
        total: F32 = np.zeros(np.broadcast_shapes(x.shape, y.shape), np.float32)
        weight, norm = 1.0, 0.0
        while size >= smallest or norm == 0:
            total += self.smooth(x, y, size) * weight
            norm += weight
            weight *= gain
            size *= 0.51
        return total / np.float32(norm)

    def ridged(self, x: F32, y: F32, size: float, smallest: float, *, gain: float = 0.5) -> F32:
        """Fractal of sharp crests, 0 to 1: each octave is ``1 - |noise|``, strong on crests."""
        total: F32 = np.zeros(np.broadcast_shapes(x.shape, y.shape), np.float32)
        carry: F32 = np.ones_like(total)
        weight, norm = 1.0, 0.0
        while size >= smallest or norm == 0:
            crest: F32 = 1 - np.abs(self.smooth(x, y, size))
            crest = crest * crest * carry
            total += crest * weight
            carry = np.clip(crest * 1.4, 0, 1)
            norm += weight
            weight *= gain
            size *= 0.48
        return total / np.float32(norm)

    def billows(self, x: F32, y: F32, size: float, smallest: float) -> F32:
        """Fractal of round heads with sharp creases between them, about 0 to 1."""
        total: F32 = np.zeros(np.broadcast_shapes(x.shape, y.shape), np.float32)
        weight, norm = 1.0, 0.0
        while size >= smallest or norm == 0:
            total += np.abs(self.smooth(x, y, size)) * weight
            norm += weight
            weight *= 0.55
            size *= 0.49
        return total * np.float32(1.8 / norm)

    def gullies(self, x: F32, y: F32, slope: tuple[F32, F32], size: float) -> F32:
        """Waves, -1 (gully) to 1 (rib), `size` apart, that run straight down a slope.

        Every cell of a jittered lattice holds a wave across the slope; waves of neighbouring
        cells blend, so that gullies fork and join as those that water cuts. `slope` is that along
        x and that along y, ``(N, W)``.
        """
        x, y = self._place(x, y, 2 * size)
        return _in_blocks(self._gullies, x, y, *slope)

    def mounds(self, x: F32, y: F32, size: float, share: float) -> tuple[F32, F32]:
        """Scattered discs, at most one in each square cell of side `size`.

        Returns:
            ``1 - distance / radius`` in the disc that is nearest (0 outside of all), and a random
            number of that disc, 0 to 1. About `share` of the cells hold a disc.
        """
        x, y = self._place(x, y, size)
        both = _in_blocks(lambda x, y: self._mounds(x, y, share), x, y)
        return both[..., 0], both[..., 1]

    def cells(self, x: F32, y: F32, size: float) -> F32:
        """A random number, 0 to 1, of the square cell of side `size` that each position is in."""
        x, y = self._place(x, y, size)
        column, row = np.floor(x).astype(np.int32), np.floor(y).astype(np.int32)
        numbers: F32 = self._uniform.take(
            (row & (_PERIOD - 1)) * _PERIOD + (column & (_PERIOD - 1))
        )
        return numbers

    def _place(self, x: F32, y: F32, size: float) -> tuple[F32, F32]:
        """Lattice coordinates, in another stretch of the tables at each call."""
        self._calls += 1
        x_shift, y_shift = self._shifts[self._calls % len(self._shifts)]
        return x / np.float32(size) + np.float32(x_shift), y / np.float32(size) + np.float32(
            y_shift
        )

    def _smooth(self, x: F32, y: F32) -> F32:
        x_floor, y_floor = np.floor(x), np.floor(y)
        x, y = x - x_floor, y - y_floor
        column, row = x_floor.astype(np.int32), y_floor.astype(np.int32)
        x_weight = x * x * x * (x * (x * 6 - 15) + 10)
        y_weight = y * y * y * (y * (y * 6 - 15) + 10)
        if len(x) == 1 and y.shape[1] == 1:  # few rows of the lattice serve all rows of y
            lattice = np.arange(row.min(), row.max() + 2, dtype=np.int32)[:, None]
            flat, tilt = self._along_rows(x, column, lattice, x_weight)
            index = row[:, 0] - lattice[0, 0]
            total: F32 = flat[index] * (1 - y_weight) + flat[index + 1] * y_weight
            total += tilt[index] * (y * (1 - y_weight))
            total += tilt[index + 1] * ((y - 1) * y_weight)
            return total * np.float32(1.6)
        lines = []
        for j in (0, 1):
            flat, tilt = self._along_rows(x, column, row + j, x_weight)
            lines.append(flat + tilt * (y - j))
        return mix(lines[0], lines[1], y_weight) * np.float32(1.6)

    def _along_rows(self, x: F32, column: Int, row: Int, x_weight: F32) -> tuple[F32, F32]:
        """What the noise is on rows of its lattice, and how fast it changes across them."""
        start = (row & (_PERIOD - 1)) * _PERIOD
        left, right = (start + ((column + i) & (_PERIOD - 1)) for i in (0, 1))
        flat = mix(self._across.take(left) * x, self._across.take(right) * (x - 1), x_weight)
        return flat, mix(self._along.take(left), self._along.take(right), x_weight)

    def _gullies(self, x: F32, y: F32, x_slope: F32, y_slope: F32) -> F32:
        steepness = np.sqrt(x_slope * x_slope + y_slope * y_slope) + np.float32(1e-4)
        x_side, y_side = -y_slope / steepness, x_slope / steepness
        cosine: F32 = np.zeros(x_slope.shape, np.float32)
        sine: F32 = np.zeros(x_slope.shape, np.float32)
        weights: F32 = np.full(x_slope.shape, 1e-4, np.float32)
        for index, x_off, y_off in self._neighbours(x, y, 0.25):
            near: F32 = np.maximum(1 - (x_off * x_off + y_off * y_off) / np.float32(1.5625), 0)
            near *= near
            turns = (x_off * x_side + y_off * y_side) * 2 + self._across.take(index)
            sine += near * _wave(turns)
            cosine += near * _wave(turns + np.float32(0.25))
            weights += near
        strength = np.sqrt(sine * sine + cosine * cosine)
        waves: F32 = cosine / np.maximum(strength, weights * np.float32(0.3))
        return waves

    def _mounds(self, x: F32, y: F32, share: float) -> F32:
        inside: F32 = np.zeros(np.broadcast_shapes(x.shape, y.shape), np.float32)
        chance: F32 = np.zeros_like(inside)
        for index, x_off, y_off in self._neighbours(x, y, 0.35):
            random = self._uniform.take(index)
            radius = np.float32(0.25) + random * np.float32(0.5 / share)
            distance = np.sqrt(x_off * x_off + y_off * y_off)
            here = np.where(random < share, 1 - distance / radius, np.float32(0))
            chance = np.where(here > inside, random / np.float32(share), chance)
            inside = np.maximum(here, inside)
        return np.stack([inside, chance], axis=2)

    def _neighbours(self, x: F32, y: F32, jitter: float) -> list[tuple[Int, F32, F32]]:
        """For the nine cells around each position: table index, and offset from their middle."""
        x_floor, y_floor = np.floor(x), np.floor(y)
        column, row = x_floor.astype(np.int32), y_floor.astype(np.int32)
        cells = []
        for j in (-1, 0, 1):
            for i in (-1, 0, 1):
                index = ((row + j) & (_PERIOD - 1)) * _PERIOD + ((column + i) & (_PERIOD - 1))
                x_off = x - x_floor - np.float32(i + 0.5) - self._across.take(index) * jitter
                y_off = y - y_floor - np.float32(j + 0.5) - self._along.take(index) * jitter
                cells.append((index, x_off, y_off))
        return cells


def _in_blocks(function: Callable[..., F32], *fields: F32) -> F32:
    """``function(*fields)`` a few rows at a time, which keeps its steps in the CPU's cache."""
    height = max(len(field) for field in fields)
    count = max(1, 20_000 // max(field.shape[1] for field in fields))
    blocks = [
        function(*(field if len(field) == 1 else field[k : k + count] for field in fields))
        for k in range(0, height, count)
    ]
    return np.concatenate(blocks)


def _wave(turns: F32) -> F32:
    """Sine of an angle in turns, drawn with parabolas."""
    part: F32 = turns - np.floor(turns) - np.float32(0.5)
    wave: F32 = -8 * part * (1 - 2 * np.abs(part))
    return wave
