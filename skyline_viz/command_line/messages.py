"""What commands print and say on stderr, and with which status they end.

Everything that commands write to a terminal passes through here, names of files with it: see
`skyline_viz.names`.
"""

import sys
from collections.abc import Sequence
from typing import TextIO

from skyline_viz.running.batch import Failure
from skyline_viz.storage.copy_names import by_address
from skyline_viz.system.names import printable
from skyline_viz.system.telling import Telling, telling

GOOD, SOME_FAILED, USAGE, INTERRUPTED, BROKEN_PIPE = 0, 1, 2, 130, 141
"""Exit status: all good, photos failed or the work broke off, bad input, Ctrl-C, ``| head``. After
SIGTERM it is 143 and after SIGHUP 129."""


class UsageError(ValueError):
    """What was asked for cannot be done; the message is one sentence that says why."""


def tell(*lines: str) -> None:
    """Print lines on stdout, without whatever a terminal would obey."""
    for line in lines:
        _write(printable(line), sys.stdout)


def tell_done(*lines: str) -> None:
    """Print what was done on the way to results, unless ``--quiet`` asks for these alone."""
    if telling() > Telling.RESULTS:
        tell(*lines)


def tell_row(*cells: str) -> None:
    """Print the cells of a table for programs, separated by tabs."""
    _write("\t".join(map(printable, cells)), sys.stdout)


def tell_drawn(*renderables: object, width: int | None = None) -> None:
    """Print what rich draws, such as tables; names in it are made by `names.cell`."""
    from rich.console import Console  # not needed for help

    console = Console(highlight=False, markup=False, emoji=False, width=width)
    with console.capture() as captured:  # printed by rich, it would end the program on | head
        for one in renderables:
            console.print(one)
    _write(captured.get().rstrip("\n"), sys.stdout)


def say(message: str, program: str = "skyline-viz") -> None:
    """Print one line on stderr, after the name of the program."""
    _write(f"{program}: {printable(message)}", sys.stderr)


_last: list[tuple[str, str]] = []


def say_last(message: str, program: str = "skyline-viz") -> None:
    """Say something when the command has ended, where nobody overlooks it."""
    _last.append((message, program))


def say_what_is_left() -> None:
    """Say what `say_last` has kept."""
    while _last:
        say(*_last.pop(0))


def _write(line: str, stream: TextIO) -> None:
    """Print a line, with escapes for what the stream's encoding has not.

    Copies of what lies in a storage are called by their addresses.
    """
    encoding = stream.encoding or "utf-8"
    print(
        by_address(line).encode(encoding, "backslashreplace").decode(encoding),
        file=stream,
        flush=True,
    )


def counted(count: int, noun: str) -> str:
    """A number and a noun.

    >>> counted(1, "photo"), counted(2, "photo")
    ('1 photo', '2 photos')
    """
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def status_after(failures: Sequence[Failure]) -> int:
    """List the photos that failed, and return the exit status."""
    if not failures:
        return GOOD
    if len(failures) > 1:
        say(f"{len(failures)} photos failed:")
    for failure in failures:
        say(str(failure))
    return SOME_FAILED
