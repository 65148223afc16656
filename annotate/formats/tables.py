"""Labels as text of our own, a CSV file a photo."""

from __future__ import annotations

from pathlib import Path

from annotate.formats.common import Entry
from annotate.formats.importing import Task
from skyline_viz.datasets.truths import begins_like_a_skyline, read_truth
from skyline_viz.running.photo_table import is_table


def write_csv(entries: list[Entry], folder: Path) -> None:
    """Write a CSV file for each photo."""
    for entry in entries:
        entry.skyline.write_csv(folder / f"{entry.stem}.csv")


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
    task.read_each(files or task.files, lambda file, _: read_truth(file))
