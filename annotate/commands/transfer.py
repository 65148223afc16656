"""``skyline-annotate export``, ``import`` and ``backup``: labels leave and come back."""

from __future__ import annotations

import time
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import tyro

from annotate.commands.options import (
    PROGRAM,
    Annotator,
    FormatName,
    PhotoFolder,
    check_folder,
    chosen_pass,
    opened,
    whoever,
)
from skyline_viz.commands.messages import GOOD, SOME_FAILED, UsageError, counted, say
from skyline_viz.commands.settings import OptionalFolder
from skyline_viz.commands.sizes import MaxMegapixels
from skyline_viz.memory import MAX_MEGAPIXELS

if TYPE_CHECKING:
    from annotate.formats import Imported


@dataclass(frozen=True)
class Export:
    """Write accepted labels in a format that other programs read."""

    folder: PhotoFolder
    """Folder of the photos."""

    out: OptionalFolder = None
    """Folder to make; skylines-FORMAT unless given."""

    format: FormatName = "csv"
    """csv, json, mask, painted, ch1, coco, labelme or cvat."""

    status: Literal["accepted", "all"] = "accepted"
    """Which labels: the accepted ones, or all that have a line."""

    annotator: Annotator = ""
    """Whose labels, where there are several annotators."""

    pass_number: int = 0
    """Which pass, where there are several."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Export; return the exit status."""
        from annotate.formats import export_labels  # noqa: PLC0415

        out = self.out or Path(f"skylines-{self.format}")
        with opened(self.folder) as store:
            who, number = chosen_pass(store, self.annotator, self.pass_number)
            every = list(store.labels(who, number))
            known = {photo.name for photo in store.photos()}
        labels = [one for one in every if self.status in ("all", one.status)]
        export = export_labels(labels, self.folder, out, self.format)
        for note in export.notes:
            say(note, PROGRAM)
        print(f"{counted(export.written, 'label')} in {out}")
        if missing := len(known) - export.written:
            print(f"Not in it: {counted(missing, 'photo')} of the folder.")
        return GOOD


@dataclass(frozen=True)
class Import:
    """Read labels that another program, or another annotator, has made."""

    folder: PhotoFolder
    """Folder of the photos."""

    source: Annotated[Path, tyro.conf.Positional, tyro.conf.arg(metavar="FILE_OR_DIR")]
    """What to read."""

    format: FormatName | None = None
    """Its format; told by the content unless given."""

    annotator: Annotator = ""
    """Whose labels they are; the user's unless given, or as the file says."""

    pass_number: int = 0
    """Which pass they are; 1 unless given, or as the file says."""

    status: Literal["needs review", "accepted"] = "needs review"
    """Status of labels whose format does not carry one."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Import; return the exit status."""
        from annotate.formats import import_labels  # noqa: PLC0415
        from annotate.store import StaleError, Store  # noqa: PLC0415

        check_folder(self.folder)
        store = Store(self.folder)
        skipped = 0
        try:
            photos = {photo.name: photo for photo in store.find()}
            if not photos:
                raise UsageError(f"{self.folder} holds no photograph.")
            found = import_labels(self.source, self.folder, photos, self.format)
            for one in found:
                told = one.label
                who = self.annotator or (told.annotator if told else "") or whoever("")
                number = self.pass_number or (told.number if told else 1)
                label = store.begin(photos[one.name].id, who, number)
                try:
                    store.insert(label, *log_of(one, photos[one.name].height, self.status))
                except StaleError:
                    skipped += 1
                    say(f"{one.name} has been labelled by {who} in pass {number} already.", PROGRAM)
        finally:
            store.close()
        print(f"{counted(len(found) - skipped, 'label')} imported into {self.folder}")
        if skipped:
            say("name another --annotator or --pass-number to keep both.", PROGRAM)
        return SOME_FAILED if skipped else GOOD


@dataclass(frozen=True)
class Backup:
    """Copy the labels of a folder into one file, also while they are being changed."""

    folder: PhotoFolder
    """Folder of the photos."""

    out: Annotated[Path | None, tyro.conf.arg(metavar="FILE")] = None
    """File to write; DIR-labels-DATE.sqlite unless given. Put back, it is skyline-labels.sqlite."""

    def run(self) -> int:
        """Back up; return the exit status."""
        from annotate.database import backup  # noqa: PLC0415

        name = check_folder(self.folder).resolve().name or "photos"
        date = datetime.now().astimezone().strftime("%Y-%m-%d-%H%M%S")
        out = self.out or Path(f"{name}-labels-{date}.sqlite")
        if out.exists():
            raise UsageError(f"{out} exists already.")
        backup(self.folder, out)
        print(out)
        return GOOD


def log_of(
    one: Imported, height: int, status: str
) -> tuple[list[tuple[float, str, dict[str, Any]]], Any]:
    """The log of an imported label, and its line.

    A label that comes with its log keeps it. Any other counts as drawn by hand; in a column that
    is all sky the line cannot be seen.
    """
    import numpy as np  # noqa: PLC0415

    from annotate.labels import ORIGINS  # noqa: PLC0415
    from annotate.lines import Line  # noqa: PLC0415
    from skyline_viz.skyline import Skyline  # noqa: PLC0415

    if one.label is not None and one.label.operations:
        log = []
        for operation in one.label.operations:
            body = {name: value for name, value in operation.items() if name not in ("kind", "at")}
            log.append((float(operation.get("at", 0.0)), str(operation["kind"]), body))
        return log, Line(one.skyline, one.label.origin)
    now = time.time()
    inside = np.minimum(one.skyline.rows, height - 1)
    skyline = Skyline(rows=inside, visible=one.skyline.visible & (one.skyline.rows < height))
    log = [(now, "drawn", {"first": 0, "rows": inside.astype(int).tolist()})]
    seen = np.concatenate([[True], skyline.visible, [True]])
    runs = np.flatnonzero(seen[1:] != seen[:-1]).reshape(-1, 2).tolist()
    for first, stop in runs:
        log.append((now, "hidden", {"first": first, "last": stop - 1, "hidden": True}))
    log += [(now, "tag", {"tag": tag, "on": True}) for tag in one.tags]
    log.append((now, "status", {"status": one.label.status if one.label else status}))
    origin = np.full(skyline.width, ORIGINS.index("drawn"), np.uint8)
    return log, Line(skyline, origin)
