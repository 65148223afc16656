"""The chunks of a PNG: what its pixels need is kept, and what could only do harm is passed over.

A damaged comment, two megabytes of text or a missing end are no reason to lose a photo, but Pillow
stops at each of them. So it is given the file without them.
"""

import io
import struct
import zlib
from dataclasses import dataclass
from typing import BinaryIO

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_END = b"\0\0\0\0IEND\xaeB`\x82"
_SMALL = {b"tRNS", b"eXIf", b"sBIT", b"gAMA", b"sRGB", b"iCCP", b"cICP"}
_MOST_SMALL = 1 << 20  # bytes: more is no orientation and no palette
_PROFILE = b"Raw profile type exif\0"  # EXIF as ImageMagick wrote it, in a text chunk


@dataclass(frozen=True)
class PngChunks:
    """What a PNG says about itself."""

    size: tuple[int, int]
    """Width and height in pixels."""

    depth: int
    """Bits of a sample."""

    colour: int
    """Its colour type: 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA."""

    small: dict[bytes, bytes]
    """Content of the ancillary chunks that matter, by their kind."""

    notes: tuple[str, ...]
    """What is wrong with it, to go on after its name."""

    pixels: tuple[tuple[bytes, int, int], ...]
    """Kind, place and length of each chunk to hand on, with the 12 bytes around its content."""

    @property
    def exif(self) -> bytes | None:
        """Its EXIF block, wherever in the file it stands."""
        return self.small.get(b"eXIf")

    @property
    def significant_bits(self) -> int | None:
        """The bits that count in each sample, where the file says so."""
        bits = self.small.get(b"sBIT")
        return max(bits[:3] if self.colour in (2, 6) else bits[:1]) if bits else None

    @property
    def gamma(self) -> float | None:
        """The exponent of its encoding, where the file says so and no colour profile overrides."""
        data = self.small.get(b"gAMA")
        if not data or len(data) != 4 or self.small.keys() & {b"sRGB", b"iCCP", b"cICP"}:
            return None
        return int.from_bytes(data) / 100_000


def png_chunks(file: BinaryIO) -> PngChunks:
    """Read what a PNG says about itself, without its pixels.

    Raises:
        ValueError: It has no header.
    """
    end = file.seek(0, io.SEEK_END)
    file.seek(len(_SIGNATURE))
    small: dict[bytes, bytes] = {}
    damaged: dict[str, None] = {}
    pixels: list[tuple[bytes, int, int]] = []
    header = b""
    kind = b""
    while kind != b"IEND":
        place = file.tell()
        head = file.read(8)
        if len(head) < 8:
            break
        length, kind = struct.unpack(">I4s", head)
        whole = place + 12 + length <= end
        if kind == b"IHDR" and not header:
            header = file.read(13)
        if kind[:1].isupper() and kind != b"IEND":
            pixels.append((kind, place, min(12 + length, end - place)))
        elif kind in _SMALL and whole and length <= _MOST_SMALL:
            data, checksum = file.read(length), file.read(4)
            if zlib.crc32(kind + data).to_bytes(4) == checksum:
                small.setdefault(kind, data)
            else:
                damaged[kind.decode()] = None
            if kind == b"tRNS" and kind in small:
                pixels.append((kind, place, 12 + length))
        elif kind in (b"tEXt", b"zTXt", b"iTXt") and whole:
            _look_at_text(file, kind, length, small, damaged)
        file.seek(place + 12 + length)
    if len(header) < 13:
        raise ValueError("it has no header")
    width, height, depth, colour = struct.unpack(">IIBB", header[:10])
    notes = [f"has a damaged {chunk} chunk, which was passed over" for chunk in damaged]
    if kind != b"IEND":
        notes.append("ends without its end marker, but all of its pixels are there")
    return PngChunks((width, height), depth, colour, small, tuple(notes), tuple(pixels))


def clean_png(file: BinaryIO, chunks: PngChunks) -> io.BytesIO:
    """The PNG with what its pixels need, and nothing else."""
    clean = io.BytesIO()
    clean.write(_SIGNATURE)
    for _, place, length in chunks.pixels:
        file.seek(place)
        clean.write(file.read(length))
    clean.write(_END)
    clean.seek(0)
    return clean


def _look_at_text(
    file: BinaryIO, kind: bytes, length: int, small: dict[bytes, bytes], damaged: dict[str, None]
) -> None:
    """Tell whether a text is damaged, and keep it where it is EXIF in disguise."""
    start = file.read(min(length, len(_PROFILE) + 1))
    profile = start.startswith(_PROFILE) and length <= _MOST_SMALL
    rest = length - len(start)
    checksum = zlib.crc32(kind + start)
    text = start
    while rest > 0 and (part := file.read(min(rest, 1 << 16))):
        checksum = zlib.crc32(part, checksum)
        rest -= len(part)
        text += part if profile else b""
    if checksum.to_bytes(4) != file.read(4):
        damaged[kind.decode()] = None
    elif profile and b"eXIf" not in small and (exif := _unwrapped(kind, text)):
        small[b"eXIf"] = exif


def _unwrapped(kind: bytes, text: bytes) -> bytes | None:
    """EXIF in the hexadecimal digits of a text chunk; None where there is none."""
    content = text[len(_PROFILE) :]
    try:
        if kind == b"zTXt":
            content = zlib.decompressobj().decompress(content[1:], _MOST_SMALL)
        elif kind == b"iTXt":
            return None
        return bytes.fromhex("".join(content.decode("ascii").split("\n")[3:]))
    except (ValueError, zlib.error):
        return None
