"""Knowing a photo again: exactly, and where it was resized, compressed or is the next frame.

A fingerprint is text of two parts. The first is a digest of the pixels. The second are 256 bits,
one for each region of a grid of 16 x 16: whether the region is brighter than what surrounds it.
Copies at 40 % of the size, saved as JPEG of a low quality, differ from their photos in at most
5 of these bits; different photographs differ in 13 and more (193 photographs of three data sets,
each compared with each).
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence

import cv2
import numpy as np

from skyline_viz.arrays import U8, Bool, Int

NEAR = 8
"""Photos are nearly the same that differ in at most so many of the 256 bits."""

EXACT, NEARLY = "exact", "near"
"""How a photo may be known again; an empty text says that it is not."""

_SIDE = 16  # regions a side
_AROUND = 3.0  # standard deviation of what surrounds a region, in regions
_BRIGHTER = 1.5  # grey levels; less is the noise of a flat sky
_LENGTH = 32  # hexadecimal digits of the digest


def fingerprint(photo: U8) -> str:
    """The fingerprint of a photo ``(H, W, 3)``.

    >>> photo = np.zeros((40, 60, 3), np.uint8)
    >>> len(fingerprint(photo)), fingerprint(photo) == fingerprint(photo.copy())
    (96, True)
    """
    digest = hashlib.sha256(f"{photo.shape}".encode())
    digest.update(np.ascontiguousarray(photo).data)
    grey = cv2.cvtColor(_reduced(photo), cv2.COLOR_RGB2GRAY)
    grid = cv2.resize(grey, (_SIDE, _SIDE), interpolation=cv2.INTER_AREA).astype(np.float32)
    bits = grid - cv2.GaussianBlur(grid, (0, 0), _AROUND) > _BRIGHTER
    return digest.hexdigest()[:_LENGTH] + np.packbits(bits).tobytes().hex()


def known_as(one: str, others: Sequence[str]) -> str:
    """How a photo is among others: `EXACT`, `NEARLY`, or an empty text where it is not.

    >>> photo = np.zeros((40, 60, 3), np.uint8)
    >>> photo[25:, 20:] = 200
    >>> half = photo[::2, ::2]
    >>> known_as(fingerprint(half), [fingerprint(photo)])
    'near'

    Args:
        one: Fingerprint of the photo.
        others: Those of the others.
    """
    if not others:
        return ""
    if any(one[:_LENGTH] == other[:_LENGTH] for other in others):
        return EXACT
    return NEARLY if _distances(_bits([one]), _bits(others)).min() <= NEAR else ""


def near_groups(fingerprints: Sequence[str]) -> list[int]:
    """The group of each photo: those that are nearly the same, and what is so to one of these.

    >>> photo = np.zeros((40, 60, 3), np.uint8)
    >>> photo[25:, 20:] = 200
    >>> near_groups([fingerprint(one) for one in (photo, photo[:, ::-1], photo[::2, ::2])])
    [0, 1, 0]
    """
    bits = _bits(fingerprints)
    groups = list(range(len(fingerprints)))
    for place in range(len(bits)):
        near = np.flatnonzero(_distances(bits[place : place + 1], bits[:place]) <= NEAR)
        joined = {groups[int(other)] for other in near}
        if joined:
            first = min(joined)
            groups[place] = first
            groups[:place] = [first if one in joined else one for one in groups[:place]]
    return groups


def is_fingerprint(text: object) -> bool:
    """Whether a value of a file is one."""
    return (
        isinstance(text, str)
        and len(text) == _LENGTH + _SIDE * _SIDE // 4
        and set(text) <= set("0123456789abcdef")
    )


def _reduced(photo: U8) -> U8:
    """A photo of at most a few hundred pixels a side, which costs as little as it can."""
    height, width = photo.shape[:2]
    size = (min(width, 16 * _SIDE), min(height, 16 * _SIDE))
    return np.asarray(cv2.resize(photo, size, interpolation=cv2.INTER_AREA), np.uint8)


def _bits(fingerprints: Sequence[str]) -> Bool:
    raw = b"".join(bytes.fromhex(one[_LENGTH:]) for one in fingerprints)
    packed = np.frombuffer(raw, np.uint8).reshape(len(fingerprints), -1)
    return np.unpackbits(packed, axis=1).astype(np.bool_)


def _distances(one: Bool, others: Bool) -> Int:
    return np.asarray((one != others).sum(axis=1), np.int32)
