"""What kind of picture a file is: told by its first bytes, and by its name where they say nothing.

Nothing here decodes. A kind that is not read is refused by name, with what to do about it.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import Literal

from skyline_viz.files import opened_at_once

PHOTO_SUFFIXES = frozenset(
    {".avif", ".bmp", ".dib", ".gif", ".heic", ".heif", ".hif", ".j2c", ".j2k", ".jfif", ".jp2"}
    | {".jpe", ".jpeg", ".jpf", ".jpg", ".jpx", ".pbm", ".pgm", ".png", ".pnm", ".ppm", ".tif"}
    | {".tiff", ".webp"}
)
"""File name endings (lower case) that are taken for photographs when a folder is searched."""

RAW_SUFFIXES = frozenset(
    {".3fr", ".arw", ".cr2", ".cr3", ".crw", ".dcr", ".dng", ".erf", ".fff", ".gpr", ".iiq"}
    | {".k25", ".kdc", ".mef", ".mos", ".mrw", ".nef", ".nrw", ".orf", ".pef", ".raf", ".raw"}
    | {".rw2", ".rwl", ".sr2", ".srf", ".srw", ".x3f"}
)
"""Endings of the raw files of cameras."""

RAW = "a raw file of a camera: develop it to JPEG or TIFF first"
"""What is said of such a file."""

_NOT_READ = {
    ".jxl": "JPEG XL",
    ".jxr": "JPEG XR",
    ".exr": "OpenEXR",
    ".hdr": "Radiance HDR",
    ".pfm": "PFM, floating-point numbers",
    ".psd": "Photoshop",
    ".psb": "Photoshop",
    ".xcf": "GIMP",
    ".svg": "SVG, a drawing",
    ".eps": "EPS, a drawing",
    ".ico": "icons",
    ".pcx": "PCX",
    ".tga": "Targa",
    ".dds": "DDS",
    ".fits": "FITS",
    ".pam": "PAM",
    ".qoi": "QOI",
}
"""Endings of pictures in other formats that are not read, and what these are called."""

Kind = Literal["png", "tiff", "heif", "jpeg", "other"]
"""How a file is read."""

_HEIF_BRANDS = {b"heic", b"heix", b"heim", b"heis", b"hevc", b"hevx", b"mif1", b"msf1"}
_RAW_STARTS = (
    b"FUJIFILMCCD-RAW",
    b"FOVb",  # Sigma
    b"\0MRM",  # Minolta
    b"IIRO",  # Olympus
    b"IIRS",
    b"MMOR",
    b"IIU\0",  # Panasonic, Leica
    b"II\x1a\0\0\0HEAPCCDR",  # Canon CRW
)


class RefusedError(Exception):
    """A picture is not read; the message goes on after its name: ``is JPEG XL, which ...``."""


def kind_of(head: bytes, path: Path) -> Kind:
    """How to read a file.

    Args:
        head: Its first 32 bytes, or more.
        path: Its name.

    Raises:
        RefusedError: It is a picture of a kind that is not read.
    """
    if head.startswith(b"\xff\xd8\xff"):
        return "jpeg"
    if head.startswith(b"\x89PNG\r\n\x1a\n"):
        return "png"
    cr2 = head[8:10] == b"CR" and head[:4] == b"II*\0"
    if cr2 or head.startswith(_RAW_STARTS) or head[4:12] == b"ftypcrx ":
        raise RefusedError(f"is {RAW}")
    if head.startswith((b"\xff\x0a", b"\0\0\0\x0cJXL \r\n\x87\n")):
        raise RefusedError("is JPEG XL, which cannot be read; convert it to JPEG or PNG")
    if head[:4] in (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"):
        if path.suffix.lower() in RAW_SUFFIXES:  # some say nowhere inside that they are
            raise RefusedError(f"is {RAW}")
        return "tiff"
    if head[4:8] == b"ftyp" and head[8:12] in _HEIF_BRANDS and b"avif" not in head:
        return "heif"
    return "other"


def unknown(path: Path) -> str:
    """What is said of a file in which no picture was found, to go on after its name."""
    suffix = path.suffix.lower()
    if suffix in RAW_SUFFIXES:
        return f"is {RAW}"
    if suffix in _NOT_READ:
        return f"is no image in a format that can be read ({_NOT_READ[suffix]})"
    return "is not an image in a format that can be read"


def why_unread(file: Path) -> str | None:
    """Why what looks like a picture is not taken; None for a photo, and for anything else."""
    suffix = file.suffix.lower()
    if _is_raw(file):
        return "raw files of cameras: develop them to JPEG or TIFF first"
    if suffix in _NOT_READ:
        return _NOT_READ[suffix]
    if suffix in PHOTO_SUFFIXES:
        return None if file.is_file() else "no regular file, or a link to nothing"
    if suffix.startswith(".sqlite"):
        return None  # to open and close a database would end the locks that this process has on it
    try:
        with open(file, "rb", opener=opened_at_once) as opened:  # a path has no opener
            head = opened.read(16)
    except OSError:
        return None
    heif = head[4:8] == b"ftyp" and head[8:12] in {*_HEIF_BRANDS, b"avif"}
    webp = head[:4] == b"RIFF" and head[8:12] == b"WEBP"
    others = (b"\xff\xd8\xff", b"\x89PNG\r\n\x1a\n", b"GIF8", b"\0\0\0\x0cjP  ")
    return "not named as a photo is" if heif or webp or head.startswith(others) else None


def left_out(files: Iterable[Path], within: Path) -> str | None:
    """One sentence that names pictures which are not taken, grouped by the reason; None for none.

    >>> left_out([Path("f/b.jxl"), Path("f/a.nef")], Path("f"))
    '2 files are no photos that can be read: a.nef (raw files of cameras: develop them to JPEG or \
TIFF first); b.jxl (JPEG XL).'
    """
    groups: dict[str, list[str]] = {}
    for file in sorted(files, key=lambda file: (not _is_raw(file), file)):
        reason = why_unread(file) or "not taken"
        groups.setdefault(reason, []).append(file.relative_to(within).as_posix())
    if not groups:
        return None
    count = sum(map(len, groups.values()))
    named = "; ".join(f"{', '.join(names)} ({reason})" for reason, names in groups.items())
    be = "file is no photo" if count == 1 else "files are no photos"
    return f"{count} {be} that can be read: {named}."


def _is_raw(file: Path) -> bool:
    return file.suffix.lower() in RAW_SUFFIXES
