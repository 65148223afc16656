"""The tutorial's commands run, and print what the page shows."""

import re
import shlex
import shutil
from pathlib import Path

import pytest

import annotate.cli
from skyline_viz.cli import main
from testing import ROOT

PAGE = ROOT / "docs" / "tutorial.md"
PROGRAMS = {"skyline-viz": main, "skyline-annotate": annotate.cli.main}
IN_THE_BROWSER = "import photos made/masks --status accepted"  # stands for labelling by hand


def commands():
    """Each command of the page with the lines that it shows."""
    found = []
    for block in re.findall(r"```console\n(.*?)```", PAGE.read_text(), re.DOTALL):
        for line in block.splitlines():
            if line.startswith("$ "):
                found.append((line[2:], []))
            else:
                found[-1][1].append(line)
    return found


def words(line):
    """What a line says, without the drawing of tables."""
    return [one for one in re.split(r"[^\w.,;:%()+/-]+", line) if one]


def holds(printed, shown):
    """Whether a line begins with the words of another one, but for what ends it."""
    return words(printed)[: len(words(shown))] == words(shown)


def run(command):
    program, *rest = shlex.split(command)
    if program == "cp":
        shutil.copytree(rest[-2], rest[-1])
        return 0
    if rest[:1] == ["open"]:
        rest = [*IN_THE_BROWSER.split(), *rest[2:]]
    return PROGRAMS[program](rest)


def test_it_goes_all_the_way():
    used = {shlex.split(command)[1] for command, _ in commands() if not command.startswith("cp")}
    steps = {"detect", "open", "export", "evaluate", "train", "diagnose", "gallery"}
    assert steps <= used


def test_what_the_tutorial_shows_is_what_is_printed(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for command, shown in commands():
        assert run(command) == 0, command
        printed = iter(capsys.readouterr().out.splitlines())
        for line in shown:  # in this order, others between them
            assert any(holds(one, line) for one in printed), (command, line)
    for made in ("skylines/hazy-1-overlay.jpg", "results/histogram.png", "why.html", "cards"):
        assert Path(made).exists()


@pytest.mark.parametrize(
    ("printed", "shown", "same"),
    [
        ("│ A_err, mean │   3.13 px │", "A_err, mean 3.13 px", True),
        ("│ A_err, mean │   3.14 px │", "A_err, mean 3.13 px", False),
        ("written       mine.npz, 117 bytes", "written mine.npz,", True),
    ],
)
def test_the_comparison_can_fail(printed, shown, same):
    assert holds(printed, shown) == same
