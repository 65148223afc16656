"""``skyline-annotate export``, ``import`` and ``backup``: labels leave and come back."""

from __future__ import annotations

from contextlib import closing
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

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
from skyline_viz.command_line.local import local
from skyline_viz.command_line.messages import GOOD, SOME_FAILED, UsageError, counted, say, tell
from skyline_viz.command_line.settings import OptionalFolder, Switch
from skyline_viz.command_line.sizes import MaxMegapixels
from skyline_viz.command_line.truth_options import TruthOptions, Truths
from skyline_viz.storage.copies import lost_in
from skyline_viz.system.memory import MAX_MEGAPIXELS

if TYPE_CHECKING:
    from annotate.store.identity import Photo
    from annotate.store.label_table import Log


@dataclass(frozen=True)
class Export:
    """Write accepted labels in a format that other programs read.

    Examples:
        skyline-annotate export photos
        skyline-annotate export photos --format mask --out masks
        skyline-annotate export photos --format coco --annotator ada --out coco
    """

    folder: PhotoFolder
    """Folder of the photos."""

    out: OptionalFolder = None
    """Folder to make; skylines-FORMAT unless given."""

    format: FormatName = "csv"
    """csv, json, mask, painted, ch1, coco, labelme, cvat or parquet."""

    status: Literal["accepted", "all"] = "accepted"
    """Which labels: the accepted ones, or all that have a line."""

    annotator: Annotated[str, tyro.conf.arg(metavar="NAME")] = ""
    """Whose labels, where there are several annotators; the consensus where there is one."""

    pass_number: int = 0
    """Which pass, where there are several."""

    orphans: Switch = False
    """Write the labels whose photos are not in the folder any more, and no others; csv or json."""
    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Export; return the exit status."""
        from annotate.formats import export_labels
        from annotate.work.joined import joined

        out = self.out or Path(f"skylines-{self.format}")
        with opened(self.folder) as store:
            who, number = chosen_pass(store, self.annotator, self.pass_number)
            found = joined(store, who, number)
        for note in (*store.problems, *(found.damaged if self.orphans else found.notes)):
            say(note, PROGRAM)
        every = found.orphans if self.orphans else found.labels
        if self.orphans and not every:
            raise UsageError(f"the photos of all labels of {who}, pass {number}, are there.")
        labels = [one for one in every if self.status in ("all", one.status)]
        export = export_labels(
            labels, self.folder, out, self.format, found.contents, orphans=self.orphans
        )
        for note in export.notes:
            say(note, PROGRAM)
        tell(f"{counted(export.written, 'label')} in {out}")
        whole = len(every) if self.orphans else len(found.photos)
        if (missing := whole - export.written) > 0:
            what = "label" if self.orphans else "photo"
            tell(f"Not in it: {counted(missing, what)} of the folder.")
        return SOME_FAILED if store.fault else GOOD


@dataclass(frozen=True)
class Import:
    """Read labels that another program, or another annotator, has made.

    Examples:
        skyline-annotate import photos skylines
        skyline-annotate import photos masks --format mask --sky 255
        skyline-annotate import photos coco/skylines.json --status accepted
    """

    folder: PhotoFolder
    """Folder of the photos."""

    source: Annotated[str, tyro.conf.Positional, tyro.conf.arg(metavar="FILE_OR_DIR")]
    """What to read, a path or an address such as s3://BUCKET/FOLDER."""

    format: FormatName | None = None
    """Its format; told by the content unless given."""

    annotator: Annotator = ""
    """Whose labels they are; the user's unless given, or as the file says."""

    pass_number: int = 0
    """Which pass they are; 1 unless given, or as the file says."""

    status: Literal["needs review", "accepted"] = "needs review"
    """Status of labels whose format does not carry one."""

    label: Annotated[str | None, tyro.conf.arg(metavar="NAME")] = None
    """What skylines, or regions of sky, are called in it; skyline, horizon and sky unless given."""

    truths: TruthOptions = field(default_factory=Truths)
    """Which value of a mask, or which label of a region, is sky or terrain."""
    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Import; return the exit status."""
        from annotate.store.store import Store

        check_folder(self.folder)
        with closing(Store(self.folder, reading=True)) as store:
            logs, problems, notes = self._checked(store.find())  # before a file or a row is made
        with closing(Store(self.folder)) as store:
            ids = {photo.digest: photo.id for photo in store.find()}
            for digest, _, _ in logs:
                if digest not in ids:
                    raise UsageError(f"a photo in {self.folder} was changed meanwhile; try again.")
            kept = [replace(log, photo=ids[digest]) for (digest, _, _), log in logs.items()]
            skipped = store.insert(kept)
            names = {photo.id: photo.name for photo in store.find()}  # reads what they are known by
        for sentence in (*problems, *notes):
            say(sentence, PROGRAM)
        for log in skipped:
            already = f"has been labelled by {log.annotator} in pass {log.number} already."
            say(f"{names[log.photo]} {already}", PROGRAM)
        tell(f"{counted(len(logs) - len(skipped), 'label')} imported into {self.folder}")
        if skipped:
            say("name another --annotator or --pass-number to keep both.", PROGRAM)
        return SOME_FAILED if skipped or problems else GOOD

    def _checked(
        self, photos: list[Photo]
    ) -> tuple[dict[tuple[str, str, int], Log], list[str], list[str]]:
        """Labels that can be kept, by the digest of their photo, annotator and pass.

        Also a sentence for each that cannot, and what is worth knowing.
        """
        from annotate.formats import FormatError, import_labels
        from annotate.store.contents import Contents
        from annotate.work.importing import checked

        if not photos:
            raise UsageError(f"{self.folder} holds no photograph.")
        by_name = {photo.name: photo for photo in photos}
        source = local(self.source)
        if lost := lost_in(source):
            raise UsageError(next(iter(lost.values())))
        read = import_labels(
            source,
            self.folder,
            by_name,
            self.format,
            label=self.label,
            sky=self.truths.sky,
            terrain=self.truths.terrain,
            contents=Contents.of(self.folder, photos),
        )
        logs: dict[tuple[str, str, int], Log] = {}
        problems = list(read.problems)
        for one in read:
            told, photo = one.label, by_name[one.name]
            who = self.annotator or (told.annotator if told else "") or whoever("")
            number = self.pass_number or (told.number if told else 1)
            try:
                log = checked(one, photo, who, number, status=self.status, source=source.name)
            except FormatError as error:
                problems.append(str(error))
                continue
            if logs.setdefault((photo.digest, who, number), log) is not log:
                problems.append(
                    f"{self.source} holds several labels of {one.name} by {who}, pass {number}; "
                    "the first of them counts."
                )
        if not logs:
            raise FormatError(" ".join(problems[:3]))
        return logs, problems, list(read.notes)


@dataclass(frozen=True)
class Backup:
    """Copy the labels of a folder into one file, also while they are being changed.

    Examples:
        skyline-annotate backup photos
        skyline-annotate backup photos --out labels.sqlite
        skyline-annotate backup photos/june --out june.sqlite
    """

    folder: PhotoFolder
    """Folder of the photos."""

    out: Annotated[Path | None, tyro.conf.arg(metavar="FILE")] = None
    """File to write; DIR-labels-DATE.sqlite unless given. Put back, it is skyline-labels.sqlite."""

    def run(self) -> int:
        """Back up; return the exit status."""
        from annotate.store.database import backup

        name = check_folder(self.folder).resolve().name or "photos"
        date = datetime.now().astimezone().strftime("%Y-%m-%d-%H%M%S")
        out = self.out or Path(f"{name}-labels-{date}.sqlite")
        if out.exists():
            raise UsageError(f"{out} exists already.")
        fault = backup(self.folder, out)
        if fault:
            say(fault, PROGRAM)
        tell(str(out))
        return SOME_FAILED if fault else GOOD
