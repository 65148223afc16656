"""Photo files that are edited as people's programs edit them, for tests of identity."""

import struct
import zlib

from PIL import Image

from skyline_viz.photo import write_photo
from testing.labelling import hills


def write_jpegs(folder, count=3, **size):
    """Write photos ``hill-0.jpg`` and so on, all of one size."""
    folder.mkdir(parents=True, exist_ok=True)
    for seed in range(count):
        write_photo(folder / f"hill-{seed}.jpg", hills(seed, **size), quality=95)
    return folder


def with_comment(path, text="by hand"):
    """Insert a comment into a JPEG or PNG file; not one pixel changes."""
    data = path.read_bytes()
    if data[:2] == b"\xff\xd8":
        comment = text.encode()
        data = data[:2] + b"\xff\xfe" + struct.pack(">H", len(comment) + 2) + comment + data[2:]
    else:
        body = b"tEXt" + b"Comment\0" + text.encode()
        chunk = struct.pack(">I", len(body) - 4) + body + struct.pack(">I", zlib.crc32(body))
        data = data[:33] + chunk + data[33:]  # behind the header
    path.write_bytes(data)


def with_place(path, degrees=46.5):
    """Write a place into the EXIF block of a JPEG, and keep its pixels as they are encoded."""
    exif = Image.Exif()
    exif.get_ifd(0x8825)[2] = (degrees, 0.0, 0.0)
    exif[0x8825] = {1: "N", 2: (degrees, 0.0, 0.0)}
    block = exif.tobytes()
    data = path.read_bytes()
    segment = b"\xff\xe1" + struct.pack(">H", len(block) + 2) + block
    path.write_bytes(data[:2] + segment + data[2:])


def replaced(path, seed):
    """Put another photo of the same size under a name, as a copy from a card does."""
    height, width = hills_size(path)
    write_photo(path, hills(seed, height, width), quality=95)


def hills_size(path):
    """Height and width of a photo."""
    with Image.open(path) as image:
        return image.height, image.width
