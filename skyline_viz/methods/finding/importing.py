"""Classes of somebody's: found as ``package.module:Class``, or by what a package offers."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Mapping
from importlib import import_module
from importlib.metadata import entry_points
from pathlib import Path
from types import TracebackType
from typing import Any

from skyline_viz.method import MethodError
from skyline_viz.system.nearest import meant

GROUP = "skyline_viz.methods"
"""Entry point group in which an installed package offers methods by name."""

_IMPORTING = ("<frozen importlib", "importlib")


def offered() -> Mapping[str, str]:
    """Names of the methods that installed packages offer, and where their classes are."""
    return {one.name: one.value for one in entry_points(group=GROUP)}


def class_at(place: str) -> Any:  # noqa: ANN401 - anything may be there
    """What is at ``package.module:Class``, looked up in what is installed and in this folder.

    Raises:
        MethodError: There is no such module or class, or the module fails when it is loaded.
    """
    module, _, name = place.partition(":")
    folder = str(Path.cwd())
    if folder not in sys.path:
        sys.path.append(folder)  # last: a file there replaces no module of anybody's
    try:
        found: Any = import_module(module)
    except ModuleNotFoundError as error:
        if error.name and f"{module}.".startswith(f"{error.name}."):
            raise MethodError(
                f"there is no module {error.name}, neither in {folder} nor installed."
            ) from error
        raise failed_in(place, error) from error
    except (Exception, SystemExit) as error:
        raise failed_in(place, error) from error
    for part in name.split("."):
        if not hasattr(found, part):
            known = [one for one, value in vars(found).items() if isinstance(value, type)]
            raise MethodError(f"{module} has no class {part}; {meant(part, known, 'it has')}")
        found = getattr(found, part)
    return found


def failed_in(place: str, error: BaseException) -> MethodError:
    """What went wrong in somebody's code, in one sentence with the line."""
    reason = " ".join(str(error).split())
    if isinstance(error, SyntaxError):
        where = f"{Path(error.filename or '').name}, line {error.lineno}"
        reason = error.msg
    else:
        where = _line_of(error.__traceback__, place)
    said = f"{type(error).__name__}: {reason}" if reason else type(error).__name__
    return MethodError(f"{place} failed in {where}: {said.rstrip('.')}.")


def _line_of(trace: TracebackType | None, place: str) -> str:
    """The last line of their own that was run, or else of whatever was."""
    frames = [
        one
        for one in traceback.extract_tb(trace)
        if not one.filename.startswith(_IMPORTING[0])
        and _IMPORTING[1] not in Path(one.filename).parts
    ]
    module = sys.modules.get(place.partition(":")[0])
    own = [one for one in frames if one.filename == getattr(module, "__file__", None)]
    outside = [one for one in frames if Path(__file__).parents[1] not in Path(one.filename).parents]
    for last in (own or outside or frames)[-1:]:
        return f"{Path(last.filename).name}, line {last.lineno}"
    return "its code"
