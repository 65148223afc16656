"""What our programs have in common: commands are parsed into dataclasses, errors are sentences.

Whatever is wrong with the input ends in one plain sentence on stderr and a status from
`skyline_viz.commands.messages`, never in a traceback.
"""

import contextlib
import io
import os
import sys
import traceback
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from time import perf_counter
from types import ModuleType
from typing import Annotated, Any, Protocol, Union

import tyro

from skyline_viz import __version__
from skyline_viz.command_line.help_pages import asks_for_help, page
from skyline_viz.command_line.local import refuse_addresses
from skyline_viz.command_line.messages import (
    BROKEN_PIPE,
    GOOD,
    INTERRUPTED,
    SOME_FAILED,
    USAGE,
    say,
    say_what_is_left,
    tell,
)
from skyline_viz.command_line.run_record import remember
from skyline_viz.command_line.sizes import limit
from skyline_viz.command_line.words import checked
from skyline_viz.files import FULL
from skyline_viz.running.batch import BatchError, sentence
from skyline_viz.storage.copy_names import forget
from skyline_viz.system.endings import AskedToEnd, asked_by_signals
from skyline_viz.system.memory import end_quickly, keep_freed, loading
from skyline_viz.system.names import printable
from skyline_viz.system.notes import heard_by, once
from skyline_viz.system.stand_ins import without
from skyline_viz.system.telling import Telling, asked_to_tell, told

_QUIET = "warn,re_log_encoding=off,re_sdk=off"
"""Rerun tells in its own way of recordings that cannot be written; `new_recording` does in ours."""


class Command(Protocol):
    """Parsed options of a command."""

    def run(self) -> int:
        """Do it; return the exit status."""


def run_program(
    program: str, parse: Callable[[list[str]], Command], arguments: Sequence[str] | None
) -> int:
    """Run a command line and return its exit status.

    Args:
        program: The program's name.
        parse: Turns the words after the name into a command.
        arguments: These words; those of this process unless given.
    """
    os.environ.setdefault("RUST_LOG", _QUIET)
    keep_freed()
    end_quickly()
    words = sys.argv[1:] if arguments is None else list(arguments)
    remember(program, words)
    began = perf_counter()
    try:
        much, words = asked_to_tell(words)
        with told(much), asked_by_signals(), heard_by(once(lambda note: say(note, program))):
            status = _run(program, parse, words)
            sys.stdout.flush()
        if much == Telling.EVERYTHING:
            say(f"version {__version__}, done in {perf_counter() - began:.1f} s.", program)
    except AskedToEnd as asked:
        with suppress(OSError):  # the terminal may be gone
            say(f"ended by {asked}; every file that was written is whole.", program)
        return 128 + asked.number
    except KeyboardInterrupt:
        say("interrupted; every file that was written is whole.", program)
        return INTERRUPTED
    except BrokenPipeError:  # somebody read as much as they wanted
        _silence_stdout()
        return BROKEN_PIPE
    except Exception as error:
        if (known := _status_of(error)) is None:
            raise
        text = sentence(error)
        if isinstance(error, OSError) and error.errno in FULL and not error.filename:
            text = f"the output cannot be written: {text}"  # whoever writes files names them
            _silence_stdout()
        say(text if text.endswith((".", "?", "!")) else f"{text}.", program)
        return known
    finally:
        say_what_is_left()
    return status


def parsed(
    program: str, about: str, commands: Mapping[str, Any], arguments: Sequence[str]
) -> Command:
    """Turn a command line into a command.

    Args:
        program: The program's name.
        about: What it is for, for its help.
        commands: All commands by name, each with its defaults.
        arguments: The words after the program's name.

    Raises:
        SystemExit: After help was printed, or what is wrong with the words.
        ValueError: The words name what there is not, or a setting has a value that it refuses.
    """
    words = list(arguments)
    if asks_for_help(words) and (words[0] in commands or words[0].startswith("-")):
        tell(*page(program, about, commands, words).splitlines())
        raise SystemExit(GOOD)
    if not words[:1] or not words[0].startswith("--tyro-"):  # which write completions for a shell
        words = checked(program, commands, words)
    kinds = tuple(
        Annotated[type(default), tyro.conf.subcommand(name, default=default)]
        for name, default in commands.items()
    )
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said), without("typeguard", _trusting()):
            every: Any = Union[kinds]  # noqa: UP007  # the members are known at run time only
            command: Command = tyro.cli(every, prog=program, description=about, args=words)
    except SystemExit as leaving:
        if refusal := _refusal_behind(leaving):
            raise refusal from None
        sys.stderr.writelines(f"{printable(line)}\n" for line in said.getvalue().splitlines())
        raise
    return command


def _run(program: str, parse: Callable[[list[str]], Command], arguments: list[str]) -> int:
    forget()
    if arguments == ["--version"]:
        tell(f"{program} {__version__}")
        return GOOD
    try:
        with loading():
            command = parse(arguments)
    except SystemExit as leaving:  # help, or a command line that makes no sense
        code = GOOD if leaving.code is None else leaving.code
        return code if isinstance(code, int) else USAGE
    if (megapixels := getattr(command, "max_megapixels", None)) is not None:
        limit(megapixels)
    refuse_addresses(command)
    return command.run()


def _trusting() -> ModuleType:
    """What tyro asks whether our defaults are of their types: they are, a test asks typeguard.

    To import that takes as long as two detections.
    """
    trusting: Any = ModuleType("typeguard")
    trusting.check_type = lambda value, _: value
    trusting.TypeCheckError = TypeError
    return trusting  # type: ignore[no-any-return]


def _refusal_behind(error: BaseException) -> ValueError | None:
    """The sentence with which one of our dataclasses refused a value, where tyro stopped for it."""
    cause: BaseException | None = error
    while cause is not None:
        frames = traceback.extract_tb(cause.__traceback__)
        if isinstance(cause, ValueError) and any(f.name == "__post_init__" for f in frames):
            return cause
        cause = cause.__cause__ or cause.__context__
    return None


def _status_of(error: Exception) -> int | None:
    """Exit status for an error that has a plain sentence; None for a fault of this program."""
    from skyline_viz.photo import PhotoError  # not needed for help

    if isinstance(error, ValueError | PhotoError):
        return USAGE
    return SOME_FAILED if isinstance(error, OSError | MemoryError | BatchError) else None


def _silence_stdout() -> None:
    """Let the interpreter flush into nothing when it ends, instead of complaining."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
