"""The docs name every command, option and setting that exists, and none that does not."""

import contextlib
import doctest
import io
import re
from dataclasses import fields

import pytest

import annotate.cli
import skyline_viz
from skyline_viz.bins import Bins
from skyline_viz.cli import main
from skyline_viz.config import DetectorConfig, TrainingConfig
from testing import ROOT

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
COMMANDS = (
    "detect",
    "inspect",
    "gallery",
    "join",
    "train",
    "evaluate",
    "tables",
    "diagnose",
    "render",
    "demo",
)
LABELLING = ("open", "export", "import", "status", "agreement", "consensus", "backup", "repair")
OF_OTHERS = {  # options of SLURM and dask
    "scale.md": {
        "--array",
        "--cpus-per-task",
        "--dependency",
        "--job-name",
        "--mem",
        "--nthreads",
        "--open-mode",
        "--output",
        "--parsable",
        "--requeue",
        "--time",
        "--wrap",
    }
}
PROGRAMS = [(main, COMMANDS), (annotate.cli.main, LABELLING)]


def help_of(program, *words) -> str:
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        assert program([*words, "--help-all"]) == 0
    return said.getvalue()


def options_of(program, command: str) -> set[str]:
    return set(re.findall(r"(?<![\w-])--[a-z][a-z.-]*[a-z]", help_of(program, command)))


def settings() -> set[str]:
    training = {field.name for field in fields(TrainingConfig)} - {"bins", "detector"}
    bins = {f"bins.{field.name}" for field in fields(Bins)}
    return {field.name for field in fields(DetectorConfig)} | training | bins


def test_the_reference_lists_exactly_the_commands_there_are():
    reference = (ROOT / "docs" / "reference.md").read_text()
    parts = [reference.split("## Settings")[0], reference.split("## Labelling commands")[1]]
    for part, (program, commands) in zip(parts, PROGRAMS, strict=True):
        assert re.findall(r"^\| `([a-z]+)[^`]*` \|", part, re.MULTILINE) == list(commands)
        assert set(re.findall(r"^  ([a-z]+) ", help_of(program), re.MULTILINE)) == set(commands)


def test_the_reference_names_what_commands_take_as_their_help_does():
    reference = (ROOT / "docs" / "reference.md").read_text()
    rows = dict(re.findall(r"^\| `([a-z]+) ?([^`]*)` \|", reference, re.MULTILINE))
    for program, commands in PROGRAMS:
        for command in commands:
            usage = help_of(program, command).splitlines()[0]
            assert (
                usage
                == f"usage: {usage.split()[1]} {command} {rows[command]} [OPTIONS]".replace(
                    "  ", " "
                )
            )


def test_the_reference_lists_exactly_the_settings_there_are():
    reference = (ROOT / "docs" / "reference.md").read_text().split("## Settings", 1)[1]
    tables = reference.split("## Files")[0]
    assert set(re.findall(r"^\| `([a-z_.]+)` \|", tables, re.MULTILINE)) == settings()


@pytest.mark.parametrize("field", fields(DetectorConfig), ids=lambda field: field.name)
def test_the_reference_gives_the_defaults_of_both_presets(field):
    reference = (ROOT / "docs" / "reference.md").read_text()
    row = re.search(rf"^\| `{field.name}` \| (\S+) \| (\S+) \|", reference, re.MULTILINE)
    assert row is not None
    default, paper = DetectorConfig(), DetectorConfig.paper()
    assert row.groups() == (str(getattr(default, field.name)), str(getattr(paper, field.name)))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_option_that_a_page_names_exists(page):
    known = {"--version", "--tyro-print-completion"} | OF_OTHERS.get(page.name, set())
    for program, commands in PROGRAMS:
        known |= set().union(*(options_of(program, command) for command in commands))
    named = set(re.findall(r"(?<![\w-])--[a-z][a-z.-]*[a-z*]", page.read_text()))
    families = {name for name in named if name.endswith("*")}
    assert named - families <= known
    for family in families:
        assert any(option.startswith(family[:-1]) for option in known)


def test_every_option_is_named_in_the_reference():
    reference = (ROOT / "docs" / "reference.md").read_text()
    plain = re.compile(r"--(config|training)\.")
    for program, commands in PROGRAMS:
        for command in commands:
            for option in options_of(program, command):
                assert plain.match(option) or option in reference, (command, option)


def test_the_page_on_labelling_names_every_key():
    page = (ROOT / "docs" / "labelling.md").read_text()
    keys = (ROOT / "annotate" / "static" / "keys.js").read_text()
    shown = re.findall(r'^    one\("([^"]+)", "([^"]+)"', keys, re.MULTILINE)
    assert len(shown) > 20
    for key, says in shown:
        assert f"| {key} | {says} |" in page


def anchors(page) -> set[str]:
    headings = re.findall(r"^#+ (.+)$", page.read_text(), re.MULTILINE)
    return {
        re.sub(r"[^\w -]", "", heading).strip().lower().replace(" ", "-") for heading in headings
    }


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for target, anchor in re.findall(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)", page.read_text()):
        if "://" not in target:
            linked = page.parent / target if target else page
            assert linked.exists(), target
            assert not anchor or anchor in anchors(linked), (target, anchor)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_python_examples_use_public_names_only(page):
    for name in re.findall(r"\bsv\.([A-Za-z_]+)", page.read_text()):
        assert name in skyline_viz.__all__, name


def test_the_examples_of_the_reference_give_what_they_say():
    tried = doctest.testfile(str(ROOT / "docs" / "reference.md"), module_relative=False)
    assert tried.attempted > 5
    assert tried.failed == 0


def test_the_five_lines_of_the_readme_run(tmp_path, monkeypatch):
    code = re.search(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    assert code is not None
    source = min((ROOT / "sample_data" / "images").glob("cloudy*.jpg"))
    (tmp_path / "photo.jpg").write_bytes(source.read_bytes())
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    exec(code[1], names)
    assert (tmp_path / "skyline.csv").read_text().startswith("column,row,visible\n0,")
