"""Reports as commands write them: ``--report FILE.html``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import tyro

from skyline_viz.command_line.messages import UsageError, counted, tell_done

if TYPE_CHECKING:
    from skyline_viz.datasets import Dataset
    from skyline_viz.diagnosis import Diagnosed
    from skyline_viz.evaluation import PhotoResult
    from skyline_viz.evaluation.tasks import PhotoTask
    from skyline_viz.reports import Report
    from skyline_viz.running.batch import Failure

ReportFile: TypeAlias = Annotated[Path | None, tyro.conf.arg(metavar="FILE.html")]
"""Where a report goes, or None to write none."""


def check_report(path: Path | None) -> None:
    """Refuse a file for a report that would be none, before anything is worked on.

    Raises:
        UsageError: It does not end in ``.html``, or is a folder.
    """
    if path is None:
        return
    if path.suffix.lower() not in (".html", ".htm"):
        raise UsageError(f"a report is HTML, so {path} should end in .html.")
    if path.is_dir():
        raise UsageError(f"a report is a file, and {path} is a folder.")


def report_data_set(
    path: Path,
    dataset: Dataset,
    how: str,
    tasks: Sequence[PhotoTask],
    failures: Sequence[Failure],
    *,
    diagnosed: Sequence[Diagnosed] = (),
    results: Mapping[str, Sequence[PhotoResult]] | None = None,
    notes: Sequence[str] = (),
    workers: int = 1,
) -> list[Failure]:
    """Look at photos that were tested again, and write a report.

    Args:
        path: Where to.
        dataset: The data set.
        how: How it was tested, in a few words.
        tasks: The photos, each with its method.
        failures: Those that failed, which are not looked at.
        diagnosed: What is known of them; the others are diagnosed, and nothing is tried on them.
        results: What each of several methods came to.
        notes: What else there is to know, in sentences.
        workers: Number of processes.

    Returns:
        The photos that failed only now.
    """
    from skyline_viz.reports import Report, look_at

    failed = {one.name for one in failures}
    good = [task for task in tasks if task.name not in failed]
    photos, late = look_at(good, diagnosed, workers=workers)
    title = photos[0].name if len(tasks) == 1 and photos else dataset.name
    told = [*notes, *dataset.problems, *dataset.left_out]
    write(path, Report(title, photos, how, results or {}, [*failures, *late], told))
    return late


def write(path: Path, report: Report) -> None:
    """Write a report, and say so."""
    from skyline_viz.reports import write_report

    write_report(path, report)
    size = path.stat().st_size / 1e6
    tell_done(f"{path}: {counted(len(report.photos), 'photo')}, {size:.1f} MB")
