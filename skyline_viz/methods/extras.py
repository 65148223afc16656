"""Packages that only some methods need, imported when one of these does."""

from __future__ import annotations

from importlib import import_module
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
        package = (error.name or module).split(".", maxsplit=1)[0]
        raise MethodError(
            f"{method} needs {_INSTALLED_AS.get(package, package)} to be trained; "
            f"install it with: pip install 'skyline-viz[{extra}]'"
        ) from error
