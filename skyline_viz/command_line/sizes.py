"""What is said about the sizes of photos before work on them begins."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, TypeAlias

import tyro

from skyline_viz.command_line.messages import UsageError, counted, say
from skyline_viz.system.memory import (
    DETECTING,
    available,
    fitting_workers,
    in_words,
    limit_photos,
    needed,
    photo_limit,
)
from skyline_viz.system.names import listed

if TYPE_CHECKING:
    from skyline_viz.datasets.dataset import DatasetItem

MaxMegapixels: TypeAlias = Annotated[float, tyro.conf.arg(metavar="N")]
"""Limit on the photos that are read, in million pixels."""


def limit(megapixels: float) -> None:
    """Refuse larger photos in this process and its workers from now on.

    Raises:
        UsageError: No positive number.
    """
    if not 0 < megapixels < float("inf"):
        raise UsageError(f"--max-megapixels is a number above 0, not {megapixels:g}.")
    limit_photos(megapixels)


def pixels_of(items: Iterable[DatasetItem]) -> list[tuple[DatasetItem, int]]:
    """Photos and their pixels, where the header of a file or a table tells them."""
    from skyline_viz.photo import PhotoError

    found = []
    for item in items:
        try:
            size = item.size()
        except PhotoError:
            continue  # told when its turn comes
        if size is not None:
            found.append((item, size[0] * size[1]))
    return found


def foresee(items: Iterable[DatasetItem], workers: int = 1, bytes_a_pixel: int = DETECTING) -> int:
    """Say which photos are too large to be read or to fit into memory; choose the workers.

    Args:
        items: Photos to work on.
        workers: Processes that were asked for; 0 chooses by the number of photos.
        bytes_a_pixel: What the work takes, see `skyline_viz.memory`.

    Returns:
        Processes to work in: fewer than usual where they were to be chosen, and would not fit.
    """
    from skyline_viz.running.batch import chosen_workers

    found = pixels_of(items)
    most = photo_limit() * 1e6
    say_too_large([item.name for item, pixels in found if pixels > most])
    sizes = [pixels for _, pixels in found if pixels <= most]
    planned = chosen_workers(workers, len(found) or 1)
    if not sizes:
        return workers
    largest, free = max(sizes), available()
    fit = fitting_workers(planned, largest, bytes_a_pixel, free)
    each = needed(largest, bytes_a_pixel)
    if free is None or planned * each <= free:
        return workers
    need = f"{counted(len(sizes), 'photo')} of up to {largest / 1e6:.0f} megapixels need about"
    if planned == 1:
        say(f"{need} {in_words(each)} of memory, and {in_words(free)} are free.")
    elif workers:
        say(
            f"{need} {in_words(planned * each)} with {planned} workers, and {in_words(free)} are "
            f"free; --workers {fit} fits better."
        )
    else:
        say(f"{need} {in_words(each)} each, so there are {fit} workers and not {planned}.")
    return workers or fit


def say_too_large(names: list[str], program: str = "skyline-viz") -> None:
    """Say which photos are over the limit."""
    if names:
        are = "is" if len(names) == 1 else "are"
        say(
            f"{listed(names)} {are} over the limit of {photo_limit():g} megapixels, and will not "
            "be read; --max-megapixels raises it.",
            program,
        )
