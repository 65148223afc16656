"""What holds for all tests: what is named as not run, and which examples properties get."""

import ast
import os
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest
from _pytest.doctest import DoctestModule
from hypothesis import settings

OPTIONAL = {
    "torch": "the extra 'deep'",
    "onnx": "the extra 'deep'",
    "sklearn": "the extra 'methods'",
    "rerun_notebook": "the extra 'notebook'",
    "axe_playwright_python": "the development set",
    "build": "the development set",
    "httpx": "the development set",
    "nbclient": "the development set",
    "nbformat": "the development set",
    "playwright": "the development set",
    "psutil": "the development set",
    "pycocotools": "the development set",
    "schemathesis": "the development set",
}
"""Packages that skyline-viz itself runs without, and what brings them."""

OURS = ("annotate", "skyline_viz", "testing", "tests")
ROOT = Path(__file__).parent

# The same examples for everybody, so that a change is green or red on every machine alike; and with
# `make fuzz` many new ones. `testing.examples` says how many.
settings.register_profile("fixed", derandomize=True, deadline=None)
settings.register_profile("random", max_examples=2000, deadline=None, print_blob=True)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "fixed"))


@pytest.hookimpl(tryfirst=True)
def pytest_make_collect_report(collector):
    """Name a module as not run when it, or what it imports, needs a package that is not there."""
    if not isinstance(collector, pytest.Module | DoctestModule):
        return None
    if (package := missing(collector.path)) is None:
        return None
    where = (str(collector.path), 1, not_run(package))
    return pytest.CollectReport(collector.nodeid, "skipped", where, [])


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Name a test as not run when it fails for want of an optional package."""
    report = yield
    error = call.excinfo and call.excinfo.value
    while report.failed and error is not None:
        package = (getattr(error, "name", None) or "").partition(".")[0]
        if isinstance(error, ModuleNotFoundError) and absent(package):
            path, line, _ = item.location
            report.outcome, report.longrepr = "skipped", (path, line, not_run(package))
        error = error.__cause__ or error.__context__
    return report


def not_run(package):
    """What is said of a test or a module that an absent package keeps from running."""
    return f"Skipped: not run, {package} of {OPTIONAL[package]} is not installed"


@cache
def absent(package):
    """Whether an optional package is not installed."""
    return package in OPTIONAL and find_spec(package) is None


@cache
def missing(path):
    """The first optional package without which a file of ours cannot be imported; None if none."""
    for name in imported(path):
        package = name.partition(".")[0]
        if absent(package):
            return package
        if package in OURS and (ours := source(name)) and (found := missing(ours)):
            return found
    return None


def imported(path):
    """Names that a file imports when it is loaded, those of modules among them."""
    for line in ast.parse(path.read_bytes()).body:
        if isinstance(line, ast.Import):
            yield from (alias.name for alias in line.names)
        elif isinstance(line, ast.ImportFrom) and line.module:
            yield line.module
            yield from (f"{line.module}.{alias.name}" for alias in line.names)


def source(name):
    """The file of a module of ours; None where the name is not a module."""
    path = ROOT.joinpath(*name.split(".")).with_suffix(".py")
    return path if path.is_file() else None
