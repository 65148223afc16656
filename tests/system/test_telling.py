"""How much programs tell."""

import pytest

from skyline_viz.system.telling import Telling, asked_to_tell, telling, told


@pytest.mark.parametrize(
    ("words", "much"),
    [
        (["detect", "a.jpg"], Telling.USUAL),
        (["--quiet", "detect", "a.jpg"], Telling.RESULTS),
        (["detect", "--verbose", "a.jpg", "--verbose"], Telling.EVERYTHING),
    ],
)
def test_what_a_command_line_asks_for(words, much):
    assert asked_to_tell(words) == (much, ["detect", "a.jpg"])


def test_less_and_more_is_nothing():
    with pytest.raises(ValueError, match="--quiet and --verbose exclude each other"):
        asked_to_tell(["--quiet", "--verbose"])


def test_it_ends_with_the_block():
    with told(Telling.RESULTS), told(Telling.EVERYTHING):
        assert telling() == Telling.EVERYTHING
    assert telling() == Telling.USUAL
