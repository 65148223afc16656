"""Packages that only some methods need, imported when one of these does."""

from __future__ import annotations

import re
import shlex
import sys
from importlib import import_module
from importlib.metadata import PackageNotFoundError, requires
from typing import Any, Literal

from skyline_viz.method import MethodError

_INSTALLED_AS = {"sklearn": "scikit-learn"}


def needed(module: str, extra: Literal["methods", "deep"], method: str) -> Any:  # noqa: ANN401 - a module's names are not known here
    """A module of a package that comes with an extra.

    Args:
        module: What is imported, say ``sklearn.svm``, or a module of ours that imports it.
        extra: The extra that its package comes with.
        method: Name of the method that needs it.

    Raises:
        MethodError: The package is not installed.
    """
    try:
        return import_module(module)
    except ImportError as error:
        missing = (error.name or module).split(".", maxsplit=1)[0]
        package = _INSTALLED_AS.get(missing, missing)
        raise MethodError(
            f"{method} needs {package} to be trained; install it with: "
            f"{shlex.quote(sys.executable)} -m pip install {_wanted(package, extra)}"
        ) from error


def _wanted(package: str, extra: str) -> str:
    """A package in the versions that an extra of ours wants, for a shell.

    It is named itself: "skyline-viz[...]" can only be installed where a copy of it lies.
    """
    begins = re.compile(rf"{re.escape(package)}(?![\w.-])[^;]*")
    try:
        wanted = requires("skyline-viz") or []
    except PackageNotFoundError:  # it is not installed itself
        wanted = []
    for one in wanted:
        if f'"{extra}"' in one.replace("'", '"') and (found := begins.match(one)):
            return shlex.quote(found[0].replace(" ", ""))
    return package
