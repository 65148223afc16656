"""Diagnoses of a data set: which causes cost how much, and what would help, tried out."""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from skyline_viz.config import DetectorConfig, EdgeSource
from skyline_viz.detector import Detector, FilterDetection
from skyline_viz.diagnosis.causes import CAUSES
from skyline_viz.diagnosis.counterfactual import REPAIRED, Case
from skyline_viz.diagnosis.diagnosing import Diagnosis, diagnose, failing_runs
from skyline_viz.evaluation.cross_validation import Test
from skyline_viz.evaluation.metrics import column_errors
from skyline_viz.files import replacing, write_text
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.system.names import printable

if TYPE_CHECKING:
    from rich.table import Table

_GROWN = 1.5  # times its length from which on a segment is broken
_HEADER = (
    "photo", "first", "last", "cause", "contributing", "mean_error", "worst_error",
    "total_error", "margin", "evidence",
)  # fmt: skip


@dataclass(frozen=True)
class Remedy:
    """What another setting does to a photo."""

    name: str
    """What was set, in words, and how on the command line where it is the same for all photos."""

    repaired: int
    """Segments that are right then."""

    broken: int
    """Segments that are wrong only then, or longer by more than half."""

    change: float
    """Change of the photo's A_err, in pixels; negative is better."""


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
    halved = replace(config, fit_thresholds=False, low_threshold=low / 2, high_threshold=high / 2)
    settings = {
        "half the Canny thresholds": halved,
        f"edges of the {other} photo": replace(config, edge_source=other),
        "twice the delta": replace(config, delta=2 * config.delta),
        "half the link weight": replace(config, link_weight=config.link_weight / 2),
        "v less by 0.25": replace(config, v=max(config.v - 0.25, 0.0)),
        "v more by 0.25": replace(config, v=min(config.v + 0.25, 1.0)),
        "half the cost of no edge": replace(config, non_edge_cost=config.non_edge_cost / 2),
    }
    return {
        f"{name}{_flags(config, changed)}": changed
        for name, changed in settings.items()
        if changed != config
    }


def _flags(config: DetectorConfig, changed: DetectorConfig) -> str:
    """The flags that change settings; nothing where each photo has values of its own."""
    if config.fit_thresholds != changed.fit_thresholds:
        return ""
    named = [one.name for one in fields(config)]
    flags = [
        f"--config.{name.replace('_', '-')} {_value(getattr(changed, name))}"
        for name in named
        if getattr(config, name) != getattr(changed, name)
    ]
    return f" ({' '.join(flags)})"


def _value(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def try_remedies(
    detection: FilterDetection, truth: Skyline, found: Diagnosis
) -> tuple[Remedy, ...]:
    """Detect with other settings, and count segments that are right then, or wrong only then."""
    case = Case(detection, truth, found.tolerance)
    before = float(np.nanmean(case.errors))
    runs = [segment.columns for segment in found.segments]
    remedies = []
    for name, config in settings_to_try(detection.config, detection.thresholds).items():
        skyline = Detector(detection.bank, config).again(detection).skyline
        errors = column_errors(skyline, truth)
        rows = skyline.rows.astype(np.int32)
        repaired = sum(case.repaired(0, rows, *run) >= REPAIRED for run in runs)
        broken = sum(_broken(run, runs) for run in failing_runs(errors > found.tolerance))
        remedies.append(Remedy(name, repaired, broken, float(np.nanmean(errors)) - before))
    return tuple(remedies)


def _broken(new: tuple[int, int], runs: Sequence[tuple[int, int]]) -> bool:
    """Whether a run is new, or has grown by more than half."""
    before = sum(last - first + 1 for first, last in runs if first <= new[1] and new[0] <= last)
    return new[1] - new[0] + 1 > _GROWN * before


def table(found: Sequence[Diagnosed]) -> str:
    """Causes: photos, segments, columns, and their share of the error in failing segments."""
    segments = [(one.name, segment) for one in found for segment in one.diagnosis.segments]
    if not segments:
        return "All are right: no column is off by more than the tolerance."
    total = sum(segment.total_error for _, segment in segments)
    rows = []
    for cause in CAUSES:
        mine = [(name, segment) for name, segment in segments if segment.cause == cause]
        if mine:
            error = sum(segment.total_error for _, segment in mine)
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
    """Other settings, tried on all photos, the one that helps most first; nothing without need."""
    total = sum(len(one.diagnosis.segments) for one in found)
    tried: dict[str, list[Remedy]] = {}
    for one in found:
        for remedy in one.remedies:
            tried.setdefault(remedy.name, []).append(remedy)
    if not total or not tried:
        return ""
    sums = [
        (
            name,
            sum(one.repaired for one in remedies),
            sum(one.broken for one in remedies),
            float(np.mean([one.change for one in remedies])),
        )
        for name, remedies in tried.items()
    ]
    sums.sort(key=lambda one: (one[2] - one[1], one[3]))
    rows = [
        [name, f"{good} of {total}", str(bad), f"{change:+.2f} px"]
        for name, good, bad, change in sums
    ]
    head = ["setting", "repairs", "breaks", "A_err changes by"]
    lines = ["What would help, tried on all photos", _drawn(head, rows)]
    if not any(good for _, good, _, _ in sums):
        lines.append("None of these helps: no wrong segment is repaired.")
    return "\n".join(lines)


def in_full(one: Diagnosed) -> str:
    """Everything about a photo, for a terminal."""
    diagnosis = one.diagnosis
    lines = [f"{printable(one.name)}  A_err {one.a_err:.2f} px"]
    if diagnosis.right:
        return f"{lines[0]}\n{diagnosis.said_right}"
    for segment in diagnosis.by_error:
        first, last = segment.columns
        also = f", with {' and '.join(segment.contributing)}" if segment.contributing else ""
        lines += [
            f"\ncolumns {first} to {last}: {segment.cause}{also}",
            f"  off by {segment.mean_error:.1f} px in the mean, {segment.worst_error:.0f} at worst",
            f"  {segment.evidence}",
        ]
        for trial in segment.trials:
            what = " and ".join(trial.changes)
            if trial.lines:
                what += f" ({trial.lines} {'line' if trial.lines == 1 else 'lines'} taken away)"
            lines.append(f"  {what}, {trial.columns} columns: {trial.repaired:.0%} come back")
        stages = [
            f"{name} {segment.truth_cost[name] - paid:+.1f}"
            for name, paid in segment.path_cost.items()
        ]
        lines.append(f"  the truth costs more than the path by: {', '.join(stages)}")
    return "\n".join(lines)


def write_csv(path: str | os.PathLike[str], found: Iterable[Diagnosed]) -> None:
    """Write a line a segment."""
    with (
        replacing(path) as temporary,
        temporary.open("w", newline="", encoding="utf-8", errors="backslashreplace") as file,
    ):
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(_HEADER)
        for one in found:
            for segment in one.diagnosis.segments:
                numbers = (
                    segment.mean_error,
                    segment.worst_error,
                    segment.total_error,
                    segment.margin,
                )
                writer.writerow(
                    [one.name, *segment.columns, segment.cause, "; ".join(segment.contributing)]
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
    write_text(path, json.dumps(document, indent=1, allow_nan=False) + "\n")


def write_photo(folder: str | os.PathLike[str], dataset: str, one: Diagnosed) -> tuple[Path, Path]:
    """Write the diagnosis of one photo, as JSON and in Markdown; return the files."""
    stem = Path(folder) / one.name
    stem.parent.mkdir(parents=True, exist_ok=True)
    document, text = (stem.with_name(f"{stem.name}.{kind}") for kind in ("json", "md"))
    write_json(document, dataset, [one])
    write_text(text, one.diagnosis.markdown(one.name).rstrip("\n") + "\n")
    return document, text


def _drawn(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    from rich.console import Console  # noqa: PLC0415
    from rich.table import Table  # noqa: PLC0415

    drawn: Table = Table(box=None, pad_edge=False, header_style="bold")
    for number, title in enumerate(head):
        drawn.add_column(title, justify="right" if number else "left")
    for row in rows:
        drawn.add_row(*row)
    console = Console(width=100, highlight=False, color_system=None)
    with console.capture() as captured:
        console.print(drawn)
    return captured.get().rstrip("\n")
