"""Stage 3, bins: which of the learned filters a pixel uses, told by its structure tensor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import Int
from skyline_viz.system.settings import plain_number

if TYPE_CHECKING:
    from skyline_viz.tensor import Tensor  # compiled code: not needed to describe bins


@dataclass(frozen=True)
class Bins:
    """How strength, coherence and orientation are quantised; as published: 3 x 6 x 16 bins.

    The index of a bin is ``(coherence * strengths + strength) * orientations + orientation``.

    Examples:
        >>> Bins().count
        288
        >>> Bins(coherences=1, strengths=2, orientations=4).shape
        (1, 2, 4)
    """

    coherences: int = 3
    """Number of coherence bins."""

    strengths: int = 6
    """Number of strength bins."""

    orientations: int = 16
    """Number of orientation bins in 180 degrees; the first one is centred on 0 degrees."""

    coherence_top: float = 0.8
    """Coherence from which on a pixel is in the last bin, in (0, 1]."""

    strength_offset: float = 40.0
    """Strength up to which a pixel is in the first bin, in grey levels a pixel."""

    strength_range: float = 180.0
    """How far above the offset the last bin begins, in grey levels a pixel."""

    def __post_init__(self) -> None:
        """Refuse values that make no bins."""
        for name in ("coherences", "strengths", "orientations"):
            value = plain_number(getattr(self, name))
            if type(value) is not int or not 1 <= value <= 1000:
                raise ValueError(f"{name} is a number of bins from 1 to 1000, not {value!r}")
            object.__setattr__(self, name, value)
        for name in ("coherence_top", "strength_offset", "strength_range"):
            value = plain_number(getattr(self, name), real=True)
            if type(value) is not float:
                raise ValueError(f"{name} is a number, not {value!r}")
            object.__setattr__(self, name, value)
        if not 0 < self.coherence_top <= 1:
            raise ValueError(f"coherence_top lies in (0, 1], not at {self.coherence_top}")
        if not (np.isfinite(self.strength_offset) and 0 < self.strength_range < np.inf):
            raise ValueError("strength_offset is finite and strength_range finite and positive")

    @property
    def shape(self) -> tuple[int, int, int]:
        """Numbers of coherence, strength and orientation bins."""
        return self.coherences, self.strengths, self.orientations

    @property
    def count(self) -> int:
        """Number of bins."""
        return self.coherences * self.strengths * self.orientations

    def of(self, tensor: Tensor) -> Int:
        """Bin index of each pixel, int32, of the shape of the tensor's arrays.

        Examples:
            >>> from skyline_viz.tensor import Tensor
            >>> edge = Tensor(np.float32([300]), np.float32([1]), np.float32([90]))
            >>> Bins().of(edge)  # the last coherence and strength, the orientation in the middle
            array([280], dtype=int32)
        """
        index = _level(tensor.coherence / self.coherence_top, self.coherences)
        index *= self.strengths
        above = tensor.strength - self.strength_offset
        above /= self.strength_range
        index += _level(above, self.strengths)
        index *= self.orientations
        turn = tensor.orientation * (self.orientations / 180.0)
        turn += 0.5
        orientation = turn.astype(np.int32)
        orientation *= orientation < self.orientations  # 180 degrees are 0
        index += orientation
        return index

    def label(self, index: int) -> str:
        """What a bin stands for, in words.

        Examples:
            >>> Bins().label(143)
            'bin 143: coherence 0.4 to 0.8, strength 112 to 148, orientation 163 to 174°'
        """
        coherence, strength, orientation = self.levels(index)
        return (
            f"bin {index}: coherence {self.coherence_label(coherence)}, "
            f"strength {self.strength_label(strength)}, "
            f"orientation {self.orientation_label(orientation)}"
        )

    def levels(self, index: int) -> tuple[int, int, int]:
        """Levels of coherence, strength and orientation of a bin.

        Examples:
            >>> Bins().levels(143)
            (1, 2, 15)
        """
        row, orientation = divmod(index, self.orientations)
        return *divmod(row, self.strengths), orientation

    def why(
        self, index: int, coherence: float, strength: float, orientation: float
    ) -> tuple[str, str, str]:
        """Why a pixel with some features falls into a bin, in words.

        Examples:
            >>> Bins().why(143, 0.61, 120.4, 170.0)[1]
            'strength 120.4 is in 112 to 148'
        """
        one, two, three = self.levels(index)
        return (
            f"coherence {coherence:.2f} is in {self.coherence_label(one)}",
            f"strength {strength:.1f} is in {self.strength_label(two)}",
            f"orientation {orientation:.0f}° is in {self.orientation_label(three)}",
        )

    def coherence_label(self, level: int) -> str:
        """Coherences of a level, in words."""
        return _range(level, self.coherences, 0.0, self.coherence_top)

    def strength_label(self, level: int) -> str:
        """Strengths of a level, in words."""
        return _range(level, self.strengths, self.strength_offset, self.strength_range)

    def orientation_label(self, level: int) -> str:
        """Orientations of a level, in words.

        Examples:
            >>> Bins().orientation_label(8)
            '84 to 96°'
        """
        step = 180.0 / self.orientations
        first = ((level - 0.5) * step) % 180.0
        last = ((level + 0.5) * step) % 180.0
        return f"{first:.0f} to {last:.0f}°"

    def mirrored(self) -> npt.NDArray[np.intp]:
        """Bin ``(count,)`` into which each bin's pixels fall in the left-right flipped photo.

        Examples:
            >>> Bins(coherences=1, strengths=1, orientations=4).mirrored()
            array([0, 3, 2, 1])
        """
        index = np.arange(self.count).reshape(self.shape)
        return index[:, :, -np.arange(self.orientations) % self.orientations].ravel()


def _level(value: npt.NDArray[np.float32], levels: int) -> Int:
    """Quantise [0, 1], in place, into `levels` levels, of which the last one begins at 1."""
    if levels == 1:
        return np.zeros(value.shape, np.int32)
    np.clip(value, 0.0, 1.0, out=value)
    value *= levels - 1
    return value.astype(np.int32)


def _range(level: int, levels: int, offset: float, span: float) -> str:
    """Values that fall into a level, see `Bins.of`; the last one begins where the span ends."""
    if levels == 1:
        return "any"
    step = span / (levels - 1)
    first = 0.0 if level == 0 else offset + level * step
    if level == levels - 1:
        return f"{first:.3g} and more"
    return f"{first:.3g} to {offset + (level + 1) * step:.3g}"
