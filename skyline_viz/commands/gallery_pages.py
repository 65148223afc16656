"""``skyline-viz gallery --html``: a data set as pages for any browser, without the viewer."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from skyline_viz.command_line.clusters import on_cluster
from skyline_viz.command_line.inputs import output_folder
from skyline_viz.command_line.messages import SOME_FAILED, UsageError, counted, status_after, tell
from skyline_viz.command_line.sizes import foresee
from skyline_viz.system.memory import RECORDING

if TYPE_CHECKING:
    from skyline_viz.datasets.named_item import NamedItem
    from skyline_viz.method import Method


def write_pages(
    out: Path,
    title: str,
    inputs: Sequence[NamedItem],
    methods: Sequence[Method],
    kept: Path,
    workers: int,
    cluster: str | None = None,
) -> int:
    """Detect, diagnose where there is a truth, and write the pages; return the exit status.

    Args:
        out: Their folder.
        title: What the photos are called together.
        inputs: The photos.
        methods: What detects: one of them.
        kept: Folder of the gallery in which photos were reviewed and commented.
        workers: Number of processes.
        cluster: Address of a cluster instead, or ``local:N``.

    Raises:
        UsageError: There are several methods, or the folder holds something else.
    """
    from skyline_viz.evaluation.tasks import photo_tasks
    from skyline_viz.gallery.flags import read_flags
    from skyline_viz.reports.gallery import INDEX, write_gallery

    if len(methods) > 1:
        raise UsageError(
            f"--html shows one method, and {len(methods)} are named; evaluate --report compares "
            f"several."
        )
    if (out / INDEX).exists() and not (out / "pages").is_dir():
        raise UsageError(f"{out} holds another page {INDEX}; choose another folder for --html.")
    output_folder(out, (one.item for one in inputs))
    tags = folders_of(inputs)
    for name, flag in read_flags(kept).items():
        said = [("reviewed", flag.reviewed), ("commented", bool(flag.comment))]
        tags.setdefault(name, []).extend(word for word, true in said if true)
    tasks = photo_tasks([(replace(one.item, name=one.name), methods[0]) for one in inputs])
    planned = foresee((one.item for one in inputs), workers, RECORDING)
    with on_cluster(cluster, workers, out):
        found, failures = write_gallery(
            out, title, methods[0].name, tasks, tags=tags, workers=planned
        )
    if found:
        tell(f"{counted(len(found), 'photo')}; open {out / INDEX} in a browser")
    return status_after(failures) or (0 if found else SOME_FAILED)


def folders_of(inputs: Sequence[NamedItem]) -> dict[str, list[str]]:
    """The folder of each photo below that of them all, by its name; none where all are in one."""
    places = [Path(os.path.abspath(one.item.photo_path.parent)) for one in inputs]  # noqa: PTH100
    try:
        root = os.path.commonpath(places)
    except ValueError:  # on different disks
        root = ""
    return {
        one.name: [place.relative_to(root).as_posix()]
        for one, place in zip(inputs, places, strict=True)
        if root and str(place) != root
    }
