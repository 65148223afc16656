"""Gestures of a robot that labels like a person, on sources that its detector has not seen.

It looks at the whole photo. Where the line is wrong over a wide span it begins with a guide,
roughly along the truth; else it clicks. After that it clicks the worst column, until the line is
good.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import process_time

import numpy as np

from annotate.engine.guide import thinned
from annotate.engine.live_wire import LiveWire
from annotate.engine.opinions import opinions
from benchmarks.left_out import LeftOut, Models, Variant
from benchmarks.sources import RENDERED, Source, sources
from benchmarks.table import markdown
from skyline_viz import Detector, DetectorConfig, Skyline
from skyline_viz.arrays import F64, runs
from skyline_viz.constraints import PathError
from skyline_viz.evaluation.metrics import column_errors
from testing.labelling import hills

GOAL = 0.01  # A_err at which the robot stops, as a part of the height
MOST = 15  # gestures after which it gives up
WIDE = 0.1  # part of the width from which on a wrong span is worth a guide, and a gap ends it
STAGE = 1166, 661  # width and height of the photo's place on a page of 1440x900
HAND = 8  # screen pixels: radius of a guide
ROUGH = 4  # screen pixels to which a guide follows the truth
SNAP = 4  # screen pixels to which a click with noise snaps
NOISES = 0, 4  # screen pixels by which the hand is off, one standard deviation
GROSS = 0.05  # A_err of a gross miss, as a part of the height


@dataclass(frozen=True)
class Hand:
    """A hand at a photo that is shown whole."""

    scale: float
    """Screen pixels a pixel of the photo."""

    noise: float
    """Standard deviation, in screen pixels."""

    chance: np.random.Generator

    def at(self, pixel: Iterable[float], wire: LiveWire) -> tuple[int, int]:
        """Where it comes down that aims at a pixel."""
        column, row = np.asarray(pixel) + self.chance.normal(0, self.noise / self.scale, 2)
        return (
            int(np.clip(round(column), 0, wire.width - 1)),
            int(np.clip(round(row), 0, wire.height - 1)),
        )

    def pixels(self, screen: float) -> int:
        """Pixels of the photo, from pixels of the screen."""
        return max(round(screen / self.scale), 1)


def gestures(wire: LiveWire, truth: Skyline, hand: Hand) -> int:
    """Number of gestures until the line is good."""
    for count in range(MOST):
        errors = column_errors(wire.skyline, truth)
        if np.nanmean(errors) <= GOAL * wire.height:
            return count
        if count or not guided(wire, truth, hand, errors):
            column = int(np.nanargmax(errors))
            aim = hand.at((column, truth.rows[column]), wire)
            wire.anchor(*aim, within=hand.pixels(SNAP) if hand.noise else 0)
    return MOST


def guided(wire: LiveWire, truth: Skyline, hand: Hand, errors: F64) -> bool:
    """Whether a guide was led along the truth where the line is wrong over a wide span."""
    wrong = runs(np.nan_to_num(errors) > GOAL * wire.height, gap=round(WIDE * wire.width))
    first, last = max(wrong, key=lambda run: np.nansum(errors[run[0] : run[1] + 1]), default=(0, 0))
    if last - first < WIDE * wire.width:
        return False
    beyond = wire.width // 50
    first, last = max(first - beyond, 0), min(last + beyond, wire.width - 1)
    rows = truth.pixel_rows(wire.height)[first : last + 1].astype(np.int32)
    points = thinned(first, rows, ROUGH / hand.scale)
    try:
        wire.guide([hand.at(point, wire) for point in points], hand.pixels(HAND))
    except PathError:
        return False
    return True


def measured(data: Path, folder: Path | None) -> str:
    """The tables.

    Args:
        data: Folder of the real data sets.
        folder: Folder of sky models that have not seen a source.
    """
    models = Models(folder)
    everything = sources(data)
    left_out = LeftOut(everything)
    given = [one for one in everything if one.place != RENDERED]
    given = [replace(one, items=one.items[::3]) if one.clips else one for one in given]
    told, held = [], []
    total: dict[int, list[int]] = {noise: [] for noise in NOISES}
    for source in given:
        detector = left_out.detector(Variant("default", DetectorConfig(), models), source.place)
        if detector is None:
            continue
        counts = {noise: _counts(source, detector, noise) for noise in NOISES}
        told.append([source.name, *_row(counts)])
        for noise, found in counts.items():
            total[noise] += found
    told.append(["all", *_row(total)])
    for name, config in (("default", DetectorConfig()), ("`paper()`", DetectorConfig.paper())):
        near = [
            off
            for source in given
            if (detector := left_out.detector(Variant(name, config, models), source.place))
            and (sky := models(source.place))  # for second opinions, where the detector has none
            for off in _nearest(source, replace(detector, sky=sky))
        ]
        shares = [str(sum(one <= part for one in near)) for part in (0.01, 0.02)]
        held.append([name, str(len(near)), *shares])
    noises = [f"noise {noise} px: mean, 90 %, most" for noise in NOISES]
    return (
        "## Gestures of a robot, with whole sources left out\n\n"
        "It stops at an A_err of 1 % of the height. Where more than a tenth of the width is wrong "
        "(gaps of less count) it begins with a guide, else with a click, and goes on with "
        "clicks.\n\n"
        f"{markdown(['source', 'photos', *noises, 'over 4'], told)}\n\n"
        "Gross misses, and in how many the truth is among the four numbered lines:\n\n"
        f"{markdown(['detector', 'gross misses', 'within 1 % of the height', 'within 2 %'], held)}"
        "\n\nProcessor time of the preview of a guide, at each point of a stroke across the photo:"
        f"\n\n{previews()}\n"
    )


def _counts(source: Source, detector: Detector, noise: float) -> list[int]:
    """Gestures on each photo of a source."""
    found = []
    for seed, item in enumerate(source.items):
        wire = LiveWire(item.photo(), detector)
        scale = min(STAGE[0] / wire.width, STAGE[1] / wire.height)
        found.append(gestures(wire, item.truth(), Hand(scale, noise, np.random.default_rng(seed))))
    return found


def _row(counts: dict[int, list[int]]) -> list[str]:
    """Cells of a source."""
    figures = [
        f"{np.mean(one):.2f}, {np.percentile(one, 90):.0f}, {max(one)}" for one in counts.values()
    ]
    over = ", ".join(str(sum(count > 4 for count in one)) for one in counts.values())
    return [str(len(counts[0])), *figures, over]


def _nearest(source: Source, detector: Detector) -> list[float]:
    """Of each gross miss: A_err of the best of the numbered lines, as a part of the height."""
    found = []
    for item in source.items:
        photo, truth = item.photo(), item.truth()
        wire = LiveWire(photo, detector)
        if np.nanmean(column_errors(wire.skyline, truth)) > GROSS * wire.height:
            second = opinions(detector, photo)
            lines = [Skyline(rows=one.rows) for one in wire.alternatives(second)]
            errors = [np.nanmean(column_errors(one, truth)) for one in lines]
            found.append(min(errors, default=np.inf) / wire.height)
    return found


def previews(sizes: Sequence[tuple[int, int]] = ((1024, 1024), (3024, 4032))) -> str:
    """Processor time of a preview of a guide while it grows, on photos of some sizes."""
    rows = []
    for height, width in sizes:
        wire = LiveWire(hills(1, height, width), Detector())
        wire.refresh()
        line, spent = wire.skyline.rows.astype(int), []
        points = [(at, int(line[at]) + height // 20) for at in range(0, width, width // 80)]
        wire.preview_guide(points[:2])
        for count in range(2, len(points)):
            start = process_time()
            wire.preview_guide(points[:count])
            spent.append((process_time() - start) * 1000)
        middle, late = np.percentile(spent, [50, 95])
        rows.append([f"{width}x{height}", f"{middle:.1f}", f"{late:.1f}"])
    return markdown(["photo", "median, ms", "95th percentile, ms"], rows)
