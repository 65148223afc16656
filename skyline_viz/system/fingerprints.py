"""Knowing a photo again: exactly, resized or compressed, or as a frame of a clip.

A fingerprint is text of three parts, each of hexadecimal digits:

- a digest of the pixels;
- 256 bits, one for each region of a grid of 16 x 16: whether it is brighter than what surrounds it.
  Copies of 40 % of the size, saved as JPEG of a low quality, differ from their photos in at most 7
  of these bits (621 photographs of seven data sets). Apart from copies, 3 pairs of all that can be
  made of these differ in 8 or fewer, and each of the 3 shows one place twice;
- a digest of the name of the clip. A camera turns between two frames of a clip that are seconds
  apart, until they have nothing in common but the place; so their names tell. ``clip07-001`` and
  ``clip07-002`` are alike but for the last of two numbers, and as large as each other. A name with
  one number, such as ``IMG_0001``, tells of no clip. Nor do names that all begin alike: that is
  what their data set is called.

No content was found that tells clips. Of 194 frames of 29 flights, seconds apart, not one lies
within 8 bits of another frame of its flight. Local features (SIFT, 12 that fit) find 70 a mate, and
join 407 pairs of different flights over the same field. Their names tell all of them. The bits find
what names do not: two of these flights are one, frame by frame.
"""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Iterable, Sequence
from typing import Literal, TypeAlias

import cv2
import numpy as np

from skyline_viz.arrays import U8, Bool, Int

Known: TypeAlias = Literal["exact", "near", "clip", ""]
"""How a photo is known again: the same pixels, nearly the same picture, another frame of a clip, or
not at all."""

NEAR = 8
"""Photos are nearly the same that differ in at most so many of the 256 bits."""

_SIDE = 16  # regions a side
_AROUND = 3.0  # standard deviation of what surrounds a region, in regions
_BRIGHTER = 1.5  # grey levels; less is the noise of a flat sky
_DIGEST = 8  # hexadecimal digits of the pixels
_BITS = _SIDE * _SIDE // 4  # hexadecimal digits of the regions
_LENGTH = _DIGEST + _BITS + _DIGEST
_NO_CLIP = "0" * _DIGEST


def fingerprint(photo: U8, name: str = "") -> str:
    """The fingerprint of a photo ``(H, W, 3)``.

    >>> photo = np.zeros((40, 60, 3), np.uint8)
    >>> len(fingerprint(photo)), fingerprint(photo) == fingerprint(photo.copy())
    (80, True)

    Args:
        photo: Its pixels.
        name: What it is called, with the folders that it lies in or without.
    """
    pixels = hashlib.sha256(f"{photo.shape}".encode())
    pixels.update(np.ascontiguousarray(photo).data)
    grey = cv2.cvtColor(_reduced(photo), cv2.COLOR_RGB2GRAY)
    grid = cv2.resize(grey, (_SIDE, _SIDE), interpolation=cv2.INTER_AREA).astype(np.float32)
    bits = grid - cv2.GaussianBlur(grid, (0, 0), _AROUND) > _BRIGHTER
    own = pixels.hexdigest()[:_DIGEST] + np.packbits(bits).tobytes().hex() + _NO_CLIP
    return of_clip(own, photo, name)


def of_clip(own: str, photo: U8, name: str) -> str:
    """The fingerprint of a photo with a name, which may tell of its clip.

    >>> photo = np.zeros((40, 60, 3), np.uint8)
    >>> of_clip(fingerprint(photo), photo, "clip1-1") == fingerprint(photo, "clip1-1")
    True

    Args:
        own: That of the photo without its name.
        photo: ``(H, W, 3)`` its pixels.
        name: What it is called, with the folders that it lies in or without.
    """
    clip = clip_of(name)
    named = (
        hashlib.sha256(f"{clip} {photo.shape}".encode(errors="replace")).hexdigest()
        if clip
        else _NO_CLIP
    )
    return own[:-_DIGEST] + named[:_DIGEST]


def clip_of(name: str) -> str:
    """What the names of all frames of a clip begin with; empty where a name tells of no clip.

    >>> clip_of("uav/clip07-001"), clip_of("0016E5_04530.png"), clip_of("IMG_0001")
    ('clip07-', '0016E5_', '')

    Args:
        name: Of a photo, with folders and ending or without.
    """
    stem = re.sub(r"\.[A-Za-z]+$", "", name.rpartition("/")[2])
    begins = re.match(r"(.*\d.*\D)\d+$", stem)
    return begins[1] if begins else ""


def known_as(one: str, others: Sequence[str]) -> Known:
    """How a photo is known among others, the surest way first.

    >>> photo = np.zeros((40, 60, 3), np.uint8)
    >>> photo[25:, 20:] = 200
    >>> known_as(fingerprint(photo[::2, ::2]), [fingerprint(photo)])
    'near'
    >>> known_as(fingerprint(photo, "clip1-2"), [fingerprint(photo[:, ::-1], "clip1-1")])
    'clip'

    Args:
        one: Fingerprint of the photo.
        others: Those of the others.
    """
    if not others:
        return ""
    if any(one[:-_DIGEST] == other[:-_DIGEST] for other in others):
        return "exact"
    if _distances(_bits([one]), _bits(others)).min() <= NEAR:
        return "near"
    clip = one[-_DIGEST:]
    return "clip" if clip != _NO_CLIP and any(other.endswith(clip) for other in others) else ""


def near_groups(fingerprints: Sequence[str]) -> list[int]:
    """The group of each photo: those that know each other again, and whatever these know.

    >>> photo = np.zeros((40, 60, 3), np.uint8)
    >>> photo[25:, 20:] = 200
    >>> near_groups([fingerprint(one) for one in (photo, photo[:, ::-1], photo[::2, ::2])])
    [0, 1, 0]
    """
    fingerprints = telling(fingerprints)
    bits = _bits(fingerprints)
    clips = np.array([one[-_DIGEST:] for one in fingerprints])
    groups = np.arange(len(fingerprints))
    for place in range(len(bits)):
        near = _distances(bits[place : place + 1], bits[:place]) <= NEAR
        if clips[place] != _NO_CLIP:
            near |= clips[:place] == clips[place]
        if near.any():
            joined = np.unique(groups[:place][near])
            groups[place] = joined[0]
            groups[:place][np.isin(groups[:place], joined)] = joined[0]
    return [int(group) for group in groups]


def telling(fingerprints: Sequence[str]) -> tuple[str, ...]:
    """The same of a data set; without the clip where it is one and the same of all of them.

    >>> photo = np.zeros((40, 60, 3), np.uint8)
    >>> same = [fingerprint(photo, name) for name in ("set2_001", "set2_002")]
    >>> [one[-8:] for one in telling(same)]
    ['00000000', '00000000']
    """
    clips = {one[-_DIGEST:] for one in fingerprints}
    if len(clips) > 1:
        return tuple(fingerprints)
    return tuple(one[:-_DIGEST] + _NO_CLIP for one in fingerprints)


def packed(fingerprints: Iterable[str]) -> str:
    """Fingerprints as files keep them: each once, in order, in base64."""
    return base64.b64encode(bytes.fromhex("".join(sorted(set(fingerprints))))).decode("ascii")


def unpacked(text: object) -> tuple[str, ...]:
    """What `packed` has made.

    >>> unpacked(packed(["0" * 80, "a" * 80])) == ("0" * 80, "a" * 80)
    True

    Raises:
        ValueError: It is something else.
    """
    if not isinstance(text, str):
        raise ValueError("fingerprints are text")
    digits = base64.b64decode(text, validate=True).hex()
    if len(digits) % _LENGTH:
        raise ValueError("fingerprints are cut off")
    return tuple(digits[place : place + _LENGTH] for place in range(0, len(digits), _LENGTH))


def _reduced(photo: U8) -> U8:
    """A photo of at most a few hundred pixels a side, which costs as little as it can."""
    height, width = photo.shape[:2]
    size = (min(width, 16 * _SIDE), min(height, 16 * _SIDE))
    return np.asarray(cv2.resize(photo, size, interpolation=cv2.INTER_AREA), np.uint8)


def _bits(fingerprints: Sequence[str]) -> Bool:
    raw = b"".join(bytes.fromhex(one[_DIGEST:-_DIGEST]) for one in fingerprints)
    packed = np.frombuffer(raw, np.uint8).reshape(len(fingerprints), _BITS // 2)
    return np.unpackbits(packed, axis=1).astype(np.bool_)


def _distances(one: Bool, others: Bool) -> Int:
    return np.asarray((one != others).sum(axis=1), np.int32)
