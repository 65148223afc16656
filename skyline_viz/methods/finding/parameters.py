"""The parameters of somebody's class: their kinds, and what an object was made with."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from pathlib import Path

from skyline_viz.system.nearest import meant
from skyline_viz.system.settings import SettingError, check_kind, from_document, plain_number

MODEL = "model"
"""The parameter that takes what has been learned."""

UNTOLD = object
"""Kind of a parameter of which neither annotation nor default says one."""

_NONE = inspect.Parameter.empty


def kinds_of(kind: type) -> dict[str, object]:
    """Type of each parameter of a class that is a setting; of its default if untyped."""
    found: dict[str, object] = {}
    for name, one in (_parameters(kind) or {}).items():
        if one.kind not in (one.POSITIONAL_OR_KEYWORD, one.KEYWORD_ONLY):
            continue
        usual = UNTOLD if one.default in (_NONE, None) else type(one.default)
        found[name] = usual if one.annotation is _NONE else one.annotation
    return found


def required(kind: type) -> list[str]:
    """Parameters of a class that have no default."""
    parameters = _parameters(kind) or {}
    return [name for name in kinds_of(kind) if parameters[name].default is _NONE]


def checked(values: Mapping[str, object], kinds: Mapping[str, object]) -> dict[str, object]:
    """Values of settings, if they are of the kinds that a class takes; it checks their range.

    Raises:
        SettingError: One is unknown, or of another kind.
    """
    found: dict[str, object] = {}
    for name, value in values.items():
        if name not in kinds:
            raise SettingError(f"there is no setting {name}; {meant(name, kinds, 'there are')}")
        found[name] = from_document(plain_number(value), kinds[name])
        if kinds[name] is not UNTOLD or not _is_plain(found[name]):
            check_kind(name, found[name], kinds[name], -float("inf"), float("inf"))
    return found


def made_with(inner: object) -> dict[str, object] | None:
    """The settings of an object, read from its attributes that are called like parameters.

    Returns:
        Those that are not the default ones. None where they cannot be told: an attribute is
        missing or no plain value, or the class takes parameters that have no name.
    """
    parameters, kinds = _parameters(type(inner)), kinds_of(type(inner))
    if parameters is None or len(kinds) != len(parameters):
        return None
    found: dict[str, object] = {}
    for name, one in parameters.items():
        value = plain_number(getattr(inner, name, _NONE))
        if not _is_plain(value):
            return None
        if _is_plain(one.default) and value == one.default:
            continue
        try:
            found[name] = checked({name: value}, kinds)[name]
        except SettingError:
            return None
        if isinstance(value, Path) and from_document(str(value), kinds[name]) != value:
            return None  # a file would give it back as text
    return found


def _is_plain(value: object) -> bool:
    """Whether a value says all about itself, in a name and in a file."""
    if isinstance(value, tuple):
        return all(map(_is_plain, value))
    return value is None or isinstance(value, bool | int | float | str | Path)


def _parameters(kind: type) -> dict[str, inspect.Parameter] | None:
    """All parameters but that of what is learned and a label; None where there is no telling."""
    try:
        every = inspect.signature(kind, eval_str=True).parameters.values()
    except (TypeError, ValueError, NameError):
        return None
    return {one.name: one for one in every if one.name not in (MODEL, "label")}
