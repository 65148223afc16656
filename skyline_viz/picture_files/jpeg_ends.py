"""JPEG files that end too early: how much of the photo is there?

The decoder fills what is missing with whatever it has. So the file is decoded with different ends
put to it: rows that come out the same each time are in the file, others are not.
"""

import io

import numpy as np
from PIL import Image

from skyline_viz.arrays import U8

END = b"\xff\xd9"
"""The marker with which a JPEG ends."""

SMALL_LOSS = 0.05
"""Share of the rows that may be missing at the lower rim of a photo that is read all the same."""

_TAILS = (b"", bytes(range(1, 255)) * 8, b"\x55\xaa\x0f" * 700)


def missing_rows(data: bytes) -> int:
    """Rows at the lower rim, of the stored picture, that a JPEG without an end does not hold.

    All of them where a later pass over the picture is missing, as in progressive files.

    Raises:
        OSError: Not even that can be decoded.
    """
    pictures = [_decoded(data + tail + END) for tail in _TAILS]
    height = len(pictures[0])
    first = height
    for other in pictures[1:]:
        differs = (pictures[0] != other).reshape(height, -1).any(axis=1)
        first = min(first, int(differs.argmax()) if differs.any() else height)
    scans = _scans(data)
    if len(scans) == 1 and not _is_progressive(data):
        return height - first
    return 0 if first == height and _is_complete(data, scans) else height


def completed(data: bytes) -> bytes:
    """A JPEG without an end, with one."""
    return data + END


def _decoded(data: bytes) -> U8:
    with Image.open(io.BytesIO(data), formats=("JPEG",)) as image:
        return np.asarray(image)


def _segments(data: bytes) -> list[tuple[int, bytes]]:
    """Marker and content of each segment, entropy-coded data left out."""
    found = []
    place = 2
    while (place := data.find(b"\xff", place)) >= 0 and place + 4 <= len(data):
        marker = data[place + 1]
        if marker in (0x00, 0xFF) or 0xD0 <= marker <= 0xD9:
            place += 1 if marker == 0xFF else 2
            continue
        length = int.from_bytes(data[place + 2 : place + 4])
        found.append((marker, data[place + 4 : place + 2 + length]))
        place += 2 + length
    return found


def _is_progressive(data: bytes) -> bool:
    return any(marker == 0xC2 for marker, _ in _segments(data))


def _scans(data: bytes) -> list[bytes]:
    return [content for marker, content in _segments(data) if marker == 0xDA]


def _is_complete(data: bytes, scans: list[bytes]) -> bool:
    """Whether the scans bring every coefficient of every component to its last bit."""
    frame = next((body for marker, body in _segments(data) if marker in (0xC0, 0xC1, 0xC2)), b"")
    if len(frame) < 6 or len(frame) < 6 + 3 * frame[5]:
        return False
    components = {frame[6 + 3 * one] for one in range(frame[5])}
    done: dict[int, set[int]] = {component: set() for component in components}
    for scan in scans:
        count = scan[0] if scan else 0
        if len(scan) < 4 + 2 * count:
            return False
        first, last, bits = scan[1 + 2 * count : 4 + 2 * count]
        if bits & 15 == 0:
            for one in range(count):
                done.setdefault(scan[1 + 2 * one], set()).update(range(first, last + 1))
    return all(set(range(64)) <= coefficients for coefficients in done.values())
