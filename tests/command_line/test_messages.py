"""What commands print: whole, on the right stream, and without what a terminal would obey."""

import pytest
from rich.table import Table

from skyline_viz.command_line import messages
from skyline_viz.command_line.messages import (
    GOOD,
    SOME_FAILED,
    say,
    say_last,
    say_what_is_left,
    status_after,
    tell,
    tell_drawn,
    tell_row,
)
from skyline_viz.running.batch import Failure


def test_results_go_to_stdout_and_what_is_said_to_stderr(capsys):
    tell("a", "b")
    tell_row("c", "d\x1b[2J")
    say("beware.", program="prog")
    said = capsys.readouterr()
    assert said.out == "a\nb\nc\td\\x1b[2J\n"
    assert said.err == "prog: beware.\n"


def test_what_is_said_last_waits_and_is_said_once(capsys):
    say_last("at the end.")
    say("now.")
    assert capsys.readouterr().err == "skyline-viz: now.\n"
    say_what_is_left()
    say_what_is_left()
    assert capsys.readouterr().err == "skyline-viz: at the end.\n"


def test_a_drawn_table_is_printed_without_markup(capsys):
    table = Table("name")
    table.add_row("[bold]a[/bold] :smile:")
    tell_drawn(table, width=60)
    assert "[bold]a[/bold] :smile:" in capsys.readouterr().out


@pytest.mark.parametrize(("count", "lines"), [(0, 0), (1, 1), (3, 4)])
def test_failures_are_listed_after_their_number(count, lines, capsys):
    failures = [Failure(f"p{number}", "it is damaged.") for number in range(count)]
    assert status_after(failures) == (SOME_FAILED if count else GOOD)
    said = capsys.readouterr().err.splitlines()
    assert len(said) == lines
    assert (said[:1] == [f"skyline-viz: {count} photos failed:"]) == (count > 1)
    assert sum("it is damaged." in line for line in said) == count


def test_each_status_is_another():
    names = ("GOOD", "SOME_FAILED", "USAGE", "INTERRUPTED", "BROKEN_PIPE")
    assert len({getattr(messages, name) for name in names}) == len(names)
