"""The command ``skyline-viz``: which commands there are, and how they end.

Whatever is wrong with the input ends in one plain sentence on stderr and a status from
`skyline_viz.commands.messages`, never in a traceback.
"""

import contextlib
import io
import os
import sys
import traceback
from collections.abc import Sequence
from typing import Annotated, Any, Protocol, Union

import tyro

from skyline_viz import __version__
from skyline_viz.batch import BatchError, sentence
from skyline_viz.commands.demo import Demo
from skyline_viz.commands.detect import Detect
from skyline_viz.commands.evaluate import Evaluate
from skyline_viz.commands.gallery import GalleryCommand
from skyline_viz.commands.inspect import Inspect
from skyline_viz.commands.messages import (
    BROKEN_PIPE,
    GOOD,
    INTERRUPTED,
    SOME_FAILED,
    USAGE,
    say,
)
from skyline_viz.commands.render import Render
from skyline_viz.commands.settings import Preset, asked_preset, config_of
from skyline_viz.commands.train import Train
from skyline_viz.config import TrainingConfig

_ABOUT = f"""Find mountain skylines in photos, train the detector, and measure it.

Version {__version__} (--version). Each command explains itself: skyline-viz detect --help
"""


class Command(Protocol):
    """Parsed options of a command."""

    def run(self) -> int:
        """Do it; return the exit status."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command line and return its exit status.

    Args:
        arguments: The words after the program's name; those of this process unless given.
    """
    try:
        status = _run(sys.argv[1:] if arguments is None else list(arguments))
        sys.stdout.flush()
    except KeyboardInterrupt:
        say("interrupted; every file that was written is whole.")
        return INTERRUPTED
    except BrokenPipeError:  # somebody read as much as they wanted
        _silence_stdout()
        return BROKEN_PIPE
    except Exception as error:
        if (known := _status_of(error)) is None:
            raise
        text = sentence(error)
        say(text if text.endswith((".", "?", "!")) else f"{text}.")
        return known
    return status


def _run(arguments: list[str]) -> int:
    if arguments == ["--version"]:
        print(f"skyline-viz {__version__}")
        return GOOD
    try:
        command = parse(arguments)
    except SystemExit as leaving:  # help, or a command line that makes no sense
        return leaving.code if isinstance(leaving.code, int) else USAGE
    return command.run()


def parse(arguments: list[str]) -> Command:
    """Turn a command line into a command.

    Raises:
        SystemExit: After help was printed, or what is wrong with the words.
        ValueError: A setting has a value that it refuses.
    """
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said):
            command: Command = tyro.cli(
                _commands(asked_preset(arguments)),
                prog="skyline-viz",
                description=_ABOUT,
                args=arguments,
            )
    except SystemExit as leaving:
        if refusal := _refusal_behind(leaving):
            raise refusal from None
        sys.stderr.write(said.getvalue())
        raise
    return command


def _commands(preset: Preset) -> Any:  # noqa: ANN401  # a union that is made at run time
    """All commands as one type for tyro, with the preset's settings as defaults."""
    config = config_of(preset)
    missing: Any = tyro.MISSING
    defaults = {
        "detect": Detect(missing, config=config),
        "inspect": Inspect(missing, config=config),
        "gallery": GalleryCommand(config=config),
        "train": Train(missing, missing, training=TrainingConfig(detector=config)),
        "evaluate": Evaluate(missing, config=config),
        "render": Render(),
        "demo": Demo(),
    }
    kinds = tuple(
        Annotated[type(default), tyro.conf.subcommand(name, default=default)]
        for name, default in defaults.items()
    )
    return Union[kinds]  # noqa: UP007  # the members are known at run time only


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
    from skyline_viz.photo import PhotoError  # noqa: PLC0415  # not needed for help

    if isinstance(error, ValueError | PhotoError):
        return USAGE
    return SOME_FAILED if isinstance(error, OSError | MemoryError | BatchError) else None


def _silence_stdout() -> None:
    """Let the interpreter flush into nothing when it ends, instead of complaining."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
