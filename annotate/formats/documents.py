"""Text files of other programs: read safely, in any of the usual encodings, also from a ZIP."""

from __future__ import annotations

import json
import re
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from typing import Any
from xml.etree import ElementTree as ET  # documents with a DOCTYPE are refused

from skyline_viz.datasets.outlines import FormatError
from skyline_viz.files import read_at_most

MOST_BYTES = 500_000_000
"""Bytes of a text file."""

_MOST_MEMBERS, _MOST_UNPACKED = 100_000, 4_000_000_000
_TEXT = (".json", ".xml", ".csv", ".txt", ".yaml", ".yml")
_BOMS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))


def read_text(file: Path) -> str:
    """The text of a file, in the encoding that it declares, or in UTF-8.

    Raises:
        FormatError: It cannot be read, is too large, or is in another encoding.
    """
    try:
        whole = read_at_most(file, MOST_BYTES)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise FormatError(f"{file} cannot be read: {reason}.") from error
    encoding = next((name for mark, name in _BOMS if whole.startswith(mark)), "")
    if not encoding and whole[:2] in (b"<\0", b"{\0", b"[\0"):
        encoding = "utf-16-le"
    declared = re.match(rb"<\?xml[^>]{0,80}encoding=[\"']([A-Za-z0-9._-]{1,30})[\"']", whole)
    encoding = encoding or (declared[1].decode() if declared else "utf-8")
    try:
        return whole.decode(encoding)
    except LookupError:
        raise FormatError(f"{file} is in the unknown encoding {encoding}.") from None
    except UnicodeError:
        raise FormatError(
            f"{file} is not in the encoding {_shown(encoding)}{_guess(whole)}."
        ) from None


def json_of(file: Path) -> Any:  # noqa: ANN401
    """What a JSON file holds.

    Raises:
        FormatError: It cannot be read, or is no JSON.
    """
    try:
        return json.loads(read_text(file))
    except FormatError:
        raise
    except RecursionError:
        raise FormatError(f"{file} is not JSON: it is nested too deeply.") from None
    except ValueError as error:
        raise FormatError(f"{file} is not JSON: {str(error).rstrip('.').lower()}.") from error


def xml_of(file: Path) -> ET.Element:
    """The root of an XML file.

    Raises:
        FormatError: It cannot be read, is no XML, or declares a document type.
    """
    text = read_text(file)
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise FormatError(f"{file} declares a document type, which labels do not need.")
    try:
        return ET.fromstring(text)  # noqa: S314  # without a document type there are no entities
    except (ValueError, RecursionError, ET.ParseError) as error:
        raise FormatError(f"{file} is not XML: {error}.") from error


@contextmanager
def unpacked(source: Path) -> Iterator[Path]:
    """A file or folder as it is; of a ZIP the folder of what is in it, as long as it is needed.

    Beside JSON and XML nothing but text is unpacked: photos lie there, too.

    Raises:
        FormatError: It is no sound ZIP, or holds too much.
    """
    if source.is_dir() or source.suffix.lower() != ".zip":
        yield source
        return
    with tempfile.TemporaryDirectory(prefix="skyline-labels-") as folder:
        try:
            with zipfile.ZipFile(source) as packed:
                _unpack(packed, source, Path(folder))
        except (zipfile.BadZipFile, NotImplementedError, RuntimeError, EOFError) as error:
            raise FormatError(f"{source} is no sound ZIP file: {str(error).lower()}.") from error
        except (OSError, ValueError) as error:
            if isinstance(error, FormatError):
                raise
            raise FormatError(f"{source} cannot be unpacked: {str(error).lower()}.") from error
        except Exception as error:  # zlib and lzma have errors of their own
            raise FormatError(f"{source} is damaged: {str(error).lower()}.") from error
        yield Path(folder)


def _unpack(packed: zipfile.ZipFile, source: Path, folder: Path) -> None:
    members = [one for one in packed.infolist() if not one.is_dir() and _is_plain(one.filename)]
    if len(members) > _MOST_MEMBERS:
        raise FormatError(f"{source} holds {len(members):,} files, over {_MOST_MEMBERS:,}.")
    endings = {PurePosixPath(one.filename).suffix.lower() for one in members}
    if {".json", ".xml"} & endings:
        members = [one for one in members if PurePosixPath(one.filename).suffix.lower() in _TEXT]
    left = _MOST_UNPACKED
    for member in members:
        path = folder / member.filename
        path.parent.mkdir(parents=True, exist_ok=True)
        with packed.open(member) as inside, path.open("wb") as out:
            while part := inside.read(1 << 20):  # what the archive claims is not trusted
                left -= len(part)
                if left < 0:
                    limit = _MOST_UNPACKED // 1_000_000
                    raise FormatError(
                        f"{source} holds more than {limit:,} MB; unpack it, and name its folder."
                    )
                out.write(part)


def _is_plain(name: str) -> bool:
    """Whether a member lies inside the folder, and is no leaving of macOS."""
    path = PurePosixPath(name)
    hidden = any(part.startswith(".") or part == "__MACOSX" for part in path.parts)
    return not (path.is_absolute() or hidden or "\\" in name or "\0" in name)


def _shown(encoding: str) -> str:
    return "UTF-8" if encoding.startswith("utf-8") else encoding


def misread(text: str) -> str:
    """What a name would be in GB2312, if it is odd as it was read; else nothing.

    Chinese text is sometimes sound UTF-8, too, and then of letters that hardly anybody uses.
    """
    odd = re.search(r"[\u0180-\u036f\u0500-\u058f\u0700-\u07ff]", text)
    try:
        return text.encode("utf-8").decode("gb18030") if odd else ""
    except UnicodeError:
        return ""


def _guess(whole: bytes) -> str:
    """What else a text could be in."""
    for encoding, name in (("gb18030", "GB2312"), ("shift_jis", "Shift JIS")):
        try:
            text = whole.decode(encoding)
        except UnicodeError:
            continue
        if any(ord(one) > 0x2E7F for one in text):
            return f", but perhaps in {name}: save it as UTF-8"
    return ": save it as UTF-8"
