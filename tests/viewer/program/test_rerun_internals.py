"""Parts of Rerun that may be gone with its next version: what is said, and what goes on."""

import ast
import sys
from importlib import import_module

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.cli import main
from skyline_viz.viewer.program import rerun_internals
from skyline_viz.viewer.program.rerun_internals import PARTS, Part, ViewerError
from testing import ROOT
from testing.recordings import Read

HERE = "skyline_viz/viewer/program/rerun_internals.py"
PRIVATE = ("rerun_bindings", "rerun_cli", "rerun.experimental", "rerun.blueprint.table")


@pytest.fixture(autouse=True)
def fresh():
    rerun_internals.program.cache_clear()
    yield
    rerun_internals.program.cache_clear()


def without(monkeypatch, part):
    """Make a part of Rerun missing."""
    if part.name:
        monkeypatch.delattr(import_module(part.module), part.name)
    else:
        monkeypatch.setitem(sys.modules, part.module, None)


def photo(tmp_path):
    pixels = np.full((40, 60, 3), 200, np.uint8)
    pixels[20:] = 60
    sv.write_photo(tmp_path / "a.png", pixels)
    return str(tmp_path / "a.png")


@pytest.mark.parametrize("part", PARTS, ids=lambda part: f"{part.module}.{part.name}")
def test_every_part_is_in_the_version_that_is_installed(part):
    part.take()


@pytest.mark.parametrize("part", PARTS, ids=lambda part: f"{part.module}.{part.name}")
def test_what_is_missing_is_one_sentence(monkeypatch, part):
    without(monkeypatch, part)
    with pytest.raises(ViewerError) as told:
        part.take()
    said = str(told.value)
    assert said.startswith("rerun-sdk 0.")
    assert f"has no {'.'.join(filter(None, (part.module, part.name)))}: " in said
    assert said.count(".", len(said) - 1) == 1


def test_a_module_that_is_missing_is_one_sentence_too(monkeypatch):
    monkeypatch.setitem(sys.modules, "rerun_bindings", None)
    with pytest.raises(ViewerError, match=r"has no rerun_bindings\.flush"):
        rerun_internals.ORPHANS.take()


def test_recordings_are_made_and_it_is_said_once_that_memory_is_kept(monkeypatch, tmp_path, capsys):
    without(monkeypatch, rerun_internals.ORPHANS)
    for name in "ab":
        assert main(["inspect", photo(tmp_path), "--save", str(tmp_path / f"{name}.rrd")]) == 0
        assert "photo" in Read(tmp_path / f"{name}.rrd").entities()
        said = [line for line in capsys.readouterr().err.splitlines() if "rerun-sdk" in line]
        assert len(said) == 1
        assert "keeps up to 2 MB of memory" in said[0]


@pytest.mark.parametrize("part", [rerun_internals.PROGRAM, rerun_internals.CLIENT])
def test_a_picture_is_refused_in_a_sentence_and_a_recording_is_not(
    monkeypatch, tmp_path, capsys, part
):
    without(monkeypatch, part)
    assert main(["inspect", photo(tmp_path), "--screenshot", str(tmp_path / "a.png")]) == 1
    said = capsys.readouterr().err
    assert "Traceback" not in said
    assert said.endswith(f"{part.lacking}\n")
    assert main(["inspect", photo(tmp_path), "--save", str(tmp_path / "a.rrd")]) == 0


@pytest.mark.parametrize(
    "part", [rerun_internals.TABLES, rerun_internals.SERVER, rerun_internals.TABLE_INDEX]
)
def test_cards_are_refused_in_a_sentence(monkeypatch, tmp_path, capsys, part):
    without(monkeypatch, part)
    words = ["gallery", photo(tmp_path), "--out", str(tmp_path / "g"), "--serve"]
    assert main([*words, "--workers", "1"]) == 1
    assert capsys.readouterr().err.endswith(f"{part.lacking}\n")


def test_a_program_that_lies_elsewhere_is_one_sentence(monkeypatch, tmp_path):
    monkeypatch.setattr("rerun_cli.__file__", str(tmp_path / "__init__.py"))
    with pytest.raises(ViewerError, match="has no program in"):
        rerun_internals.program()
    bundled = tmp_path / "Rerun.app" / "Contents" / "MacOS" / "Rerun"
    bundled.parent.mkdir(parents=True)
    bundled.touch()
    assert rerun_internals.program() == bundled


def test_a_viewer_for_browsers_with_another_interface_is_one_sentence():
    script = b"class WebHandle { open_channel(a) {} close_channel(a) {} }"
    with pytest.raises(ViewerError, match="has no send_rrd_to_channel: no stages"):
        rerun_internals.check_program_for_browsers(script)


def names_in(file):
    """Modules and attributes of modules that a file names: imports, and words with dots."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (one.name for one in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{one.name}" for one in node.names)
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            yield f"{node.value.id}.{node.attr}"


def for_types_only(file):
    """What a file imports for type checkers alone."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and getattr(node.test, "id", "") == "TYPE_CHECKING":
            for one in ast.walk(node):
                if isinstance(one, ast.ImportFrom):
                    yield from (f"{one.module}.{name.name}" for name in one.names)


def test_nothing_else_touches_them():
    used = {f"rr.{part.name}" for part in PARTS if part.module == "rerun"}
    for package in ("skyline_viz", "annotate"):
        for file in (ROOT / package).rglob("*.py"):
            if file.relative_to(ROOT).as_posix() == HERE:
                continue
            found = set(names_in(file)) - set(for_types_only(file))
            touched = {one for one in found if one.startswith(PRIVATE) or one in used}
            private = {one for one in found if one.startswith(("rr._", "rerun._", "rrb._"))}
            assert not touched | private, file


def test_parts_are_all_that_are_looked_up():
    kept = [one for one in vars(rerun_internals).values() if isinstance(one, Part)]
    assert tuple(kept) == PARTS
