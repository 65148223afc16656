"""``skyline-viz inspect --report``: photos as one HTML file, without the viewer."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from skyline_viz.command_line.messages import UsageError, say, status_after, tell
from skyline_viz.command_line.reporting import write
from skyline_viz.command_line.sizes import foresee
from skyline_viz.system.memory import RECORDING

if TYPE_CHECKING:
    from skyline_viz.datasets.dataset import DatasetItem
    from skyline_viz.method import Method


def write_report(
    path: Path, title: str, items: Sequence[DatasetItem], methods: Sequence[Method]
) -> int:
    """Detect, diagnose where there is a truth, and write a report; return the exit status.

    Args:
        path: Where to.
        title: What the photos are called together.
        items: The photos, each under a name of its own.
        methods: What detects: one of them.

    Raises:
        UsageError: There are several methods.
    """
    from skyline_viz.evaluation.seen import notes
    from skyline_viz.evaluation.tasks import photo_tasks
    from skyline_viz.reports import Report, look_at

    if len(methods) > 1:
        raise UsageError(
            f"inspect reports on one method, and {len(methods)} are named; "
            f"evaluate --report compares several on a data set."
        )
    (method,) = methods
    workers = foresee(items, 0, RECORDING)
    tasks = photo_tasks([(item, method) for item in items])
    photos, failures = look_at(tasks, remedies=True, workers=workers)
    for one in photos:
        error = "" if one.a_err is None else f"  A_err {one.a_err:.2f} px"
        tell(f"{one.name}{error}  margin {one.verdict.margin:.3g}")
    known = {one.name: one.seen for one in photos if one.a_err is not None}
    for note in notes(method.name, known, folds=True):
        say(note)
    write(path, Report(title, photos, method.name, failures=failures))
    return status_after(failures)
