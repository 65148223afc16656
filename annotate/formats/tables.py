"""Labels as text of our own, a CSV file a photo."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

from annotate.engine.hidden import Hidden, hidden_too
from annotate.formats.common import Entry
from annotate.formats.importing import Task
from skyline_viz.datasets.truths import begins_like_a_skyline, read_truth
from skyline_viz.files import write_text
from skyline_viz.running.photo_table import is_table
from skyline_viz.skyline import WHY, Skyline


def write_csv(entries: list[Entry], folder: Path) -> None:
    """Write a CSV file for each photo, with a column of what hides the line where that is known."""
    for entry in entries:
        file = folder / f"{entry.stem}.csv"
        entry.skyline.write_csv(file)
        if any(one.why for one in entry.label.hidden):
            _add_reasons(file, entry.label.hidden)


def read_csv(task: Task) -> None:
    """Read the skylines of a folder, in CSV or JSON, or one of them."""
    files = [
        file
        for file in task.files
        if (file.suffix.lower() == ".csv" and not is_table(file))
        or (file.suffix.lower() == ".json" and begins_like_a_skyline(file))
    ]
    files.sort(key=lambda file: file.suffix.lower())  # of both, CSV counts
    for file in task.files if files else ():
        if file not in files and file.name not in task.given:
            task.found.note("not read beside skylines in CSV or JSON", file.name)
    reasons: dict[str, tuple[Hidden, ...]] = {}

    def read(file: Path, photo: str) -> Skyline:
        line = read_truth(file)
        reasons.setdefault(photo, _reasons(file))
        return line

    task.read_each(files or task.files, read)
    task.found.labels[:] = [
        replace(one, hidden=reasons.get(one.name, ())) for one in task.found.labels
    ]


def _add_reasons(file: Path, hidden: tuple[Hidden, ...]) -> None:
    header, *lines = file.read_text(encoding="utf-8").splitlines()
    why = [""] * len(lines)
    for one in hidden:
        why[one.first : one.last + 1] = [_quoted(one.why)] * (one.last + 1 - one.first)
    told = [f"{line},{reason}" for line, reason in zip(lines, why, strict=True)]
    write_text(file, "\n".join([f"{header},{WHY}", *told, ""]))


def _quoted(text: str) -> str:
    """A value of a CSV file."""
    return f'"{text.replace(chr(34), 2 * chr(34))}"' if set(text) & set(',"') else text


def _reasons(file: Path) -> tuple[Hidden, ...]:
    """Runs of columns with what hides them, of a file that has been read."""
    if file.suffix.lower() != ".csv":
        return ()
    with file.open(newline="", encoding="utf-8-sig") as opened:
        header, *lines = (line for line in csv.reader(opened) if line)
    found: tuple[Hidden, ...] = ()
    if header[-1] == WHY:
        for column, line in enumerate(lines):
            if line[-1]:
                found = hidden_too(found, Hidden(column, column, line[-1]))
    return found
