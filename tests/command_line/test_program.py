"""What our programs have in common: every ending is a status and, where needed, a sentence."""

import signal
from dataclasses import dataclass

import pytest

from skyline_viz import __version__
from skyline_viz.command_line.messages import (
    BROKEN_PIPE,
    INTERRUPTED,
    SOME_FAILED,
    USAGE,
    UsageError,
)
from skyline_viz.command_line.program import parsed, run_program
from skyline_viz.photo import PhotoError
from skyline_viz.system.endings import AskedToEnd
from skyline_viz.system.notes import note
from skyline_viz.system.telling import Telling, telling


@dataclass(frozen=True)
class Jump:
    """Jump over something."""

    height: float = 1.0
    """How high."""

    def __post_init__(self):
        if self.height < 0:
            raise ValueError("a height is 0 or more")

    def run(self):
        return 7


@dataclass(frozen=True)
class Fall:
    """Fall."""

    def run(self):
        raise RuntimeError("a bug")


def parse(arguments):
    return parsed("prog", "Moves.", {"jump": Jump(), "fall": Fall()}, arguments)


def doing(what):
    """A parser of a command that does this."""

    class Command:
        def run(self):
            if isinstance(what, BaseException):
                raise what
            return what()

    return lambda arguments: Command()


def test_a_command_is_parsed_and_run():
    assert run_program("prog", parse, ["jump", "--height", "2"]) == 7


def test_the_version_needs_no_parsing(capsys):
    assert run_program("prog", doing(AssertionError), ["--version"]) == 0
    assert capsys.readouterr().out == f"prog {__version__}\n"


@pytest.mark.parametrize(
    "words",
    [
        ["hop"],
        ["jump", "--height", "far"],
        [],
        ["jump", "--quiet", "--verbose"],
        ["-v"],
        ["hop", "--help"],
    ],
)
def test_words_that_make_no_sense_are_one_sentence(words, capsys):
    assert run_program("prog", parse, words) == USAGE
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("prog: ")
    assert said.err.count("\n") == 1


@pytest.mark.parametrize("words", [["-h"], ["--help"], ["jump", "--help"], ["jump", "--help-all"]])
def test_help_is_no_error(words, capsys):
    assert run_program("prog", parse, words) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert said.out.startswith("usage: prog")


def test_completions_for_a_shell_are_written(capsys):
    assert run_program("prog", parse, ["--tyro-print-completion", "bash"]) == 0
    assert "--height" in capsys.readouterr().out


def test_verbose_says_how_long_it_took(capsys):
    assert run_program("prog", parse, ["jump", "--verbose"]) == 7
    assert capsys.readouterr().err.startswith(f"prog: version {__version__}, done in ")


def test_quiet_ends_with_the_program():
    def work():
        return int(telling())

    assert run_program("prog", doing(work), ["--quiet"]) == Telling.RESULTS
    assert telling() == Telling.USUAL


def test_a_value_that_is_refused_is_one_sentence(capsys):
    assert run_program("prog", parse, ["jump", "--height", "-1"]) == USAGE
    assert capsys.readouterr().err == "prog: a height is 0 or more.\n"


@pytest.mark.parametrize(
    ("error", "status", "said"),
    [
        (UsageError("which photos?"), USAGE, "prog: which photos?\n"),
        (PhotoError("a.jpg is empty (0 bytes)."), USAGE, "prog: a.jpg is empty (0 bytes).\n"),
        (
            OSError(28, "No space left on device"),
            SOME_FAILED,
            "prog: the output cannot be written: no space left on device.\n",
        ),
        (
            KeyboardInterrupt(),
            INTERRUPTED,
            "prog: interrupted; every file that was written is whole.\n",
        ),
        (
            AskedToEnd(signal.SIGTERM),
            143,
            "prog: ended by SIGTERM; every file that was written is whole.\n",
        ),
    ],
)
def test_how_it_ends_is_said(error, status, said, capsys, monkeypatch):
    monkeypatch.setattr("skyline_viz.command_line.program._silence_stdout", lambda: None)
    assert run_program("prog", doing(error), []) == status
    assert capsys.readouterr().err == said


def test_nobody_reads_any_more_and_nothing_is_said(capsys, monkeypatch):
    silenced = []
    monkeypatch.setattr(
        "skyline_viz.command_line.program._silence_stdout", lambda: silenced.append(True)
    )
    assert run_program("prog", doing(BrokenPipeError()), []) == BROKEN_PIPE
    assert silenced == [True]
    assert capsys.readouterr().err == ""


def test_a_fault_of_the_program_is_not_hidden():
    with pytest.raises(RuntimeError, match="a bug"):
        run_program("prog", parse, ["fall"])


def test_notes_are_said_once_by_the_program(capsys):
    def work():
        note("a.png is odd.")
        note("a.png is odd.")
        return 0

    assert run_program("prog", doing(work), []) == 0
    assert capsys.readouterr().err == "prog: a.png is odd.\n"


def test_words_that_a_terminal_would_obey_are_shown_without(capsys):
    assert run_program("prog", parse, ["jump", "--\x1b[2J"]) == USAGE
    assert "\x1b[2J" not in capsys.readouterr().err
