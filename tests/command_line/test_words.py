"""Words of a command line, checked before they are parsed."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import pytest
import tyro

from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.settings import Switch
from skyline_viz.command_line.words import checked


@dataclass(frozen=True)
class Climb:
    """Climb."""

    peak: Annotated[Path, tyro.conf.Positional, tyro.conf.arg(metavar="PEAK")]
    """Where to."""

    rope: Annotated[Path, tyro.conf.arg(metavar="FILE")]
    """What holds."""

    partners: tuple[str, ...] = ()
    """With whom."""

    style: Literal["lead", "solo"] = "lead"
    """How."""

    height: float = 0.0
    """From where."""

    days: int = 1
    """How long."""

    fast: Switch = False
    """Without a pause."""

    dry: bool = True
    """Whether it is dry."""


COMMANDS = {"climb": Climb(tyro.MISSING, tyro.MISSING)}


@pytest.mark.parametrize(
    "words",
    [
        "climb tor --rope r",
        "climb --rope r tor --partners ada bo",
        "climb --partners ada bo --rope r tor",
        "climb --fast tor --rope=r --height -3.5 --days -1 --no-dry --style=solo",
    ],
)
def test_good_words_stay_as_they_are(words):
    assert checked("prog", COMMANDS, words.split()) == words.split()


@pytest.mark.parametrize(
    ("words", "order"),
    [
        ("climb --rope r --partners ada bo tor", "climb tor --rope r --partners ada bo"),
        ("climb --partners ada tor --rope r", "climb tor --partners ada --rope r"),
    ],
)
def test_several_values_swallow_nothing(words, order):
    assert checked("prog", COMMANDS, words.split()) == order.split()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("", "which command? There are climb; see prog --help."),
        ("clim tor", "there is no command clim; did you mean climb?"),
        ("rest", "there is no command rest; there are climb."),
        ("climb --rope r", "which PEAK? See prog climb --help."),
        ("climb --rope r --partners tor", "which PEAK? See prog climb --help."),
        ("climb tor", "prog climb needs --rope FILE."),
        ("climb tor cima --rope r", "prog climb takes one PEAK, and there is also cima."),
        ("climb tor --rope", "--rope is named without its FILE."),
        ("climb tor --rope --fast", "--rope is named without its FILE."),
        ("climb tor --rop r", "prog climb has no option --rop; did you mean --rope?"),
        ("climb tor -f", "prog climb has no option -f; see prog climb --help-all."),
        ("climb tor --xyzzy=3", "prog climb has no option --xyzzy; see prog climb --help-all."),
        ("climb tor --rope r --style sol", "--style cannot be sol; did you mean solo?"),
        ("climb tor --rope r --style x", "--style cannot be x; it is one of lead, solo."),
        ("climb tor --rope r --days 1.5", "--days is a whole number, not 1.5."),
        ("climb tor --rope r --height=up", "--height is a number, not up."),
    ],
)
def test_a_mistake_is_one_sentence(words, told):
    with pytest.raises(UsageError) as refused:
        checked("prog", COMMANDS, words.split())
    assert str(refused.value) == told
