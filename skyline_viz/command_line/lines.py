"""Lines that exist as files, as commands take them: ``--predictions [LABEL=]DIR``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import tyro

from skyline_viz.command_line.local import local
from skyline_viz.command_line.messages import SOME_FAILED, UsageError, counted, say, status_after
from skyline_viz.storage.addresses import is_address
from skyline_viz.system.names import listed

if TYPE_CHECKING:
    from skyline_viz.command_line.truth_options import Truths
    from skyline_viz.datasets import DatasetItem
    from skyline_viz.datasets.predictions import Predictions
    from skyline_viz.running.batch import Failure

LineFolders: TypeAlias = Annotated[tuple[str, ...], tyro.conf.arg(metavar="[LABEL=]DIR")]
"""Folders or files of lines, by paths or addresses, each with a label before it or not."""


def open_lines(
    folders: Sequence[str], items: Sequence[DatasetItem], truths: Truths
) -> list[Predictions]:
    """Find the lines of photos; says which files are not used, and why.

    Args:
        folders: Folders or files, each with a label before it or not.
        items: The photos.
        truths: How to read masks that leave a choice.

    Raises:
        UsageError: Two have the same name.
        DatasetError: One does not exist, or holds no line for any of the photos.
        StorageError: An address leads nowhere, or it cannot be copied.
    """
    from skyline_viz.datasets.lost_item import lines_with_lost
    from skyline_viz.datasets.predictions import open_predictions

    found: list[Predictions] = []
    for text in folders:
        label, equals, place = text.partition("=")
        if not equals or is_address(text) or Path(text).exists():
            label, place = "", text
        here = local(place)
        one = open_predictions(here, items, name=label, sky=truths.sky, terrain=truths.terrain)
        one = replace(lines_with_lost(one, here), source=place)
        if one.name in {other.name for other in found}:
            raise UsageError(
                f"two folders of lines are called {one.name}; give one a label: other={place}."
            )
        if one.extra:
            belong = "belongs" if len(one.extra) == 1 else "belong"
            files = counted(len(one.extra), "file")
            say(f"{one.source}: {files} {belong} to no photo: {listed(one.extra)}.")
        for note in one.notes:
            say(f"{one.source}: {note}")
        found.append(one)
    return found


def about_lines(lines: Predictions) -> dict[str, object]:
    """What a summary says of lines from files."""
    return {
        "source": lines.source,
        "lines": len(lines.lines),
        "belong_to_no_photo": [*lines.extra],
        "notes": [*lines.notes],
    }


def status_after_lines(
    failures: Sequence[Failure], lines: Sequence[Predictions], photos: int
) -> int:
    """List what failed, photos without a line in one sentence, and return the exit status."""
    from skyline_viz.evaluation.tasks import NO_LINE

    missing = False
    for one in lines:
        reason = f"{NO_LINE} {one.name}"
        if names := [failure.name for failure in failures if failure.reason == reason]:
            missing = True
            have = "has" if len(names) == 1 else "have"
            where = one.source or one.name
            say(f"{len(names)} of {photos} photos {have} no line in {where}: {listed(names)}.")
    others = [one for one in failures if not one.reason.startswith(NO_LINE)]
    return status_after(others) or (SOME_FAILED if missing else 0)
