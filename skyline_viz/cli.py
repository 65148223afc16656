"""The command ``skyline-viz``: which commands there are."""

from collections.abc import Sequence
from typing import Any

import tyro

from skyline_viz import __version__
from skyline_viz.command_line.methods import Methods, described, spelt_out, trained_from
from skyline_viz.command_line.program import Command, parsed, run_program
from skyline_viz.commands.demo import Demo
from skyline_viz.commands.detect import Detect
from skyline_viz.commands.diagnose import Diagnose
from skyline_viz.commands.evaluate import Evaluate
from skyline_viz.commands.gallery import GalleryCommand
from skyline_viz.commands.inspect import Inspect
from skyline_viz.commands.join import Join
from skyline_viz.commands.render import Render
from skyline_viz.commands.tables import Tables
from skyline_viz.commands.train import Train
from skyline_viz.config import TrainingConfig

_ABOUT = f"""Find mountain skylines in photos, train the detector, and measure it.

Version {__version__} (--version). Each command explains itself: skyline-viz detect --help
"""


_READS_TRUTHS = ("inspect", "gallery", "train", "evaluate", "tables", "diagnose")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command line and return its exit status.

    Args:
        arguments: The words after the program's name; those of this process unless given.
    """
    return run_program("skyline-viz", parse, arguments)


def parse(arguments: list[str]) -> Command:
    """Turn a command line into a command.

    Raises:
        SystemExit: After help was printed, or what is wrong with the words.
        ValueError: A setting has a value that it refuses.
    """
    words = spelt_out(arguments, masks=_READS_TRUTHS)
    methods = described(words)
    training = methods.config
    if words[:1] == ["train"]:
        training = trained_from(words, methods)
    return parsed("skyline-viz", _ABOUT, commands(methods, TrainingConfig.of(training)), words)


def commands(methods: Methods, training: TrainingConfig) -> dict[str, Command]:
    """All commands by name, with what a command line describes as defaults."""
    missing: Any = tyro.MISSING
    return {
        "detect": Detect(missing, methods=methods),
        "inspect": Inspect(missing, methods=methods),
        "gallery": GalleryCommand(methods=methods),
        "join": Join(missing, missing),
        "train": Train(missing, missing, training=training),
        "evaluate": Evaluate(missing, methods=methods),
        "tables": Tables(missing, methods=methods),
        "diagnose": Diagnose(missing, methods=methods),
        "render": Render(),
        "demo": Demo(methods=methods),
    }
