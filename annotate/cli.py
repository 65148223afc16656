"""The command ``skyline-annotate``: which commands there are."""

from collections.abc import Sequence
from typing import Any

import tyro

from annotate.commands.agreement import Agreement
from annotate.commands.consensus import Consensus
from annotate.commands.open import Open
from annotate.commands.options import PROGRAM, refuse_stored
from annotate.commands.repairs import Repair
from annotate.commands.status import Status
from annotate.commands.transfer import Backup, Export, Import
from skyline_viz import __version__
from skyline_viz.command_line.methods import Methods, described, spelt_out
from skyline_viz.command_line.program import Command, parsed, run_program

_ABOUT = f"""Label mountain skylines: the detector proposes, a few clicks correct, nothing is lost.

Version {__version__} (--version). Each command explains itself: skyline-annotate open --help
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command line and return its exit status.

    Args:
        arguments: The words after the program's name; those of this process unless given.
    """
    return run_program(PROGRAM, parse, arguments)


def parse(arguments: list[str]) -> Command:
    """Turn a command line into a command.

    Raises:
        SystemExit: After help was printed, or what is wrong with the words.
        ValueError: A setting has a value that it refuses.
    """
    words = spelt_out(arguments, masks=("import",))
    command = parsed(PROGRAM, _ABOUT, commands(described(words)), words)
    refuse_stored(getattr(command, "folder", None))
    return command


def commands(methods: Methods) -> dict[str, Command]:
    """All commands by name, with what a command line describes as defaults."""
    missing: Any = tyro.MISSING
    return {
        "open": Open(missing, methods=methods),
        "export": Export(missing),
        "import": Import(missing, missing),
        "status": Status(missing),
        "agreement": Agreement(missing),
        "consensus": Consensus(missing),
        "backup": Backup(missing),
        "repair": Repair(missing),
    }
