"""Small pictures in files of every kind, and the sentence with which one is refused."""

import struct
import zlib

import numpy as np
import pytest
from PIL import Image

from skyline_viz.photo import PhotoError, read_photo

# A picture that survives JPEG: 16x16 blocks of one colour, no two rotations of it alike.
BLOCKS = np.array(
    [
        [[200, 40, 40], [40, 200, 40], [40, 40, 200]],
        [[220, 220, 40], [30, 30, 30], [230, 230, 230]],
    ],
    np.uint8,
)


PHOTO = BLOCKS.repeat(16, axis=0).repeat(16, axis=1)  # (32, 48, 3)
NOISE = np.random.default_rng(7).integers(0, 256, (24, 32, 3), dtype=np.uint8)
LOSSLESS = ["a.png", "a.bmp", "a.ppm", "a.tif", "a.tiff", "a.webp"]
EVERY_FORMAT = ["a.jpg", "a.jpeg", *LOSSLESS, "a.pgm"]


# Where the first row and the first column of the stored pixels lie in the upright photo.
STORED = {
    1: lambda a: a,  # top, left
    2: lambda a: a[:, ::-1],  # top, right
    3: lambda a: a[::-1, ::-1],  # bottom, right
    4: lambda a: a[::-1],  # bottom, left
    5: lambda a: a.transpose(1, 0, 2),  # left, top
    6: lambda a: np.rot90(a, 1),  # right, top
    7: lambda a: np.rot90(a, 1)[:, ::-1],  # right, bottom
    8: lambda a: np.rot90(a, -1),  # left, bottom
}


def save(path, pixels, **options):
    if path.suffix == ".webp":
        options.setdefault("lossless", True)
    if path.suffix in (".jpg", ".jpeg"):
        options = {"quality": 100, "subsampling": 0} | options
    if path.suffix == ".pgm" and pixels.ndim == 3:
        pixels = pixels[:, :, 1]
    Image.fromarray(np.ascontiguousarray(pixels)).save(path, **options)
    return path


def refusal(path, **options):
    """The sentence with which a photo is refused."""
    with pytest.raises(PhotoError) as caught:
        read_photo(path, **options)
    message = str(caught.value)
    assert message.startswith(str(path))
    assert message.endswith(".")
    assert not message.endswith("..")
    assert "\n" not in message
    return message


def close(photo, expected, tolerance=6):
    return photo.shape == expected.shape and (
        np.abs(photo.astype(int) - expected).max(initial=0) <= tolerance
    )


def bomb(path, width, height):
    """A PNG of a few bytes that says it is huge."""

    def chunk(kind, data):
        checksum = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + checksum

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"\0")) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunks)
    return path
