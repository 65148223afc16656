"""``skyline-viz detect``: photos in, a line of CSV for each column out."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from skyline_viz.command_line.inputs import NO_PHOTOS, collect, output_folder
from skyline_viz.command_line.messages import (
    UsageError,
    counted,
    status_after,
    tell,
    tell_done,
)
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.run_record import RECORD, Beginning
from skyline_viz.command_line.settings import Folder, Switch
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.photo_table import (
    TABLE,
    PhotoRow,
    digest_of_content,
    look_first,
    sure,
    write_table,
)
from skyline_viz.system.memory import MAX_MEGAPIXELS
from skyline_viz.system.names import columns_of, listed, padded, shortened
from skyline_viz.system.notes import note

if TYPE_CHECKING:
    from collections.abc import Sequence

    from skyline_viz.datasets.named_item import NamedItem
    from skyline_viz.method import Method
    from skyline_viz.skyline import Skyline

_WIDEST = 100
"""Of a line in an overlay, in pixels."""


@dataclass(frozen=True)
class Detect:
    """Find the skylines of photos and write them as CSV, a line for each column.

    Examples:
        skyline-viz detect photos --out skylines
        skyline-viz detect photos/*.jpg --overlay --mask
        skyline-viz detect photos --config skylines/run.json --out again
    """

    photos: Annotated[
        tuple[Path, ...],
        tyro.conf.Positional,
        tyro.conf.arg(metavar="PHOTO"),
    ]
    """Photos, folders of photos, or data sets."""

    out: Folder = Path("skylines")
    """Folder for NAME.csv: column, row of its first terrain pixel, whether visible (1 or 0), and
    margin, small where the line is unsure; skylines.csv, how sure each photo is; run.json."""

    methods: MethodOptions = field(default_factory=Methods)
    """What detects, one method; our detector with its default settings unless given."""

    mask: Switch = False
    """Also write NAME-mask.png: 0 is sky, 255 terrain."""

    overlay: Switch = False
    """Also write NAME-overlay.jpg: the photo with its skyline, and its truth where it has one."""

    overlay_width: Annotated[int, tyro.conf.arg(metavar="PIXELS")] = 0
    """Width of the skyline in an overlay; 0 takes what is seen well, 1 hides no ridge."""

    json: Switch = False
    """Also write NAME.json: the skyline as JSON."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos, their size and the free memory."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Detect all photos; return the exit status."""
        if not self.photos:
            raise UsageError(NO_PHOTOS)
        if not 0 <= self.overlay_width <= _WIDEST:
            raise UsageError(
                f"--overlay-width is from 0 to {_WIDEST} pixels, not {self.overlay_width}."
            )
        if self.overlay_width and not self.overlay:
            raise UsageError("--overlay-width is that of --overlay, which is not asked for.")
        began = Beginning.now()
        inputs = collect(self.photos, taken=(Path(TABLE).stem, Path(RECORD).stem))
        detector = self.methods.one()
        output_folder(self.out, (one.item for one in inputs))
        wide = max(columns_of(shortened(one.name)) for one in inputs)
        failures: list[Failure] = []
        rows: list[PhotoRow] = []
        workers = foresee((one.item for one in inputs), self.workers)
        outcomes = run(partial(_detect, self, detector), inputs, workers=workers)
        for photo, outcome in zip(inputs, outcomes, strict=True):
            if isinstance(outcome, Failure):
                failures.append(outcome)
                rows.append(_failed(photo, outcome))
                continue
            rows.append(outcome.row)
            tell_done(outcome.line(wide))
            if outcome.doubt:
                tell(f"{shortened(photo.name)}: {outcome.doubt}")
        write_table(self.out / TABLE, rows)
        began.write(self.out / RECORD, detector, self.methods.bank, self._options(), rows)
        _sum_up(self.out, rows, wide)
        return status_after(failures)

    def _options(self) -> dict[str, object]:
        """What else was chosen, for the record of the run."""
        names = ("mask", "overlay", "overlay_width", "json", "workers", "max_megapixels")
        return {"out": str(self.out), **{name: getattr(self, name) for name in names}}


@dataclass(frozen=True)
class _Found:
    row: PhotoRow
    files: tuple[Path, ...]
    doubt: str

    def line(self, wide: int) -> str:
        row = self.row
        height, width = row.size or (0, 0)
        size, files = f"{width}x{height}", " ".join(map(str, self.files))
        told = f"{sure(row.confidence or 0.0):>9}  {row.seconds:6.3f} s"
        return f"{padded(shortened(row.name), wide)}  {size:>9}  {told}  {files}"


def _detect(options: Detect, detector: Method, photo: NamedItem) -> _Found:
    from skyline_viz.certainty.least_sure import least_sure
    from skyline_viz.running.warming import warm_up

    pixels = photo.item.photo()
    warm_up()
    found = detector.detect(pixels)
    line, margins = found.skyline, found.margins()
    height = pixels.shape[0]
    path = options.out / photo.name  # with_suffix would cut names that hold a dot
    files = [path.with_name(f"{photo.name}.csv")]
    line.write_csv(files[0], margins)
    if options.json:
        files.append(path.with_name(f"{photo.name}.json"))
        line.write_json(files[-1], margins)
    if options.mask or options.overlay:
        import numpy as np

        from skyline_viz.overlay import draw_overlay
        from skyline_viz.photo import write_photo

        if options.mask:
            files.append(path.with_name(f"{photo.name}-mask.png"))
            write_photo(files[-1], (~line.to_mask(height)).astype(np.uint8) * np.uint8(255))
        if options.overlay:
            files.append(path.with_name(f"{photo.name}-overlay.jpg"))
            truth = _truth_of(photo, line.width)
            picture = draw_overlay(pixels, line, truth, thick=options.overlay_width or None)
            write_photo(files[-1], picture)
    seen = found.visibility
    row = PhotoRow(
        photo.name,
        photo.item.photo_path,
        sha256=digest_of_content(photo.item.photo_path),
        size=(height, line.width),
        confidence=found.confidence,
        case=seen.case if seen else "",
        least_sure=tuple(least_sure(margins, line.visible)),
        seconds=found.total_seconds,
    )
    return _Found(row, tuple(files), seen.doubt if seen else "")


def _truth_of(photo: NamedItem, width: int) -> Skyline | None:
    """The truth of a photo, for its overlay; None where it has none, or none that can be read."""
    from skyline_viz.skyline import SkylineError

    try:
        truth = photo.item.truth()
    except SkylineError as error:
        note(f"{photo.name}-overlay.jpg is without a truth: {error}")
        return None
    if truth is not None and truth.width != width:
        note(
            f"{photo.name}-overlay.jpg is without a truth: that is of {truth.width} columns, and "
            f"the photo of {width}."
        )
        return None
    return truth


def _failed(photo: NamedItem, failure: Failure) -> PhotoRow:
    """What there is to know of a photo that failed."""
    path = photo.item.photo_path
    return PhotoRow(photo.name, path, digest_of_content(path), error=failure.reason)


def _sum_up(out: Path, rows: Sequence[PhotoRow], wide: int) -> None:
    """Say how many skylines there are, and of several which ones to look at first."""
    good = [row for row in rows if not row.error]
    if len(good) < 2:
        return
    if odd := [shortened(row.name) for row in good if row.case not in ("", "skyline")]:
        tell(f"{counted(len(odd), 'photo')} may show no skyline, or a part of one: {listed(odd)}")
    tell_done(
        f"{counted(len(good), 'skyline')} in {out}; {TABLE} says how sure each is, {RECORD} how"
    )
    tell_done("Look at these first:")
    for row in look_first(good):
        where = f", least in columns {row.stretches}" if row.stretches else ""
        tell_done(f"  {padded(shortened(row.name), wide)}  {sure(row.confidence or 0.0)}{where}")
