"""Where two detections of a photo part: at which stage, in which column, by which settings and why.

Everything up to the stage at which they part is alike; all after it may differ for that reason
alone. So the first one is the one to look at. Many differences do not matter, though: each is also
counted on the lines, in the columns in which these are apart.

The path is the cheapest line of its own costs, so each detection finds the other one's line dearer.
Whatever changed by most between the two is the term that turned the path, see `Turn`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import Bool, Int
from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.differences import Difference, Kind, differences, same_terms
from skyline_viz.evaluation.metrics import TOLERANCE, column_errors, scaled, wrong_segments
from skyline_viz.skyline import Skyline
from skyline_viz.stage import PATH
from skyline_viz.system.settings import spelt

LEVEL = 0.5
"""Change of A_err up to which a photo is neither better nor worse, in pixels at 519 rows."""

DELTA = "delta"
"""What keeps a detector from a line that is too steep for it."""


@dataclass(frozen=True)
class Part:
    """A stage or a term in which two detections differ."""

    name: str
    """Name of the stage or of the term."""

    kind: Kind
    """Which of both it is."""

    column: int
    """The first column in which they differ."""

    columns: int
    """Number of columns in which they do."""

    largest: float
    """The largest difference, the second less the first; 0 where only one has the stage."""

    unit: str = ""
    """Its unit; nothing for plain numbers."""

    on_lines: tuple[int, ...] = ()
    """Columns in which they differ on one of both lines, of those in which the lines are apart."""

    only: str = ""
    """Name of the detection that alone has the stage; nothing where both have it."""

    @property
    def title(self) -> str:
        """What it is, in words: a stage, or the cost of a term."""
        return Difference(self.name, self.kind, self.unit, None).title


@dataclass(frozen=True)
class Turn:
    """How much a term did to turn the path from the first line to the second."""

    term: str
    """The term, or `DELTA` where a line is too steep for the other detector."""

    first: float
    """What the second line pays for it more than the first, by the costs of the first detector."""

    second: float
    """The same by the costs of the second."""

    @property
    def change(self) -> float:
        """How much it speaks more for the first line with the second detector; below 0 less."""
        return self.second - self.first


@dataclass(frozen=True)
class Setting:
    """A setting that differs."""

    name: str
    """Its name."""

    first: str
    """Its value for the first detector, as it is spelt in names."""

    second: str
    """Its value for the second."""


@dataclass(frozen=True)
class Parting:
    """Where two detections of a photo part."""

    names: tuple[str, str]
    """Names of both."""

    parts: tuple[Part, ...]
    """Stages and terms in which they differ, in the order in which they are made; the path last."""

    settings: tuple[Setting, ...]
    """Settings that differ, of two detectors of ours."""

    apart: tuple[tuple[int, int], ...]
    """First and last column of each run in which the lines are further apart than the tolerance."""

    distance: float
    """Mean distance of the lines, in pixels."""

    furthest: float
    """Their largest distance, in pixels."""

    turns: tuple[Turn, ...] = ()
    """What each term did to turn the path, the one that did most first; none where the lines are
    not apart, or where the costs are not made of the same terms."""

    a_errs: tuple[float, float] | None = None
    """A_err of both; None without a truth."""

    @property
    def at(self) -> Part | None:
        """Where they part first; None where all is alike."""
        return next(iter(self.parts), None)

    @property
    def on_lines(self) -> Part | None:
        """Where they part first on the lines, in the columns in which these are apart."""
        return next((one for one in self.parts if one.on_lines), None)

    @property
    def turned_by(self) -> str:
        """The term that turned the path; nothing where none did."""
        most = next(iter(self.turns), None)
        return most.term if most and (most.change < 0 or most.term == DELTA) else ""

    @property
    def change(self) -> float | None:
        """How much larger A_err of the second is; None without a truth."""
        return None if self.a_errs is None else self.a_errs[1] - self.a_errs[0]


def parting(first: Detection, second: Detection, truth: Skyline | None = None) -> Parting:
    """Find out where two detections of a photo part.

    Args:
        first: A detection.
        second: Another one, of the same photo.
        truth: The true skyline.

    Raises:
        ValueError: The photos have different sizes.
        SkylineError: The truth has another width.
    """
    height = len(first.photo)
    lines = _lines(first, second)
    away = np.abs(lines[1] - lines[0]).astype(np.float64)
    apart: Bool = away > scaled(TOLERANCE, height)
    parts = [part for one in differences(first, second) for part in _part(one, lines, apart)]
    if away.any():
        there = np.flatnonzero(away)
        most = (lines[1] - lines[0])[away.argmax()]
        where = tuple(np.flatnonzero(apart).tolist())
        of_path = int(there[0]), len(there), float(most), PATH.unit.strip()
        parts.append(Part(PATH.name, "stage", *of_path, where))
    return Parting(
        names=(first.method, second.method),
        parts=tuple(parts),
        settings=tuple(settings_apart(first, second)),
        apart=wrong_segments(away, height),
        distance=float(away.mean()),
        furthest=float(away.max()),
        turns=turns(first, second) if apart.any() else (),
        a_errs=_errors(first, second, truth),
    )


def settings_apart(first: Detection, second: Detection) -> Iterator[Setting]:
    """Settings that differ of two detectors of ours, and what else they are made of.

    The sky model counts as none where it was not run. Nothing is known of the settings of other
    methods but their names.
    """
    if not isinstance(first, FilterDetection) or not isinstance(second, FilterDetection):
        return
    told = [dict(one.detector.settings()) for one in (first, second)]
    for one, settings in zip((first, second), told, strict=True):
        if one.sky is None:
            settings["sky"] = "none"
    for name in dict.fromkeys([*told[0], *told[1]]):
        values = [settings.get(name, "none") for settings in told]
        if values[0] != values[1]:
            yield Setting(name, *map(spelt, values))
    used = [" and ".join(f"{one:.0f}" for one in found.thresholds) for found in (first, second)]
    if first.thresholds != second.thresholds:
        yield Setting("Canny thresholds used", *used)
    if not np.array_equal(first.bank.filters, second.bank.filters):
        made = [one.bank.provenance.dataset or "unknown photos" for one in (first, second)]
        other = " (other filters)" if made[0] == made[1] else ""
        yield Setting("filters learned from", made[0], made[1] + other)


def turns(first: Detection, second: Detection) -> tuple[Turn, ...]:
    """What each term did to turn the path from one line to the other, the most first.

    `DELTA` is before all terms where it alone decides: where a line is cheaper than its own for a
    detector that may not take it.

    Args:
        first: A detection.
        second: Another one, of the same photo.
    """
    if not same_terms(first, second):
        return ()
    lines = _lines(first, second)
    apart = [_second_less_first(one, *lines) for one in (first, second)]
    found = sorted(
        (Turn(one, apart[0][one], apart[1][one]) for one in apart[0]), key=lambda one: one.change
    )
    steep = [np.abs(np.diff(line)).max(initial=0) for line in lines]
    kept_from_second = steep[1] > first.delta and sum(one.first for one in found) < 0
    kept_from_first = steep[0] > second.delta and sum(one.second for one in found) > 0
    if kept_from_first or kept_from_second:
        return (Turn(DELTA, 0.0, 0.0), *found)
    return tuple(found)


def _lines(*both: Detection) -> list[Int]:
    """``(W,)`` row of the pixel of each line in each column."""
    height = len(both[0].photo)
    return [one.skyline.pixel_rows(height).clip(0, height - 1).astype(np.int32) for one in both]


def _second_less_first(detection: Detection, first: Int, second: Int) -> dict[str, float]:
    """How much more the second line pays than the first, term by term."""
    model = detection.cost_model
    one, other = model.split(first), model.split(second)
    return {name: float(other[name].sum() - one[name].sum()) for name in one}


def _part(one: Difference, lines: list[Int], apart: Bool) -> Iterator[Part]:
    """What there is to say of a map; nothing where it is alike."""
    if one.only:
        yield Part(one.name, one.kind, 0, len(apart), 0.0, one.unit, only=one.only)
        return
    differs, values = one.apart, one.values
    assert differs is not None and values is not None
    columns = np.flatnonzero(differs.any(axis=0))
    if not len(columns):
        return
    places = np.arange(len(apart))
    on_lines = np.logical_or.reduce([differs[rows, places] for rows in lines]) & apart
    sizes = np.nan_to_num(np.abs(values), nan=0.0, posinf=np.inf)
    row, column = np.unravel_index(int(sizes.argmax()), sizes.shape)
    yield Part(
        one.name,
        one.kind,
        int(columns[0]),
        len(columns),
        float(values[row, column]),
        one.unit,
        tuple(np.flatnonzero(on_lines).tolist()),
    )


def _errors(
    first: Detection, second: Detection, truth: Skyline | None
) -> tuple[float, float] | None:
    """A_err of both; None without a truth that is visible somewhere."""
    if truth is None or not truth.visible.any():
        return None
    one, other = (
        float(np.nanmean(column_errors(found.skyline, truth))) for found in (first, second)
    )
    return one, other
