"""Lines that are carried over to the next photo of a sequence, with whole sources left out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from annotate.engine.carried import AGREEING, motion_between, moved_line, stroke_along
from annotate.engine.live_wire import LiveWire
from benchmarks.left_out import LeftOut, Models, Variant
from benchmarks.sources import RENDERED, Source, sources
from benchmarks.table import markdown
from skyline_viz import Detector, DetectorConfig
from skyline_viz.arrays import Int
from skyline_viz.constraints import PathError
from skyline_viz.datasets.item import Item
from skyline_viz.evaluation.metrics import column_errors
from skyline_viz.photo import read_photo

GROSS = 0.05  # A_err of a gross miss, as a part of the height
FAR = 0.02  # A_err from which on a line that was carried over is a bad one, likewise
NUMBERS = range(8, 41)  # least numbers of agreeing points that are tried


@dataclass(frozen=True, eq=False)
class Pair:
    """A photo whose neighbour before it, by name, has a line to be carried over."""

    item: Item
    group: str
    agreeing: int
    """Points that agree on how the scene has moved."""

    first: int
    rows: Int
    """The line, where it is carried to."""

    @property
    def off(self) -> float:
        """A_err of the line before it snaps, as a part of the height."""
        truth, columns = self.item.truth(), slice(self.first, self.first + len(self.rows))
        errors = np.abs(self.rows - truth.rows[columns])[truth.visible[columns]]
        return float(errors.mean() / len(self.item.photo())) if len(errors) else 0.0


def measured(data: Path, folder: Path | None) -> str:
    """The tables.

    Args:
        data: Folder of the real data sets.
        folder: Folder of sky models that have not seen a source.
    """
    everything, models = sources(data), Models(folder)
    left_out = LeftOut(everything)
    overlaps, proposals, choices = [], [], ""
    for source in everything:
        if source.place == RENDERED:
            continue
        pairs = _pairs(source)
        enough = [one for one in pairs if one.agreeing >= AGREEING]
        bad = sum(one.off > FAR for one in enough)
        overlaps.append([source.name, str(len(source.items) - 1), str(len(enough)), str(bad)])
        if source.clips:
            choices = _choices(pairs)
        detector = left_out.detector(Variant("default", DetectorConfig(), models), source.place)
        if detector and enough:
            proposals.append([source.name, *_proposed(enough, detector)])
    return (
        "## Lines carried over to the next photo, with whole sources left out\n\n"
        "The truth of each photo is carried over to the next one by name, if they are as large. "
        f"At least {AGREEING} points have to agree. A line is bad that lies more than 2 % of the "
        "height beside the truth, before it snaps.\n\n"
        f"{markdown(['source', 'neighbours', 'carried over', 'bad'], overlaps)}\n\n"
        f"{choices}\n\n"
        "Proposals of the photos to which a line is carried: A_err in pixels, mean and median, and "
        "gross misses.\n\n"
        + markdown(
            ["source", "photos", "detector", "gross", "carried over", "gross", "worse by 1 px"],
            proposals,
        )
        + f"\n\n{_standing(data / 'webcam' / 'images')}"
    )


def _pairs(source: Source) -> list[Pair]:
    """Neighbours of which at least a few points agree."""
    found = []
    items = sorted(zip(source.items, source.groups, strict=True), key=lambda one: one[0].name)
    for (before, _), (item, group) in pairwise(items):
        photo, ours = before.photo(), item.photo()
        if photo.shape != ours.shape:
            continue
        motion, agreeing = motion_between(photo, before.truth(), ours)
        if motion is None or agreeing < NUMBERS[0]:
            continue
        moved = moved_line(before.truth(), motion, len(ours))
        if moved is not None:
            found.append(Pair(item, group, agreeing, *moved))
    return found


def _standing(folder: Path) -> str:
    """How far a line moves that is carried over between photos of a camera that stands still."""
    photos = [read_photo(path) for path in sorted(folder.iterdir())]
    lines = [Detector().detect(photo).skyline for photo in photos]
    moves = []
    for (before, line), photo in zip(zip(photos, lines, strict=True), photos[1:], strict=False):
        motion, agreeing = motion_between(before, line, photo)
        moved = moved_line(line, motion, len(photo)) if motion is not None else None
        if moved and agreeing >= AGREEING:
            first, rows = moved
            moves.append(float(np.abs(rows - line.rows[first : first + len(rows)]).mean()))
    own = [np.abs(b.rows - a.rows).mean() for a, b in pairwise(lines)]
    return (
        f"A webcam that stands still, {len(photos)} photos by day and dusk over two years: the "
        f"detector's line is carried over to {len(moves)} of {len(own)} neighbours, and is moved "
        f"by {np.mean(moves):.1f} px in the mean and {max(moves):.1f} at the most. The lines that "
        f"are detected in two neighbours differ by {np.mean(own):.1f} px in the mean."
    )


def _choices(pairs: Sequence[Pair]) -> str:
    """Least numbers of agreeing points with which nothing bad is carried in all clips but one."""
    groups = dict.fromkeys(one.group for one in pairs)
    off = {id(one): one.off for one in pairs}
    chosen, bad = [], 0
    for group in groups:
        others = [one for one in pairs if one.group != group]
        least = next(
            number
            for number in NUMBERS
            if not any(one.agreeing >= number and off[id(one)] > FAR for one in others)
        )
        chosen.append(least)
        own = [one for one in pairs if one.group == group and one.agreeing >= least]
        bad += sum(off[id(one)] > FAR for one in own)
    return (
        f"The least number with which no bad line is carried, chosen with one of {len(groups)} "
        f"clips left out at a time, is {min(chosen)} to {max(chosen)}. In the clips left out "
        f"{bad} bad lines are carried with it."
    )


def _proposed(pairs: Sequence[Pair], detector: Detector) -> list[str]:
    """Cells of a source: proposals of the detector, and those that are carried over."""
    own, carried, gross = [], [], [0, 0]
    for one in pairs:
        photo, truth = one.item.photo(), one.item.truth()
        wire = LiveWire(photo, detector)
        own.append(float(np.nanmean(column_errors(wire.skyline, truth))))
        stroke = stroke_along(one.first, one.rows, len(photo))
        try:
            line = wire.preview_guide(stroke.points, stroke.radius)
        except PathError:  # the proposal stays that of the detector
            line = wire.skyline
        carried.append(float(np.nanmean(column_errors(line, truth))))
        for place, errors in enumerate((own, carried)):
            gross[place] += errors[-1] > GROSS * len(photo)
    told = [f"{np.mean(errors):.2f}, {np.median(errors):.2f}" for errors in (own, carried)]
    worse = sum(after > before + 1 for before, after in zip(own, carried, strict=True))
    return [str(len(pairs)), told[0], str(gross[0]), told[1], str(gross[1]), str(worse)]
