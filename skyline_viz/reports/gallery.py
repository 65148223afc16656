"""A data set as a folder of pages for any browser: cards, and a page for each photo.

::

    index.html           the cards, with what a report of a data set says above them
    pages/NAME.html      a photo with its costs, stages and reasons, opened by a click on its card
    thumbnails/NAME.webp the photo on its card, loaded when it comes into view

Nothing is asked for from outside the folder, and no server is needed. Odd names are spelt in plain
letters. A page is written as soon as its photo is done, and the cards when all are.
"""

from __future__ import annotations

import base64
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from skyline_viz.evaluation.tasks import PhotoTask
from skyline_viz.files import replacing
from skyline_viz.reports.document import Report, write_report
from skyline_viz.reports.looking import look
from skyline_viz.reports.photo_report import PhotoReport
from skyline_viz.running.batch import Failure, run
from skyline_viz.system.names import recording_id

INDEX = "index.html"
"""The page to open."""

_PAGES, _THUMBNAILS = "pages", "thumbnails"
_MANY = 2  # photos, of which each is shown as large as in a report of several


@dataclass(frozen=True)
class _Task:
    name: str
    task: PhotoTask
    tags: tuple[str, ...]


def write_gallery(
    folder: str | os.PathLike[str],
    title: str,
    how: str,
    tasks: Sequence[PhotoTask],
    *,
    tags: Mapping[str, Sequence[str]] | None = None,
    notes: Sequence[str] = (),
    workers: int = 1,
) -> tuple[list[PhotoReport], list[Failure]]:
    """Look at photos, and write a page for each and one of all.

    Args:
        folder: Where to; what it holds of an earlier gallery is replaced.
        title: What the photos are called together.
        how: How they were tested, in a few words.
        tasks: Photos, each with its method.
        tags: Words by which photos can be chosen, by their names, besides those that reports have.
        notes: What else there is to know, in sentences.
        workers: Number of processes, see `batch.run`.

    Returns:
        What the cards show, in the order of the photos, and the photos that failed.

    Raises:
        OSError: A file cannot be written; those that are there are whole.
    """
    root = Path(folder)
    for place in (_PAGES, _THUMBNAILS):
        (root / place).mkdir(parents=True, exist_ok=True)
    named = tags or {}
    looks = [_Task(one.name, one, tuple(named.get(one.name, ()))) for one in tasks]
    found: list[PhotoReport] = []
    failures: list[Failure] = []
    for outcome in run(partial(_write, root, how), looks, workers=workers, title="gallery"):
        if isinstance(outcome, Failure):
            failures.append(outcome)
        else:
            found.append(outcome)
    pages = {one.name: f"{_PAGES}/{recording_id(one.name)}.html" for one in found}
    report = Report(title, found, how, failures=failures, notes=notes, pages=pages)
    write_report(root / INDEX, report)
    return found, failures


def _write(root: Path, how: str, task: _Task) -> PhotoReport:
    """Write a photo's page and its thumbnail; return what its card shows."""
    shown = replace(look(task.task, photos=_MANY), own_tags=task.tags)
    file = recording_id(task.name)
    page = Report(task.name, [shown], how, back=f"../{INDEX}")
    write_report(root / _PAGES / f"{file}.html", page)
    picture = root / _THUMBNAILS / f"{file}.webp"
    with replacing(picture) as temporary:
        temporary.write_bytes(base64.b64decode(shown.photo.address.partition(",")[2]))
    small = replace(shown.photo, address=f"{_THUMBNAILS}/{file}.webp")
    return replace(shown, photo=small, stages=(), plots=())
