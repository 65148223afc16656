"""From samples of any depth to eight bits.

Cameras that count to 4,095 write their counts into files of 16 bits, where they would be nearly
black. What is white is said by the file where it says so, else by its brightest sample.
"""

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import U8

Deep = npt.NDArray[np.uint16]
"""Samples of 16 bits."""

_DEPTHS = (8, 10, 12, 14, 16)


def white_of(samples: Deep, said: int | None = None, bits: int = 0) -> tuple[int, str | None]:
    """The value that is white, and a note where the file does not say it.

    The smallest depth of 8, 10, 12, 14 and 16 bits that holds all samples decides. A dark photo
    of 16 bits becomes brighter by that, which its note says.

    Args:
        samples: Grey or colour samples, without alpha.
        said: The white that the file names. One that its own samples exceed is not believed.
        bits: Bits that count, as the file says; no smaller depth is taken.

    >>> white_of(np.array([0, 3000], np.uint16))[0]
    4095
    >>> white_of(np.array([0, 3000], np.uint16), said=65535)
    (65535, None)
    """
    brightest = int(samples.max(initial=0))
    if said is not None and brightest <= said:
        return said, None
    depth = next((one for one in _DEPTHS if one >= bits and brightest < 1 << one), 16)
    if depth == 16 or brightest == 0:
        return 65535, None
    white = (1 << depth) - 1
    found = f"has 16-bit values of which none exceeds {brightest:,}"
    return white, f"{found}, so {white:,} is taken for white ({depth} bits)"


def to_eight_bits(
    samples: Deep, white: int, *, inverted: bool = False, gamma: float | None = None
) -> U8:
    """Samples as bytes: at full range the high byte, else that of the same share of the range.

    Args:
        samples: Samples of any shape.
        white: The value that is white.
        inverted: Whether 0 is white, and that value black.
        gamma: Exponent with which the samples are encoded; that of screens unless given.
    """
    values = np.arange(65536).clip(0, white)
    table = values * 256 // (white + 1)
    if gamma is not None:
        table = np.rint(255 * (values / white) ** _exponent(gamma)).astype(np.int64)
    bytes_of = table.astype(np.uint8)
    eight: U8 = (np.uint8(255) - bytes_of if inverted else bytes_of)[samples]
    return eight


def for_screens(gamma: float) -> U8:
    """Table from bytes that are encoded with `gamma` to those of a screen."""
    table: U8 = np.rint(255 * (np.arange(256) / 255) ** _exponent(gamma)).astype(np.uint8)
    return table


def differs_from_screens(gamma: float | None) -> bool:
    """Whether a gamma has to be undone: it is named, possible, and not that of screens."""
    return gamma is not None and 0.1 <= gamma <= 10 and abs(_exponent(gamma) - 1) > 0.05


def _exponent(gamma: float) -> float:
    return 1 / (2.2 * gamma)
