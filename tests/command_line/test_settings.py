"""The preset from which the settings of a command start."""

import pytest

from skyline_viz.command_line.settings import asked_preset


@pytest.mark.parametrize(
    ("words", "preset"),
    [
        ("detect a.jpg", "default"),
        ("detect --preset paper a.jpg", "paper"),
        ("detect --preset=paper a.jpg", "paper"),
        ("detect --preset paper --preset default", "default"),
        ("detect --preset", "default"),
        ("detect --preset moon", "default"),
        ("detect paper", "default"),
    ],
)
def test_the_preset_is_known_before_parsing(words, preset):
    assert asked_preset(words.split()) == preset
