"""How the project is laid out: small files, small folders, and a test file for every module."""

import ast
from collections import Counter
from pathlib import Path

import pytest

from testing import ROOT

PARTS = ("skyline_viz", "annotate", "tests", "testing", "benchmarks", "tools")
MOST_LINES = 400
MOST_MODULES = 24

WITHOUT = {
    "skyline_viz/_version.py": "the version is tested with the package",
}
"""Modules that have no test file of their own, and why."""


def modules(*parts):
    """Python files below folders of the project, as paths from its top."""
    found = (path for part in parts for path in (ROOT / part).rglob("*.py"))
    return sorted(path.relative_to(ROOT) for path in found)


def namesake(module):
    """The test file of a module: that of `skyline_viz.path` is `tests/test_path.py`."""
    folders = module.parts[1:] if module.parts[0] == "skyline_viz" else module.parts
    return Path("tests", *folders[:-1], f"test_{module.name}")


def test_no_file_is_long():
    long = {}
    for path in modules(*PARTS):
        lines = len((ROOT / path).read_text(encoding="utf-8").splitlines())
        if lines > MOST_LINES:
            long[str(path)] = lines
    assert long == {}


def test_no_folder_is_full():
    count = Counter(
        path.parent for path in modules(*PARTS) if not path.name.startswith(("_", "conftest"))
    )
    full = {str(folder): number for folder, number in count.items() if number > MOST_MODULES}
    assert full == {}


def test_every_module_has_a_test_file():
    missing = [
        module.as_posix()
        for module in modules("skyline_viz", "annotate")
        if not module.name.startswith("__")  # what a package or a program begins with
        and module.as_posix() not in WITHOUT
        and not (ROOT / namesake(module)).is_file()
    ]
    assert missing == []


def test_exceptions_are_of_modules_that_have_no_test_file():
    for name in WITHOUT:
        assert (ROOT / name).is_file(), f"{name} is not there"
        assert not (ROOT / namesake(Path(name))).is_file(), f"{name} has a test file now"


@pytest.mark.parametrize("path", modules("tests", "testing"), ids=str)
def test_nothing_is_imported_from_a_test_module(path):
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    names = [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    names += [
        one.name for node in ast.walk(tree) if isinstance(node, ast.Import) for one in node.names
    ]
    assert [name for name in names if name.split(".")[0] == "tests"] == []
