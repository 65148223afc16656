"""The array types that the stages pass to each other."""

from collections.abc import Iterable
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

U8: TypeAlias = npt.NDArray[np.uint8]
Bool: TypeAlias = npt.NDArray[np.bool_]
I16: TypeAlias = npt.NDArray[np.int16]
Int: TypeAlias = npt.NDArray[np.int32]
F32: TypeAlias = npt.NDArray[np.float32]
F64: TypeAlias = npt.NDArray[np.float64]


def check_photo(photo: U8) -> None:
    """Refuse anything but an ``(H, W, 3)`` uint8 array of at least 2 by 2 pixels.

    Raises:
        TypeError: Not a uint8 array.
        ValueError: The wrong shape, or too small to hold a skyline.
    """
    if not isinstance(photo, np.ndarray) or photo.dtype != np.uint8:
        found = getattr(photo, "dtype", type(photo).__name__)
        raise TypeError(f"a photo is a uint8 array (H, W, 3) in RGB, not {found}")
    if photo.ndim != 3 or photo.shape[2] != 3:
        raise ValueError(f"a photo has the shape (H, W, 3), not {photo.shape}")
    if min(photo.shape[:2]) < 2:
        raise ValueError(
            f"a photo is at least 2 by 2 pixels, not {photo.shape[1]}x{photo.shape[0]}"
        )


def in_colour(photo: U8, colour: tuple[int, int, int]) -> Bool:
    """Where a photo ``(H, W, 3)`` is of this very colour, ``(H, W)``.

    >>> in_colour(np.array([[[255, 0, 0], [255, 0, 1]]], np.uint8), (255, 0, 0))
    array([[ True, False]])
    """
    return in_colours(photo, [colour])[0]


def in_colours(photo: U8, colours: Iterable[tuple[int, int, int]]) -> list[Bool]:
    """Where a photo ``(H, W, 3)`` is of each of some colours, ``(H, W)`` each.

    The numbers of `in_numbers` are compared several times as fast as three channels are.
    """
    pixels = in_numbers(photo)
    return [
        pixels == np.array([*colour, 255], np.uint8).view(np.uint32)
        if max(colour) <= 255
        else np.zeros(pixels.shape, np.bool_)
        for colour in colours
    ]


def in_numbers(photo: U8) -> npt.NDArray[np.uint32]:
    """One number for each pixel of a photo ``(H, W, 3)``, the same for the same colour, ``(H, W)``.

    >>> len(np.unique(in_numbers(np.array([[[9, 0, 0], [0, 9, 0], [9, 0, 0]]], np.uint8))))
    2
    """
    import cv2  # noqa: PLC0415  # most who need arrays do not need it

    opaque = cv2.cvtColor(np.ascontiguousarray(photo), cv2.COLOR_RGB2RGBA)
    return np.asarray(opaque.view(np.uint32)[..., 0])


def column_counts(mask: Bool) -> Int:
    """How many pixels of each column of a mask ``(H, W)`` are True, ``(W,)``.

    >>> column_counts(np.array([[True, False], [True, True]]))
    array([2, 1], dtype=int32)
    """
    import cv2  # noqa: PLC0415  # numpy takes ten times as long: it walks down the columns

    counts: Int = cv2.reduce(mask.view(np.uint8), 0, cv2.REDUCE_SUM, dtype=cv2.CV_32S)[0]
    return counts


def column_ends(mask: Bool) -> tuple[Int, Int]:
    """First and last row of each column of a mask ``(H, W)`` that is True, ``(W,)`` each; or 0.

    Of a thin line this takes a tenth of the time of walking down the columns, which is done where
    more than a tenth of the mask is True.

    >>> [rows.tolist() for rows in column_ends(np.array([[0, 0], [1, 0], [1, 0]], bool))]
    [[1, 0], [2, 0]]
    """
    height, width = mask.shape
    if 10 * np.count_nonzero(mask) > mask.size:
        last = (height - 1 - mask[::-1].argmax(axis=0)) * mask.any(axis=0)
        return mask.argmax(axis=0).astype(np.int32), last.astype(np.int32)
    first, last = np.zeros(width, np.int32), np.zeros(width, np.int32)
    rows, columns = np.divmod(np.flatnonzero(mask), width)
    last[columns], first[columns[::-1]] = rows, rows[::-1]  # what is written last stays
    return first, last


def read_only(array: npt.NDArray[np.generic]) -> None:
    """Make `array` refuse writes, so that a frozen dataclass is frozen all the way down."""
    array.setflags(write=False)


def runs(mask: Bool, gap: int = 0) -> list[tuple[int, int]]:
    """First and last place of each run of True in a mask ``(W,)``.

    >>> runs(np.array([True, True, False, True, False, False, True]))
    [(0, 1), (3, 3), (6, 6)]
    >>> runs(np.array([True, True, False, True, False, False, True]), gap=1)
    [(0, 3), (6, 6)]

    Args:
        mask: ``(W,)``.
        gap: At most so many False do not end a run.
    """
    places = np.flatnonzero(mask)
    if len(places) == 0:
        return []
    breaks = np.flatnonzero(np.diff(places) > gap + 1)
    firsts, lasts = places[np.append(0, breaks + 1)], places[np.append(breaks, -1)]
    return list(zip(firsts.tolist(), lasts.tolist(), strict=True))
