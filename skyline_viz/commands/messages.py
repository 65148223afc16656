"""What commands say on stderr, and with which status they end."""

import sys
from collections.abc import Sequence

from skyline_viz.batch import Failure

GOOD, SOME_FAILED, USAGE, INTERRUPTED, BROKEN_PIPE = 0, 1, 2, 130, 141
"""Exit status: all good, photos failed or the work broke off, bad input, Ctrl-C, ``| head``. After
SIGTERM it is 143 and after SIGHUP 129."""


class UsageError(ValueError):
    """What was asked for cannot be done; the message is one sentence that says why."""


def say(message: str, program: str = "skyline-viz") -> None:
    """Print one line on stderr, after the name of the program."""
    print(f"{program}: {message}", file=sys.stderr)


def listed(names: Sequence[str], most: int = 8) -> str:
    """Names in a sentence.

    >>> listed(["a", "b", "c"], most=2)
    'a, b and 1 more'
    """
    more = len(names) - most
    return ", ".join(names[:most]) + (f" and {more} more" if more > 0 else "")


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
