"""The options of a command, as its dataclass tells them: for help, and for words that are none."""

from __future__ import annotations

import ast
import inspect
import re
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from types import NoneType
from typing import Annotated, Any, Literal, get_args, get_origin, get_type_hints

import tyro

_KINDS: dict[type, tuple[str, str]] = {
    int: ("N", "a whole number"),
    float: ("N", "a number"),
    Path: ("FILE", "a file"),
    str: ("TEXT", "a text"),
}
"""What a value of a type is called, and what it is."""

_FOR_READERS_OF_CODE = re.compile(r",? see `[^`]+`")


@dataclass(frozen=True)
class Option:
    """An option of a command, or one of the words that need none."""

    name: str
    """Its name without hyphens before it; that of the value where it is positional."""

    about: str
    """What it means."""

    value: str
    """What its value is called; empty for a switch."""

    choices: tuple[str, ...] = ()
    """All values it may have; empty where there are too many to name."""

    kind: type = str
    """Type of a value."""

    default: Any = None
    """Its value unless given."""

    many: bool = False
    """Whether it takes several values."""

    positional: bool = False
    """Whether its value stands alone, without a name before it."""

    required: bool = False
    """Whether there is no default."""

    switched: bool = False
    """Whether it takes no value, and has a second name that switches it off."""

    led_by: str = ""
    """What is said of the options that it stands with."""

    @property
    def is_setting(self) -> bool:
        """Whether it is one of the many single settings."""
        return "." in self.name

    @property
    def flags(self) -> tuple[str, ...]:
        """How it is written on a command line; nothing for what is positional."""
        if self.positional:
            return ()
        if not self.switched:
            return (f"--{self.name}",)
        before, dot, last = self.name.rpartition(".")
        return f"--{self.name}", f"--{before}{dot}no-{last}"

    @property
    def takes(self) -> str:
        """What its value is, in words."""
        return _KINDS[self.kind][1]

    @property
    def usual(self) -> str:
        """Its default in words; empty where that goes without saying."""
        value = self.default
        if self.required or value is None or value is False or value in ("", ()):
            return ""
        if isinstance(value, bool):
            return "on"
        if isinstance(value, float):
            return f"{value:g}" if abs(value) < 1e5 else f"{value:,.0f}".replace(",", "")
        return " ".join(map(str, value)) if isinstance(value, tuple) else str(value)


def options_of(command: object) -> list[Option]:
    """All options of a command, in the order in which its dataclass has them.

    Args:
        command: The command with its defaults.
    """
    return list(_options(command, "", ""))


def _options(holder: Any, prefix: str, led_by: str) -> Iterator[Option]:  # noqa: ANN401
    hints = get_type_hints(type(holder), include_extras=True)
    said = _documented(type(holder))
    for one in fields(holder):
        marks = list(getattr(hints[one.name], "__metadata__", ()))
        if tyro.conf.Suppress in marks:
            continue
        named = [mark.name for mark in marks if getattr(mark, "name", None) is not None]
        name = prefix + (named[0] if named else one.name.replace("_", "-"))
        default = getattr(holder, one.name)
        if is_dataclass(default) and default is not tyro.MISSING:
            yield from _options(default, f"{name}." if name else "", said.get(one.name, ""))
        else:
            yield _option(name, hints[one.name], marks, default, said.get(one.name, ""), led_by)


def _option(
    name: str,
    hint: Any,  # noqa: ANN401  # any type that a field may have
    marks: list[Any],
    default: Any,  # noqa: ANN401
    about: str,
    led_by: str,
) -> Option:
    """What the type of a field says of its option."""
    kind = get_args(hint)[0] if get_origin(hint) is Annotated else hint
    if many := get_origin(kind) is tuple:
        kind = get_args(kind)[0]
    choices = tuple(_choices(kind))
    plain = str if choices else next(one for one in (*get_args(kind), kind) if one is not NoneType)
    called = [mark.metavar for mark in marks if getattr(mark, "metavar", None)]
    switch = plain is bool
    usual = "{" + ",".join(choices) + "}" if choices else "" if switch else _KINDS[plain][0]
    required = default is tyro.MISSING
    return Option(
        name,
        about,
        called[0] if called else usual,
        choices,
        plain,
        None if required else default,
        many,
        positional=tyro.conf.Positional in marks,
        required=required,
        switched=switch and tyro.conf.FlagCreatePairsOff not in marks,
        led_by=led_by,
    )


def _choices(kind: object) -> Iterator[str]:
    """The texts that a type names, in their order."""
    if get_origin(kind) is Literal:
        yield from get_args(kind)
    else:
        for one in get_args(kind):
            yield from _choices(one)


def _documented(kind: type) -> dict[str, str]:
    """What stands below each field of a dataclass, without marks and links of the docs."""
    found: dict[str, str] = {}
    for one in reversed(kind.__mro__[:-1]):
        (tree,) = ast.parse(textwrap.dedent(inspect.getsource(one))).body
        assert isinstance(tree, ast.ClassDef)
        for field, below in zip(tree.body, tree.body[1:], strict=False):
            if not (isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)):
                continue
            if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant):
                said = _FOR_READERS_OF_CODE.sub("", " ".join(str(below.value.value).split()))
                found[field.target.id] = said.replace("`", "")
    return found
