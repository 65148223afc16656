"""Names as they may be shown: on a terminal, in a table, in the viewer.

A file system allows any bytes but ``/`` and NUL. What is shown passes through here: a terminal
would obey escape sequences, right-to-left marks would turn sentences round, and the viewer stops
at a character that its font does not have. Names of files themselves stay as they are.
"""

from __future__ import annotations

import hashlib
import re
import unicodedata
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.text import Text

_HARMFUL = ("Cc", "Cs", "Zl", "Zp")
_JOINERS = "\u200c\u200d"  # harmless, and part of words and of emoji
_NOT_IN_FONTS = re.compile(
    "[^\n -~\u00a0-\u00ac\u00ae-\u0148\u014a-\u017f"  # Latin
    "\u0384-\u038a\u038e-\u03a1\u03a3-\u03cf"  # Greek
    "\u0401-\u040c\u040e-\u044f\u0451-\u045c"  # Cyrillic
    "\u1e80-\u1e85\u1ea0-\u1ef9"  # Vietnamese
    "\u2010\u2013\u2014\u2018-\u201e\u2020-\u2022\u2026\u2030\u2032-\u2034\u20ac\u2122"
    "\u2190-\u2193\u2212\u2248\u2260\u2264\u2265]"
)
"""Characters that one of the viewer's two fonts, Inter and JetBrains Mono, has not."""

_MARKDOWN = re.compile(r"([\\`*_{}\[\]<>()#+!|~&$])")
_PLAIN = re.compile(r"[\w.-]{1,80}", re.ASCII)


def printable(text: str) -> str:
    r"""Text on one line in which nothing is left that a terminal would obey.

    Control characters, line ends, marks that turn the direction and bytes that are no text become
    escapes.

    >>> printable("a\x1b[31mb\nc\udcfc.jpg")
    'a\\x1b[31mb\\nc\\xfc.jpg'
    """
    if text.isprintable():
        return text
    return "".join(_escaped(one) if _is_harmful(one) else one for one in text)


def shortened(name: str, most: int = 48) -> str:
    """A name for a column of a table: printable, and without its middle where it is long.

    >>> shortened("a-very-long-name-of-a-photo.jpg", most=20)
    'a-very-lo…-photo.jpg'
    """
    shown = printable(name)
    if len(shown) <= most:
        return shown
    end = most // 2
    return f"{shown[: most - end - 1]}…{shown[-end:]}"


def cell(name: str) -> Text:
    """A name as a cell of a table that rich draws, where nothing in it is taken for markup."""
    from rich.text import Text  # noqa: PLC0415  # only tables need it

    return Text(shortened(name))


def columns_of(text: str) -> int:
    """Columns that a text takes on a terminal.

    >>> columns_of("a富")
    3
    """
    if text.isascii():
        return len(text)
    wide = (2 if unicodedata.east_asian_width(one) in "WF" else 1 for one in text)
    return sum(
        0 if unicodedata.combining(one) else size for one, size in zip(text, wide, strict=True)
    )


def padded(name: str, wide: int) -> str:
    """A name and blanks up to `wide` columns."""
    return name + " " * (wide - columns_of(name))


def shown_in_viewer(text: str) -> str:
    r"""Text of which the viewer's fonts have every character; others become escapes.

    Lines stay lines.

    >>> shown_in_viewer("Zürich 富.jpg")
    'Zürich \\u5bcc.jpg'
    """
    if text.isascii() and (text.isprintable() or text.replace("\n", "").isprintable()):
        return text
    composed = unicodedata.normalize("NFC", text)
    return _NOT_IN_FONTS.sub(lambda found: _escaped(found[0]), composed)


def named_in_markdown(name: str) -> str:
    r"""A name inside a Markdown document, where none of its characters means anything.

    >>> named_in_markdown("*a*_1.jpg")
    '\\*a\\*\\_1.jpg'
    """
    return _MARKDOWN.sub(r"\\\1", printable(name))


def recording_id(name: str) -> str:
    """An identifier that stands for a name in addresses: the name itself where it is plain.

    >>> recording_id("hill-1.jpg"), recording_id("hash#1")
    ('hill-1.jpg', 'hash_1-8051608ee653')
    """
    if _PLAIN.fullmatch(name):
        return name
    digest = hashlib.sha256(name.encode(errors="surrogatepass")).hexdigest()[:12]
    plain = re.sub(r"[^\w.-]", "_", name, flags=re.ASCII)[:60]
    return f"{plain}-{digest}"


def _is_harmful(character: str) -> bool:
    kind = unicodedata.category(character)
    return kind in _HARMFUL or (kind == "Cf" and character not in _JOINERS)


def _escaped(character: str) -> str:
    code = ord(character)
    if 0xDC80 <= code <= 0xDCFF:  # a byte that was no text
        return f"\\x{code - 0xDC00:02x}"
    return character.encode("unicode_escape").decode("ascii")


def listed(names: Sequence[str], most: int = 8) -> str:
    """Names in a sentence.

    >>> listed(["a", "b", "c"], most=2)
    'a, b and 1 more'
    """
    more = len(names) - most
    return ", ".join(names[:most]) + (f" and {more} more" if more > 0 else "")


def told_in_picture(title: str) -> str:
    """A title of one or more lines, without what a picture cannot show."""
    return "\n".join(shown_in_viewer(printable(line)) for line in title.splitlines())
