"""Diagnoses of a data set, told: which causes cost how much, and what would help."""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from pathlib import Path

from rich.table import Table

from skyline_viz.diagnosis.by_cause import Mended, by_cause
from skyline_viz.diagnosis.edges_anew import FACTORS
from skyline_viz.diagnosis.record import Diagnosed
from skyline_viz.diagnosis.remedies import best, ranked
from skyline_viz.diagnosis.worth import waits, worths
from skyline_viz.evaluation.terminal import drawn
from skyline_viz.files import replacing, write_text
from skyline_viz.system.names import printable

_HEADER = (
    "photo", "first", "last", "cause", "contributing", "mean_error", "worst_error",
    "total_error", "margin", "evidence", "terms", "place", "begins",
)  # fmt: skip

SHOWN = 5
"""So many remedies are told of one photo."""


def table(found: Sequence[Diagnosed]) -> str:
    """Causes with their places: photos, segments, columns, and what they cost."""
    causes = by_cause(found)
    if not causes:
        return "All are right: no column is off by more than the tolerance."
    total = sum(one.error for one in causes)
    rows = []
    for one in causes:
        counts = str(one.photos), str(one.segments), f"{one.columns:,}"
        rows.append([one.title, *counts, f"{one.error / total:.0%}", f"{one.a_err:.2f} px"])
    wrong = sum(not one.diagnosis.right for one in found)
    head = ["cause", "photos", "segments", "columns", "share of their error", "A_err"]
    return f"{len(found) - wrong} right, {wrong} with wrong segments\n{_drawn(head, rows)}"


def remedies_table(found: Sequence[Diagnosed]) -> str:
    """Other settings, tried on all photos: those that help, and the best one of each cause."""
    total = sum(len(one.diagnosis.segments) for one in found)
    tried = worths(found)
    if not total:
        return ""
    if not any(one.remedies for one in found):
        blips = all(waits(one.a_err, one.diagnosis) for one in found)
        return "No other setting was tried: no photo is wrong by more than blips." if blips else ""
    if not tried:
        return (
            "None of the settings that were tried on wrong photos makes their mean A_err smaller."
        )
    rows = [
        [
            one.name,
            f"{one.change:+.2f} px",
            str(one.saved),
            str(one.lost),
            f"{one.repaired} of {total}",
            str(one.broken),
        ]
        for one in tried
    ]
    head = ["setting", "A_err", "gross mended", "made", "repairs", "breaks"]
    lines = [
        "What would help, tried on all photos: change of their mean A_err, gross misses that are",
        "none then and that are made, wrong segments that are repaired and broken",
        _drawn(head, rows),
    ]
    if all(one.change >= 0 for one in tried):
        lines.append("None of these helps: the mean A_err gets no smaller.")
    head = ["cause", "photos", "A_err", "best remedy", "of these", "of all", "breaks", "misses"]
    rows = [
        [one.title, str(one.photos), f"{one.a_err:.2f} px", *_helping(one.remedy)]
        for one in by_cause(found)
    ]
    lines += [
        "What would help most of each cause: change of the A_err of the photos whose main cause it "
        "is,",
        "and of all photos; segments that are broken by it, and gross misses that are made, in all",
        _drawn(head, rows),
    ]
    return "\n".join(lines)


def _helping(most: Mended | None) -> list[str]:
    """What the table of causes says of a remedy."""
    if most is None:
        return ["none helps", "", "", "", ""]
    changes = f"{most.change:+.2f} px", f"{most.change_of_all:+.2f} px"
    return [most.name, *changes, str(most.broken), str(most.misses)]


def write_picture(path: str | os.PathLike[str], name: str, found: Sequence[Diagnosed]) -> None:
    """Draw what each cause costs, with what its best remedy changes, see `cause_bars`."""
    from skyline_viz.evaluation.cause_bars import CauseBar, write_cause_bars  # noqa: PLC0415  # half a second

    bars = []
    for one in by_cause(found):
        said, most = "no setting helps", one.remedy
        if most:
            said = f"{most.name}: {most.change:+.2f} px on these, {most.change_of_all:+.2f} on all"
            said += f", breaks {most.broken}"
        bars.append(CauseBar(one.title, one.photos, one.a_err, said))
    seen = sum(bool(one.seen) for one in found)
    title = f"{name}, {seen} of {len(found)} photos seen in training" if seen else name
    write_cause_bars(path, bars, title)


def in_full(one: Diagnosed) -> str:
    """Everything about a photo, for a terminal."""
    diagnosis = one.diagnosis
    seen = f"  seen in training ({one.seen})" if one.seen else ""
    lines = [f"{printable(one.name)}  A_err {one.a_err:.2f} px{seen}"]
    if diagnosis.right:
        return f"{lines[0]}\n{diagnosis.said_right}"
    for segment in diagnosis.by_error:
        first, last = segment.columns
        also = f", with {' and '.join(segment.contributing)}" if segment.contributing else ""
        lines += [
            f"\ncolumns {first} to {last}: {segment.title}{also}",
            f"  off by {segment.mean_error:.1f} px in the mean, {segment.worst_error:.0f} at worst",
            *(f"  {found}" for found in segment.findings),
        ]
        for trial in segment.trials:
            what = " and ".join(trial.changes)
            if trial.thresholds != 1:
                what = f"edges found anew with {FACTORS[trial.thresholds]} Canny thresholds"
            if trial.terms:
                which = "1 line" if trial.lines == 1 else f"{trial.lines} lines"
                what += f" ({' and '.join(trial.terms)} as cheap as of {which})"
            lines.append(f"  {what}, {trial.columns} columns: {trial.repaired:.0%} come back")
        stages = [
            f"{name} {segment.truth_cost[name] - paid:+.1f}"
            for name, paid in segment.path_cost.items()
        ]
        lines.append(f"  the truth costs more than the path by: {', '.join(stages)}")
    return "\n".join([*lines, *_remedies_of(one)])


def _remedies_of(one: Diagnosed) -> list[str]:
    """The remedies that help a photo most, and how to get the best one."""
    helps = best(one.remedies)
    if helps is None:
        return ["\nNo other setting that was tried helps."] if one.remedies else []
    rows = [
        [
            remedy.name,
            f"{remedy.a_err:.2f} px",
            f"{remedy.change:+.2f} px",
            "yes" if remedy.gross_miss else "no",
            str(remedy.repaired),
            str(remedy.broken),
        ]
        for remedy in ranked(one.remedies)[:SHOWN]
        if remedy.change < 0
    ]
    head = ["setting", "A_err", "change", "gross miss", "repairs", "breaks"]
    return ["\nWhat would help most", _drawn(head, rows), f"For the best: add {helps.flags}"]


def said_worth(one: Diagnosed) -> list[str]:
    """The remedies that help a photo most, a line each, in Markdown."""
    gross = "still a gross miss" if one.gross_miss else "a gross miss then"
    return [
        f"{remedy.name}: A_err {remedy.a_err:.2f} px, {remedy.change:+.2f} px"
        f"{f', {gross}' if remedy.gross_miss else ''}; add `{remedy.flags}`"
        for remedy in ranked(one.remedies)[:SHOWN]
        if remedy.change < 0
    ]


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
                    + [segment.evidence, "; ".join(segment.terms), segment.place or ""]
                    + [str(segment.begins)]
                )


def write_json(path: str | os.PathLike[str], name: str, found: Sequence[Diagnosed]) -> None:
    """Write everything that is known about each photo."""
    photos = [
        {
            "name": one.name,
            "a_err": one.a_err,
            "gross_miss": one.gross_miss,
            "seen": one.seen,
            **one.diagnosis.document(),
            "remedies": [vars(remedy) for remedy in ranked(one.remedies)],
        }
        for one in found
    ]
    causes = [asdict(one) for one in by_cause(found)]
    head = {"format": "skyline-diagnosis", "version": 1, "dataset": name}
    remedies = [asdict(one) for one in worths(found)]
    document = {**head, "causes": causes, "remedies": remedies, "photos": photos}
    write_text(path, json.dumps(document, indent=1, allow_nan=False) + "\n")


def write_photo(folder: str | os.PathLike[str], dataset: str, one: Diagnosed) -> tuple[Path, Path]:
    """Write the diagnosis of one photo, as JSON and in Markdown; return the files."""
    stem = Path(folder) / one.name
    stem.parent.mkdir(parents=True, exist_ok=True)
    document, text = (stem.with_name(f"{stem.name}.{kind}") for kind in ("json", "md"))
    write_json(document, dataset, [one])
    mend = [f"- {line}" for line in said_worth(one)]
    write_text(text, one.diagnosis.markdown(one.name, mend).rstrip("\n") + "\n")
    return document, text


def _drawn(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    shown = Table(box=None, pad_edge=False, header_style="bold")
    for number, title in enumerate(head):
        words = number == 0 or title == "best remedy"
        shown.add_column(title, justify="left" if words else "right", no_wrap=not words)
    for row in rows:
        shown.add_row(*row)
    return drawn(shown, width=100)
