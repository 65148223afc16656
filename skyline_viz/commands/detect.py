"""``skyline-viz detect``: photos in, a line of CSV for each column out."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import tyro

from skyline_viz.command_line.clusters import on_cluster
from skyline_viz.command_line.inputs import NO_PHOTOS, output_folder
from skyline_viz.command_line.messages import (
    UsageError,
    counted,
    status_after,
    tell,
    tell_done,
)
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.run_record import RECORD, Beginning
from skyline_viz.command_line.settings import ClusterAddress, Switch
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.command_line.stored import collect_stored, stored_photo
from skyline_viz.command_line.to_table import detect_to_table, is_table_name, shard_of
from skyline_viz.datasets.stored_item import StoredItem
from skyline_viz.running.batch import Failure
from skyline_viz.running.photo_table import (
    TABLE,
    PhotoRow,
    digest_of_content,
    look_first,
    row_from,
    sure,
    write_table,
)
from skyline_viz.storage.addresses import is_address
from skyline_viz.system.memory import MAX_MEGAPIXELS
from skyline_viz.system.names import columns_of, listed, padded, shortened
from skyline_viz.system.notes import note

if TYPE_CHECKING:
    from collections.abc import Sequence

    from skyline_viz.arrays import U8
    from skyline_viz.datasets.dataset import DatasetItem
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
        tuple[str, ...],
        tyro.conf.Positional,
        tyro.conf.arg(metavar="PHOTO"),
    ]
    """Photos, folders of photos, or data sets; paths, or addresses such as s3://BUCKET/FOLDER,
    gs://..., https://HOST/PHOTO.jpg, zip://FOLDER::FILE.zip."""

    out: Annotated[str, tyro.conf.arg(metavar="DIR")] = "skylines"
    """Folder for NAME.csv: column, row of its first terrain pixel, whether visible (1 or 0), and
    margin, small where the line is unsure; skylines.csv, how sure each photo is; run.json. Or
    FILE.parquet, a path or an address, for all of that as one table."""

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

    cluster: ClusterAddress = None
    """Work on a cluster instead: tcp://HOST:PORT, the address of a dask scheduler, or local:N for
    one of N processes on this machine. Its machines share the folders of photos, and DIR."""

    shard: Annotated[str | None, tyro.conf.arg(metavar="I/N")] = None
    """Do only this part of N, such as 3/8, for --out FILE.parquet: that is then a folder of parts,
    of which join makes one table."""

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
        detector = self.methods.one()
        if is_table_name(self.out):
            return self._to_table(began, detector)
        if self.shard is not None:
            raise UsageError("--shard writes one table: name it with --out FILE.parquet.")
        if is_address(self.out):
            raise UsageError("files go into a folder; an address takes a table, FILE.parquet.")
        return self._to_folder(began, detector, Path(self.out))

    def _to_folder(self, began: Beginning, detector: Method, out: Path) -> int:
        from skyline_viz.running.resume import Codec, Kept, digest_of_method

        inputs = collect_stored(self.photos, taken=(Path(TABLE).stem, Path(RECORD).stem))
        files = [one.item for one in inputs if not isinstance(one.item, StoredItem)]
        output_folder(out, files)
        wide = max(columns_of(shortened(one.name)) for one in inputs)
        failures: list[Failure] = []
        rows: list[PhotoRow] = []
        workers = self.workers if self.cluster else foresee(files, self.workers)
        kept = Kept.within(out, "detect")
        with on_cluster(self.cluster, self.workers, out):
            outcomes = kept.run(
                partial(_detect, self, detector),
                inputs,
                partial(_key, self, digest_of_method(detector)),
                Codec(_pack, _unpack),
                workers=workers,
            )
            for photo, outcome in zip(inputs, outcomes, strict=True):
                if isinstance(outcome, Failure):
                    failures.append(outcome)
                    rows.append(_failed(photo, outcome))
                    continue
                rows.append(outcome.row)
                tell_done(outcome.line(wide))
                if outcome.doubt:
                    tell(f"{shortened(photo.name)}: {outcome.doubt}")
        write_table(out / TABLE, rows)
        began.write(out / RECORD, detector, self.methods.bank, self._options(), rows)
        kept.remove()
        if said := kept.said():
            tell(said)
        _sum_up(out, rows, wide)
        return status_after(failures)

    def _to_table(self, began: Beginning, detector: Method) -> int:
        for option in ("mask", "overlay", "json"):
            if getattr(self, option):
                raise UsageError(f"--{option} writes files into a folder: name one with --out DIR.")
        shard = shard_of(self.shard)
        about = began.told(detector, self.methods.bank, self._options())
        return detect_to_table(
            self.photos,
            self.out,
            detector,
            {"run": about},
            workers=self.workers,
            cluster=self.cluster,
            shard=shard,
        )

    def _options(self) -> dict[str, object]:
        """What else was chosen, for the record of the run."""
        names = (
            *("mask", "overlay", "overlay_width", "json"),
            *("workers", "cluster", "shard", "max_megapixels"),
        )
        return {"out": self.out, **{name: getattr(self, name) for name in names}}


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

    digest, pixels = _read(photo.item)
    warm_up()
    found = detector.detect(pixels)
    line, margins = found.skyline, found.margins()
    height = pixels.shape[0]
    path = Path(options.out, photo.name)  # with_suffix would cut names that hold a dot
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
        photo.item.where,
        sha256=digest,
        size=(height, line.width),
        confidence=found.confidence,
        case=seen.case if seen else "",
        least_sure=tuple(least_sure(margins, line.visible)),
        seconds=found.total_seconds,
    )
    return _Found(row, tuple(files), seen.doubt if seen else "")


def _read(item: DatasetItem) -> tuple[str, U8]:
    """SHA-256 of a photo's file, and its pixels."""
    if isinstance(item, StoredItem):
        return hashlib.sha256(item.file()).hexdigest(), item.photo()
    digest, pixels = stored_photo(item).read()
    assert pixels is not None
    return digest, pixels


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


def _key(options: Detect, digest: str, photo: NamedItem) -> str:
    """Digest of all that the outputs of a photo are made from.

    Raises:
        OSError: It cannot be read.
        StorageError: It cannot be downloaded.
    """
    from skyline_viz.running.resume import digest_of, digest_of_files

    item = photo.item
    files = (options.mask, options.overlay, options.overlay_width, options.json)
    start = digest_of("detect", digest, files, photo.name, item.where)
    return digest_of_files(start, item if options.overlay else item.without_truth())


def _pack(found: _Found) -> dict[str, Any]:
    return {"row": found.row.kept(), "files": [*map(str, found.files)], "doubt": found.doubt}


def _unpack(kept: dict[str, Any]) -> _Found:
    files = tuple(map(Path, kept["files"]))
    if not all(file.exists() for file in files):
        raise LookupError("its files are gone, and are made again")
    return _Found(row_from(kept["row"]), files, str(kept["doubt"]))


def _failed(photo: NamedItem, failure: Failure) -> PhotoRow:
    """What there is to know of a photo that failed."""
    stored = isinstance(photo.item, StoredItem)
    digest = "" if stored else digest_of_content(photo.item.photo_path)
    return PhotoRow(photo.name, photo.item.where, digest, error=failure.reason)


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
