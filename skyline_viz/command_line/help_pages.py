"""Help: what a program's commands do, and the options of one, in groups, with examples.

The many single settings are left to ``--help-all``, which the short page names.
"""

import inspect
import shutil
import textwrap
from collections.abc import Iterator, Mapping, Sequence

from skyline_viz.command_line.options import Option, options_of

SHORT, LONG = ("-h", "--help"), "--help-all"
"""The words that ask for the page of a command, and for that with all settings."""

_WIDEST = 100
_NAMES = 24
_GROUPS = {
    "Photos": ("sky", "terrain", "truth", "max-megapixels"),
    "Detector": ("method", "network", "sky-class", "bank", "sky-model", "preset", "config"),
    "Options": (),
    "Output": (
        "out", "mask", "overlay", "overlay-width", "json", "report", "save", "screenshot",
        "screenshot-size", "serve", "connect", "headless",
    ),
    "Work": ("workers", "quiet", "verbose", "help", "help-all"),
}  # fmt: skip
"""Options that commands share, by where they stand; those of a command's own are in `Options`."""

_HELP = (
    Option("quiet", "Print results and what went wrong, and nothing on the way.", ""),
    Option("verbose", "Also tell of each photo as it is done, and the time that all took.", ""),
    Option("help", "This page; -h for short.", ""),
    Option("help-all", "This page with all single settings.", ""),
)


def asks_for_help(words: Sequence[str]) -> bool:
    """Whether a command line asks for help, wherever it says so."""
    return any(word in (*SHORT, LONG) for word in words)


def page(program: str, about: str, commands: Mapping[str, object], words: Sequence[str]) -> str:
    """The page that a command line asks for.

    Args:
        program: The program's name.
        about: What it is for.
        commands: All commands by name, each with its defaults.
        words: The words after the program's name.
    """
    if words[0] in commands:
        name = words[0]
        return command_page(f"{program} {name}", commands[name], everything=LONG in words)
    rows = [(name, _summary(command)) for name, command in commands.items()]
    lines = [f"usage: {program} COMMAND [OPTIONS]", "", *about.strip().splitlines(), "", "Commands"]
    return "\n".join([*lines, *_table(rows)])


def command_page(called: str, command: object, *, everything: bool) -> str:
    """What a command does, its options in groups, and examples.

    Args:
        called: The names of program and command.
        command: The command with its defaults.
        everything: Whether to explain each setting.
    """
    options = options_of(command)
    stand_alone = [_value(one) for one in options if one.positional]
    lines = [f"usage: {' '.join([called, *stand_alone])} [OPTIONS]", ""]
    lines += _wrapped([_summary(command)], "")
    settings = [one for one in options if one.is_setting]
    offered = [*options, *(_HELP if settings else _HELP[:-1])]
    for title in _GROUPS:
        found = [one for one in offered if _group(one) == title]
        if found:
            what = {one.led_by for one in found if title == "Detector" and one.led_by}
            lines += ["", title, *_wrapped(sorted(what), "  "), *_options(found)]
    if everything:
        for led_by in dict.fromkeys(one.led_by for one in settings):
            lines += ["", "Settings", *_wrapped([led_by], "  ")]
            lines += _options([one for one in settings if one.led_by == led_by])
    elif settings:
        some = ", ".join(one.flags[0] for one in settings[:2])
        more = f"{some} and {len(settings) - 2} more: {called} {LONG}"
        lines += ["", "Settings", *_wrapped([more], "  ")]
    if examples := examples_of(command):
        lines += ["", "Examples", *(f"  {one}" for one in examples)]
    return "\n".join(lines)


def examples_of(command: object) -> list[str]:
    """Command lines that stand in the docstring of a command, below "Examples:"."""
    _, _, examples = (inspect.getdoc(type(command)) or "").partition("Examples:\n")
    return [line.strip() for line in examples.splitlines() if line.strip()]


def _summary(command: object) -> str:
    """What a command does, in a sentence."""
    return " ".join((inspect.getdoc(type(command)) or "").partition("\n\n")[0].split())


def _group(option: Option) -> str:
    """The title of the options that an option stands with; empty for single settings."""
    if option.is_setting:
        return ""
    if option.positional:
        return "Photos"
    return next((title for title, names in _GROUPS.items() if option.name in names), "Options")


def _value(option: Option) -> str:
    several = "..." if option.many else ""
    if option.positional and not option.required:
        return f"[{option.value}{several}]"
    return option.value + several


def _options(options: Sequence[Option]) -> Iterator[str]:
    """Lines about options."""
    rows = []
    for one in options:
        about = one.about
        if one.required:
            about += " (required)"
        elif one.usual and not one.positional:
            about += f" (default: {one.usual})"
        named = ", ".join(one.flags)
        rows.append((" ".join(filter(None, [named, _value(one)])), about))
    return _table(rows)


def _table(rows: Sequence[tuple[str, str]]) -> Iterator[str]:
    """Lines of two columns; a long word on the left has a line of its own."""
    for left, right in rows:
        first, *more = _wrapped([right], " " * (_NAMES + 2)) or [""]
        if len(left) > _NAMES - 2:
            yield f"  {left}"
            yield first
        else:
            yield f"  {left:<{_NAMES}}{first[_NAMES + 2 :]}"
        yield from more


def _wrapped(texts: Sequence[str], indent: str) -> list[str]:
    """Lines that fit into the terminal."""
    width = max(min(shutil.get_terminal_size().columns, _WIDEST), 60)
    return [
        line
        for text in texts
        for line in textwrap.wrap(
            text, width, initial_indent=indent, subsequent_indent=indent, break_on_hyphens=False
        )
    ]
