"""Settings by name: how they are spelt, read from text, and checked. Light to import.

A method's settings have names, kinds and ranges. Whatever has settings is called by the nearest of
its presets and by what differs from it, as in ``paper:delta=4,link_weight=0.1``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from numbers import Integral, Real
from pathlib import Path
from types import NoneType
from typing import (
    Any,
    ClassVar,
    Literal,
    Self,
    TypeAlias,
    TypeVar,
    get_args,
    get_origin,
    get_type_hints,
)

from skyline_viz.system.nearest import meant

MOST = 1_000_000
"""Largest value of a setting that names no range: pixels, costs, epochs."""

Value = TypeVar("Value")

Presets: TypeAlias = Mapping[str, Mapping[str, object]]
"""Settings by the name of a preset."""


class SettingError(ValueError):
    """A setting is unknown, or has a value that it cannot have; the message says what it takes."""


class MethodError(ValueError):
    """A method is unknown, has not been trained, or lacks what it needs; the message says what."""


def within(default: Value, low: float, high: float = MOST) -> Value:
    """A field of a dataclass whose numbers go from `low` to `high`, both included."""
    made: Value = field(default=default, metadata={"range": (low, high)})
    return made


def check_number(name: str, value: object, low: float, high: float, whole: bool = False) -> None:
    """Refuse anything but a number in a range.

    Raises:
        SettingError: The message names the setting and its range.
    """
    kind = "whole number" if whole else "number"
    plain = type(value) is int or (type(value) is float and not whole)
    numeric = plain or (
        isinstance(value, Integral if whole else Real) and not isinstance(value, bool)
    )
    if not (numeric and low <= plain_number(value) <= high):
        raise SettingError(f"{name} is a {kind} from {low:g} to {_plain(high)}, not {_said(value)}")


def plain_number(value: object, real: bool = False) -> Any:  # noqa: ANN401 - or what it was
    """A number as Python's own, whoever made it, as files and names need it; all else as it is.

    Args:
        value: The value of a setting.
        real: Whether a whole number becomes a real one, too.

    >>> import numpy as np
    >>> plain_number(np.float32(0.25)), plain_number(np.int64(4)), plain_number(1, real=True)
    (0.25, 4, 1.0)
    """
    if type(value) is float:  # most are, and abstract kinds are slow to ask for
        return value
    if isinstance(value, tuple):
        return tuple(plain_number(one, real) for one in value)
    if isinstance(value, bool) or not isinstance(value, Real):
        return value
    return int(value) if isinstance(value, Integral) and not real else float(value)


def spelt(value: object) -> str:
    """A value as it is written in the name of a method.

    >>> spelt(0.1), spelt(4.0), spelt(True)
    ('0.1', '4', 'true')
    """
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float) and value.is_integer() and abs(value) < MOST:
        return str(int(value))
    return str(value)


def name_with(base: str, settings: Mapping[str, object], usual: Mapping[str, object]) -> str:
    """A name and the settings that are not the usual ones, in their order.

    >>> name_with("paper", {"v": 0.5, "delta": 4}, {"v": 0.5, "delta": 1})
    'paper:delta=4'
    """
    differ = [f"{one}={spelt(value)}" for one, value in settings.items() if value != usual.get(one)]
    return f"{base}:{','.join(differ)}" if differ else base


def nearest_name(settings: Mapping[str, object], presets: Presets) -> str:
    """The preset from which the fewest settings differ, the first among equals, and these."""

    def differing(preset: str) -> int:
        return sum(value != presets[preset].get(one) for one, value in settings.items())

    best = min(presets, key=differing)
    return name_with(best, settings, presets[best])


def from_texts(texts: Mapping[str, str], kinds: Mapping[str, object], of: str) -> dict[str, object]:
    """Values of settings that are given as text; a text that is no such value stays one.

    Args:
        texts: The texts, by the name of the setting.
        kinds: Type of each setting that there is.
        of: What has these settings, for the message.

    Raises:
        SettingError: There is no setting of that name.
    """
    for name in texts:
        if name not in kinds:
            raise SettingError(f"{of} has no setting {name}; {meant(name, kinds, 'it has')}")
    return {name: _from_text(text, kinds[name]) for name, text in texts.items()}


def from_document(value: object, kind: object) -> object:
    """A value as JSON keeps it, in the type that its setting has."""
    if get_origin(kind) is tuple and isinstance(value, list):
        return tuple(value)
    return Path(value) if isinstance(value, str) and Path in _alternatives(kind) else value


def check_kind(name: str, value: object, kind: object, low: float = 0, high: float = MOST) -> None:
    """Refuse a value of another kind than a setting's, or out of its range.

    Raises:
        SettingError: The message says what the setting takes.
    """
    allowed = _alternatives(kind)
    if value is None and NoneType in allowed:
        return
    if choices := [text for one in allowed if get_origin(one) is Literal for text in get_args(one)]:
        if value not in choices:
            raise SettingError(f"{name} is one of {', '.join(choices)}, not {_said(value)}")
    elif bool in allowed:
        if not isinstance(value, bool):
            raise SettingError(f"{name} is true or false, not {_said(value)}")
    elif float in allowed or int in allowed:
        check_number(name, value, low, high, whole=float not in allowed)
    elif get_origin(kind) is tuple:
        numbers = value if isinstance(value, tuple) else ()
        if len(numbers) != len(get_args(kind)):
            raise SettingError(f"{name} is {len(get_args(kind))} numbers, not {_said(value)}")
        for one in numbers:
            check_number(name, one, -high, high)
    elif not (isinstance(value, str | Path) and value != ""):
        raise SettingError(f"{name} is a text, not {_said(value)}")


@dataclass(frozen=True)
class Configured:
    """A method whose settings are its fields; `name` follows from them, or is its label."""

    PRESETS: ClassVar[Presets] = {}
    """Names under which it is known, and what each sets differently from the defaults."""

    UNSET: ClassVar[frozenset[str]] = frozenset({"label", "learned_from", "seen"})
    """Fields that are no settings."""

    label: str = field(default="", kw_only=True)
    """What it is called instead; empty to be called after its settings."""

    learned_from: str = field(default="", kw_only=True, compare=False, repr=False)
    """Name of the data set that it learned from, as its file says; empty if that is not known."""

    seen: tuple[str, ...] = field(default=(), kw_only=True, compare=False, repr=False)
    """Fingerprints of the photos that it learned from, as its file says."""

    @property
    def name(self) -> str:
        """Its label, or its name and the settings that differ."""
        return self.label or self.own_name()

    def own_name(self) -> str:
        """What it is called without a label."""
        usual = {one: known[1] for one, known in _kinds_of(self).items()}
        presets = {name: {**usual, **changed} for name, changed in self.PRESETS.items()}
        return nearest_name(self.settings(), presets or {type(self).__name__: usual})

    def settings(self) -> dict[str, object]:
        """Its settings by name."""
        names = [one.name for one in fields(self) if one.name not in self.UNSET]
        return {one: plain_number(getattr(self, one)) for one in names}

    def kinds(self) -> dict[str, object]:
        """Type of each setting."""
        return {one: known[0] for one, known in _kinds_of(self).items()}

    def with_settings(self, values: Mapping[str, object]) -> Self:
        """The same with other settings.

        Raises:
            SettingError: A setting is unknown, of another kind, or out of its range.
        """
        known = _kinds_of(self)
        changes: dict[str, Any] = {}
        for name, value in values.items():
            if name not in known:
                raise SettingError(f"there is no setting {name}; {meant(name, known, 'there are')}")
            kind, _, limits = known[name]
            changes[name] = from_document(value, kind)
            check_kind(name, changes[name], kind, *limits)
        return replace(self, **changes)

    def labelled(self, label: str) -> Self:
        """The same under another name."""
        return replace(self, label=label)

    def arrays(self) -> Mapping[str, Any]:
        """What it has learned: nothing."""
        return {}

    def model_bytes(self) -> int:
        """Size of what it has learned, in bytes, as it lies in memory."""
        return sum(array.nbytes for array in self.arrays().values())

    def require_told(self) -> None:
        """Settings that are fields can be written to a file."""


def _kinds_of(method: Configured) -> dict[str, tuple[object, object, tuple[float, float]]]:
    """Type, default and range of each setting."""
    hints = get_type_hints(type(method))
    return {
        one.name: (hints[one.name], one.default, one.metadata.get("range", (0, MOST)))
        for one in fields(method)
        if one.name not in method.UNSET
    }


def _alternatives(kind: object) -> tuple[object, ...]:
    """The types of which a value may be; a text that is one of some counts as one."""
    whole = not get_args(kind) or get_origin(kind) in (Literal, tuple)
    return (kind,) if whole else get_args(kind)


def _from_text(text: str, kind: object) -> object:
    allowed = _alternatives(kind)
    if NoneType in allowed and text.lower() == "none":
        return None
    if bool in allowed:
        return {"true": True, "false": False}.get(text.lower(), text)
    if Path in allowed:
        return Path(text)
    number = float if float in allowed else int if int in allowed else None
    if number is not None:
        try:
            return number(text)
        except ValueError:
            return text
    return text


def _said(value: object) -> str:
    return f"{str(value)[:40]!r}" if isinstance(value, str) else str(value)[:40]


def _plain(number: float) -> str:
    return f"{number:,.0f}" if number >= MOST else f"{number:g}"
