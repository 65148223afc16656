"""The words of a command line, checked before they are parsed: each mistake is one sentence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.options import Option, options_of
from skyline_viz.system.nearest import meant, nearest
from skyline_viz.system.telling import WORDS


def checked(program: str, commands: Mapping[str, object], words: Sequence[str]) -> list[str]:
    """The words after a program's name, in an order in which none is taken for another one's.

    Several values of an option end where the next option begins. Where a command then lacks what
    stands alone, the last of them is that: ``evaluate --predictions mine hills``.

    Args:
        program: The program's name.
        commands: All commands by name, each with its defaults.
        words: The words.

    Raises:
        UsageError: There is no such command or option, or a value is missing or makes no sense.
    """
    if not words:
        raise UsageError(f"which command? There are {', '.join(commands)}; see {program} --help.")
    name, *rest = words
    if name not in commands:
        raise UsageError(f"there is no command {name}; {meant(name, commands, 'there are')}")
    called = f"{program} {name}"
    options = options_of(commands[name])
    found = _read(called, {flag: one for one in options for flag in one.flags}, rest)
    alone = [one for one in options if one.positional]
    if not any(one.many for one in alone):
        if len(found.alone) == len(alone) - 1 and len(found.swallowed) > 1:
            rest = rest[: found.at] + rest[found.at + 1 :]
            return [name, found.swallowed[-1], *rest]
        for missing in alone[len(found.alone) :]:
            raise UsageError(f"which {missing.value}? See {called} --help.")
        if extra := found.alone[len(alone) :]:
            takes = "one " + " and one ".join(one.value for one in alone) if alone else "options"
            raise UsageError(f"{called} takes {takes}, and there is also {', '.join(extra)}.")
    for one in options:
        if one.required and not one.positional and one.flags[0] not in found.named:
            raise UsageError(f"{called} needs {one.flags[0]} {one.value}.")
    return [name, *rest]


@dataclass
class _Read:
    """What the words after a command are."""

    alone: list[str] = field(default_factory=list)
    """Those that stand alone."""

    named: set[str] = field(default_factory=set)
    """Options."""

    swallowed: list[str] = field(default_factory=list)
    """Values of the last option that takes several."""

    at: int = 0
    """Where the last of these values stands."""


def _read(called: str, known: Mapping[str, Option], words: Sequence[str]) -> _Read:
    """Tell options from their values, and from words that stand alone; check them one by one."""
    found = _Read()
    at = 0
    while at < len(words):
        word, equals, value = words[at].partition("=")
        at += 1
        if not _is_option(word):
            found.alone.append(words[at - 1])
            continue
        flag = word.replace("_", "-")
        option = known.get(flag)
        if option is None:
            near = _meant(flag, [*known, *WORDS, "--help"])
            better = f"did you mean {near}?" if near else f"see {called} --help-all."
            raise UsageError(f"{called} has no option {word}; {better}")
        found.named.add(flag)
        if option.kind is bool:
            continue
        values = [value] if equals else []
        while not equals and at < len(words) and not _is_option(words[at]):
            values.append(words[at])
            at += 1
            if not option.many:
                break
        if not values:
            raise UsageError(f"{flag} is named without its {option.value}.")
        if option.many and not equals:
            found.swallowed, found.at = values, at - 1
        for one in values:
            _check(flag, option, one)
    return found


def _meant(flag: str, known: Sequence[str]) -> str:
    """What an unknown option was to be, whether all of its name was said or its end; or nothing."""
    ends = {one.removeprefix("--").rpartition(".")[2]: one for one in known}
    whole = {one.removeprefix("--"): one for one in known}
    names = {**ends, **whole}
    near = nearest(flag.lstrip("-"), names)
    return names[near] if near else ""


def _is_option(word: str) -> bool:
    """Whether a word names an option, and is neither a number below 0 nor a lone hyphen."""
    return len(word) > 1 and word[0] == "-" and not word[1].isdecimal() and word[1] != "."


def _check(flag: str, option: Option, value: str) -> None:
    """Refuse a value that an option cannot have."""
    if option.choices:
        if value not in option.choices:
            raise UsageError(
                f"{flag} cannot be {value}; {meant(value, option.choices, 'it is one of')}"
            )
    elif option.kind in (int, float):
        try:
            option.kind(value)
        except ValueError:
            raise UsageError(f"{flag} is {option.takes}, not {value}.") from None
