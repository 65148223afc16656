"""The options of a command, as its dataclass tells them."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

import pytest
import tyro

import annotate.cli
import skyline_viz.cli
from skyline_viz.command_line.methods import described
from skyline_viz.command_line.options import Option, options_of
from skyline_viz.command_line.settings import OptionalFolder, Switch
from skyline_viz.config import TrainingConfig


@dataclass(frozen=True)
class Rope:
    """A rope."""

    length: float = 60.0
    """How long, in ``m``, see `Knot`."""

    dry: bool = True
    """Whether it is dry."""


@dataclass(frozen=True)
class Climb:
    """Climb."""

    peaks: Annotated[tuple[Path, ...], tyro.conf.Positional, tyro.conf.arg(metavar="PEAK")]
    """Where
    to."""

    style: Literal["lead", "solo"] | None = None
    """How."""

    partners: tuple[str, ...] = ()
    """With whom."""

    camp: OptionalFolder = None
    """Where to sleep."""

    fast: Switch = False
    """Without a pause."""

    secret: tyro.conf.Suppress[int] = 3
    """Nobody's business."""

    rope: Rope = field(default_factory=Rope)
    """What holds."""


def told(name: str) -> Option:
    return next(one for one in options_of(Climb(tyro.MISSING)) if one.name == name)


def test_all_of_them_in_their_order():
    assert [one.name for one in options_of(Climb(tyro.MISSING))] == [
        "peaks", "style", "partners", "camp", "fast", "rope.length", "rope.dry",
    ]  # fmt: skip


def test_what_is_told_of_each():
    peaks = told("peaks")
    assert (peaks.about, peaks.value, peaks.many) == ("Where to.", "PEAK", True)
    assert peaks.positional
    assert peaks.required
    assert peaks.flags == ()
    style = told("style")
    assert (style.choices, style.value, style.usual) == (("lead", "solo"), "{lead,solo}", "")
    assert (told("partners").value, told("partners").usual) == ("TEXT", "")
    assert (told("camp").value, told("camp").flags) == ("DIR", ("--camp",))
    assert (told("fast").value, told("fast").usual, told("fast").flags) == ("", "", ("--fast",))


def test_settings_are_told_for_people_who_read_no_code():
    length, dry = told("rope.length"), told("rope.dry")
    assert length.is_setting
    assert (length.about, length.usual, length.takes) == ("How long, in m.", "60", "a number")
    assert (dry.usual, dry.flags) == ("on", ("--rope.dry", "--rope.no-dry"))
    assert dry.led_by == "What holds."


METHODS = described([])
EVERY = [
    *skyline_viz.cli.commands(METHODS, TrainingConfig()).items(),
    *annotate.cli.commands(METHODS).items(),
]


@pytest.mark.parametrize(("name", "command"), EVERY, ids=[name for name, _ in EVERY])
def test_every_option_of_every_command_reads_well(name, command):
    for one in options_of(command):
        assert one.about.endswith("."), one.name
        assert "`" not in one.about
        assert "None" not in one.usual + one.value
        assert one.usual or one.required or one.default in (None, False, "", ())
