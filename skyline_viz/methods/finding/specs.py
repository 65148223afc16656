"""How a method is named: ``[LABEL=](NAME | FILE | package.module:Class)[:setting=value,...]``.

>>> parse("steep=paper:delta=4,link_weight=0.1", lambda text: False)
Spec(target='paper', settings={'delta': '4', 'link_weight': '0.1'}, label='steep', is_file=False)
>>> parse("my_pkg.mod:Mine:size=3", lambda text: False).target
'my_pkg.mod:Mine'

Names of files may hold all of these signs. Where a part of the text is the name of a file that is
there, the longest such part is the file, and only what is left are settings and label:

>>> parse("hills, 2=b:1.npz:delta=8", lambda text: text == "hills, 2=b:1.npz").settings
{'delta': '8'}
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from skyline_viz.system.settings import SettingError

SETTINGS = re.compile(r":(?=[A-Za-z_]\w*=)")
"""Where settings begin."""

_LABEL = re.compile(r"([^=:/\\]+)=(.+)", re.DOTALL)
_NEXT = re.compile(r",(?=[A-Za-z_]\w*=)")


@dataclass(frozen=True)
class Spec:
    """What a method is named by, taken apart."""

    target: str
    """A name, a file, or ``package.module:Class``."""

    settings: dict[str, str]
    """Settings by name, as they were written."""

    label: str = ""
    """What it should be called; nothing where it is not said."""

    is_file: bool = False
    """Whether the target is a file that is there."""


def parse(text: str, is_file: Callable[[str], bool]) -> Spec:
    """Take apart what somebody named.

    Args:
        text: What they wrote.
        is_file: Whether there is a file of a name.

    Raises:
        SettingError: A setting is named twice.
    """
    labelled = _LABEL.fullmatch(text)
    readings = [("", text)] + ([(labelled[1], labelled[2])] if labelled else [])
    for label, rest in readings:
        for target, settings in _cuts(rest):
            if is_file(target):
                return Spec(target, _apart(settings, text), label, is_file=True)
    label, rest = readings[-1]
    begin = SETTINGS.search(rest)
    if not begin:
        return Spec(rest, {}, label)
    return Spec(rest[: begin.start()], _apart(rest[begin.end() :], text), label)


def _cuts(text: str) -> Iterator[tuple[str, str]]:
    """Target and settings, for each place where the settings may begin, the last one first."""
    yield text, ""
    for begin in reversed(list(SETTINGS.finditer(text))):
        yield text[: begin.start()], text[begin.end() :]


def _apart(settings: str, text: str) -> dict[str, str]:
    found: dict[str, str] = {}
    for one in _NEXT.split(settings) if settings else ():
        name, _, value = one.partition("=")
        if name in found:
            raise SettingError(f"{text} sets {name} twice.")
        found[name] = value
    return found
