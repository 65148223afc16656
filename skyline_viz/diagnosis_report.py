"""Diagnoses of a data set: which causes cost how much, and what would help, tried out."""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from skyline_viz.causes import CAUSES
from skyline_viz.config import DetectorConfig, EdgeSource
from skyline_viz.detector import Detector, FilterDetection
from skyline_viz.diagnosis import REPAIRED, Diagnosis, diagnose, failing_runs
from skyline_viz.evaluation import Test
from skyline_viz.files import replacing, write_text
from skyline_viz.metrics import column_errors
from skyline_viz.skyline import Skyline, SkylineError

if TYPE_CHECKING:
    from rich.table import Table

_HEADER = (
    "photo", "first", "last", "cause", "contributing", "mean_error", "worst_error", "margin",
    "evidence",
)  # fmt: skip


@dataclass(frozen=True)
class Remedy:
    """What another setting does to a photo."""

    name: str
    """What was set, in words."""

    repaired: int
    """Segments that are right then."""

    broken: int
    """Segments that are wrong only then."""


@dataclass(frozen=True, eq=False)
class Diagnosed:
    """A photo and its diagnosis."""

    name: str
    a_err: float
    """In pixels."""

    diagnosis: Diagnosis
    remedies: tuple[Remedy, ...]
    """Other settings, tried on the photo; nothing unless asked for."""


def diagnose_item(tolerance: float | None, test: Test, *, remedies: bool) -> Diagnosed:
    """Diagnose a photo of a data set.

    Args:
        tolerance: See `diagnosis.diagnose`.
        test: The photo and its detector.
        remedies: Whether to try other settings, too.

    Raises:
        PhotoError: The photo cannot be read.
        SkylineError: Its truth cannot be read, or has another width.
    """
    item = test.item
    truth = item.truth()
    if truth is None:
        raise SkylineError(f"{item.name} has no truth.")
    detection = test.detector.detect(item.photo())
    found = diagnose(detection, truth, tolerance)
    errors = column_errors(detection.skyline, truth)
    tried: tuple[Remedy, ...] = ()
    if remedies and isinstance(detection, FilterDetection):
        tried = try_remedies(detection, truth, found)
    return Diagnosed(item.name, float(np.nanmean(errors)), found, tried)


def settings_to_try(
    config: DetectorConfig, thresholds: tuple[float, float]
) -> dict[str, DetectorConfig]:
    """Other settings that may help, by what they are in words.

    Args:
        config: The settings as they are.
        thresholds: Canny thresholds of the detection.
    """
    low, high = thresholds
    other: EdgeSource = "colour" if config.edge_source == "grey" else "grey"
    return {
        "half the Canny thresholds": replace(
            config, fit_thresholds=False, low_threshold=low / 2, high_threshold=high / 2
        ),
        f"edges of the {other} photo": replace(config, edge_source=other),
        "twice the delta": replace(config, delta=2 * config.delta),
        "half the link weight": replace(config, link_weight=config.link_weight / 2),
        "v less by 0.25": replace(config, v=max(config.v - 0.25, 0.0)),
        "v more by 0.25": replace(config, v=min(config.v + 0.25, 1.0)),
        "half the cost of no edge": replace(config, non_edge_cost=config.non_edge_cost / 2),
    }


def try_remedies(
    detection: FilterDetection, truth: Skyline, found: Diagnosis
) -> tuple[Remedy, ...]:
    """Detect with other settings, and count segments that are right then, or wrong only then."""
    remedies = []
    runs = [segment.columns for segment in found.segments]
    for name, config in settings_to_try(detection.config, detection.thresholds).items():
        again = Detector(detection.bank, config).again(detection)
        wrong = column_errors(again.skyline, truth) > found.tolerance
        repaired = sum(1 - wrong[a : b + 1].mean() >= REPAIRED for a, b in runs)
        new = failing_runs(wrong)
        broken = sum(not any(a <= last and first <= b for a, b in runs) for first, last in new)
        remedies.append(Remedy(name, int(repaired), broken))
    return tuple(remedies)


def table(found: Sequence[Diagnosed]) -> str:
    """Causes: photos, segments, columns, and their share of the error in failing segments."""
    segments = [(one.name, segment) for one in found for segment in one.diagnosis.segments]
    if not segments:
        return "All are right: no column is off by more than the tolerance."
    total = sum(segment.mean_error * segment.length for _, segment in segments)
    rows = []
    for cause in CAUSES:
        mine = [(name, segment) for name, segment in segments if segment.cause == cause]
        if mine:
            error = sum(segment.mean_error * segment.length for _, segment in mine)
            columns = sum(segment.length for _, segment in mine)
            photos = len({name for name, _ in mine})
            rows.append(
                [cause, str(photos), str(len(mine)), f"{columns:,}", f"{error / total:.0%}"]
            )
    wrong = len({name for name, _ in segments})
    right = len(found) - wrong
    head = ["cause", "photos", "segments", "columns", "share of their error"]
    return f"{right} right, {wrong} with wrong segments\n{_drawn(head, rows)}"


def remedies_table(found: Sequence[Diagnosed]) -> str:
    """Other settings, tried on all photos, the one that helps most first."""
    total = sum(len(one.diagnosis.segments) for one in found)
    sums: dict[str, list[int]] = {}
    for one in found:
        for remedy in one.remedies:
            counts = sums.setdefault(remedy.name, [0, 0])
            counts[0] += remedy.repaired
            counts[1] += remedy.broken
    if not total or not sums:
        return ""
    rows = [
        [name, f"{good} of {total}", str(bad)]
        for name, (good, bad) in sorted(sums.items(), key=lambda one: one[1][1] - one[1][0])
    ]
    return "What would help, tried on all photos\n" + _drawn(["setting", "repairs", "breaks"], rows)


def in_full(one: Diagnosed) -> str:
    """Everything about a photo, for a terminal."""
    diagnosis = one.diagnosis
    lines = [f"{one.name}  A_err {one.a_err:.2f} px"]
    if diagnosis.right:
        return f"{lines[0]}\nRight: no column is off by more than {diagnosis.tolerance:g} px."
    for segment in diagnosis.segments:
        first, last = segment.columns
        also = f", with {' and '.join(segment.contributing)}" if segment.contributing else ""
        lines += [
            f"\ncolumns {first} to {last}: {segment.cause}{also}",
            f"  off by {segment.mean_error:.1f} px in the mean, {segment.worst_error:.0f} at worst",
            f"  {segment.evidence}",
        ]
        for trial in segment.trials:
            what = " and ".join(trial.changes)
            lines.append(f"  {what}, {trial.columns} columns: {trial.repaired:.0%} come back")
        stages = [
            f"{name} {segment.truth_cost[name] - paid:+.1f}"
            for name, paid in segment.path_cost.items()
        ]
        lines.append(f"  the truth costs more than the path by: {', '.join(stages)}")
    return "\n".join(lines)


def write_csv(path: str | os.PathLike[str], found: Iterable[Diagnosed]) -> None:
    """Write a line a segment."""
    with replacing(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(_HEADER)
        for one in found:
            for segment in one.diagnosis.segments:
                numbers = (segment.mean_error, segment.worst_error, segment.margin)
                writer.writerow(
                    [one.name, *segment.columns, segment.cause, " ".join(segment.contributing)]
                    + [f"{number:.3f}" for number in numbers]
                    + [segment.evidence]
                )


def write_json(path: str | os.PathLike[str], name: str, found: Iterable[Diagnosed]) -> None:
    """Write everything that is known about each photo."""
    photos = [
        {
            "name": one.name,
            "a_err": one.a_err,
            **one.diagnosis.document(),
            "remedies": [vars(remedy) for remedy in one.remedies],
        }
        for one in found
    ]
    document = {"format": "skyline-diagnosis", "version": 1, "dataset": name, "photos": photos}
    write_text(path, json.dumps(document, indent=1) + "\n")


def _drawn(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    from rich.console import Console  # noqa: PLC0415
    from rich.table import Table  # noqa: PLC0415

    drawn: Table = Table(box=None, pad_edge=False, header_style="bold")
    for number, title in enumerate(head):
        drawn.add_column(title, justify="right" if number else "left")
    for row in rows:
        drawn.add_row(*row)
    console = Console(width=100, highlight=False)
    with console.capture() as captured:
        console.print(drawn)
    return captured.get().rstrip("\n")
