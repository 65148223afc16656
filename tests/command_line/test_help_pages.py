"""Help pages: groups, examples, and settings that wait for --help-all."""

import shlex

import pytest

import annotate.cli
import skyline_viz.cli
from skyline_viz.command_line.help_pages import asks_for_help, command_page, examples_of, page
from skyline_viz.command_line.methods import described
from skyline_viz.config import TrainingConfig
from testing.programs.commands import write_scene, write_scenes

METHODS = described([])
PROGRAMS = {
    "skyline-viz": skyline_viz.cli.commands(METHODS, TrainingConfig()),
    "skyline-annotate": annotate.cli.commands(METHODS),
}
PARSE = {"skyline-viz": skyline_viz.cli.parse, "skyline-annotate": annotate.cli.parse}
EVERY = [(program, name) for program, commands in PROGRAMS.items() for name in commands]


def shown(program, name, *, everything=False):
    command = PROGRAMS[program][name]
    return command_page(f"{program} {name}", command, everything=everything)


@pytest.mark.parametrize(("program", "name"), EVERY)
def test_every_page_fits_and_has_its_parts(program, name, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    text = shown(program, name)
    lines = text.splitlines()
    assert lines[0].startswith(f"usage: {program} {name}")
    assert max(map(len, lines)) <= 80
    for part in ("Work", "  --quiet", "  --verbose", "  --help", "Examples"):
        assert part in text
    assert "None" not in text
    assert "(default: )" not in text
    assert "`" not in text


@pytest.mark.parametrize(("program", "name"), EVERY)
def test_settings_are_left_to_help_all(program, name):
    short, long = shown(program, name), shown(program, name, everything=True)
    if "\nSettings\n" in short:
        assert f"{program} {name} --help-all" in " ".join(short.split())
        assert long.count(".delta") > short.count(".delta")
        assert len(short.splitlines()) < 90
    else:
        assert "--help-all" not in short
        assert long == short


@pytest.mark.parametrize("group", ["Photos", "Detector", "Output", "Work", "Settings", "Examples"])
def test_options_stand_in_groups(group):
    assert shown("skyline-viz", "detect").count(f"\n\n{group}\n") == 1


def test_the_settings_come_last_and_before_examples():
    titles = [line for line in shown("skyline-viz", "evaluate").splitlines() if line.istitle()]
    assert titles == ["Photos", "Detector", "Options", "Output", "Work", "Settings", "Examples"]


def test_the_page_of_a_program_names_its_commands():
    text = page("skyline-viz", "Finds.\n", PROGRAMS["skyline-viz"], ["--help"])
    assert text.startswith("usage: skyline-viz COMMAND [OPTIONS]\n\nFinds.\n")
    for name in PROGRAMS["skyline-viz"]:
        assert f"\n  {name} " in text


def test_who_asks_for_help():
    assert asks_for_help(["detect", "a.jpg", "--help"])
    assert asks_for_help(["-h"])
    assert not asks_for_help(["detect", "help"])


@pytest.fixture
def places(tmp_path, monkeypatch):
    """A folder that holds what the examples name."""
    monkeypatch.chdir(tmp_path)
    write_scenes(tmp_path / "hills", 2)
    write_scene(tmp_path / "photos" / "tor.jpg")
    assert skyline_viz.cli.main(["detect", "photos", "--quiet"]) == 0


@pytest.mark.usefixtures("places")
@pytest.mark.parametrize(("program", "name"), EVERY)
def test_every_page_has_three_examples_that_are_understood(program, name):
    examples = examples_of(PROGRAMS[program][name])
    assert len(examples) == 3
    for example in examples:
        called, *words = shlex.split(example)
        assert (called, words[0]) == (program, name)
        quiet = [word for word in words if word != "--quiet"]
        assert type(PARSE[program](quiet)) is type(PROGRAMS[program][name])
