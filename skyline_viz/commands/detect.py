"""``skyline-viz detect``: photos in, a line of CSV for each column out."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from skyline_viz.command_line.inputs import collect, no_photos, output_folder
from skyline_viz.command_line.messages import UsageError, counted, status_after, tell
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.settings import Folder, Switch
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.running.batch import Failure, run
from skyline_viz.system.memory import MAX_MEGAPIXELS
from skyline_viz.system.names import columns_of, padded, shortened

if TYPE_CHECKING:
    from skyline_viz.datasets.named_item import NamedItem
    from skyline_viz.method import Method


@dataclass(frozen=True)
class Detect:
    """Find the skylines of photos and write them as CSV, a line for each column."""

    photos: Annotated[
        tuple[Path, ...],
        tyro.conf.Positional,
        tyro.conf.arg(metavar="PHOTO [PHOTO ...]", help_behavior_hint="(required)"),
    ]
    """Photos, folders of photos, or data sets."""

    out: Folder = Path("skylines")
    """Folder for NAME.csv: column, row of its first terrain pixel, and whether visible (1 or 0)."""

    methods: MethodOptions = field(default_factory=Methods)
    """What detects; our detector with its default settings unless given."""

    mask: Switch = False
    """Also write NAME-mask.png: 0 is sky, 255 terrain."""

    overlay: Switch = False
    """Also write NAME-overlay.jpg: the photo with its skyline."""

    json: Switch = False
    """Also write NAME.json: the skyline as JSON."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos, their size and the free memory."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Detect all photos; return the exit status."""
        if not self.photos:
            raise UsageError(no_photos(self.methods.method))
        inputs = collect(self.photos)
        detector = self.methods.one()
        output_folder(self.out, (one.item for one in inputs))
        wide = max(columns_of(shortened(one.name)) for one in inputs)
        failures = []
        workers = foresee((one.item for one in inputs), self.workers)
        outcomes = run(partial(_detect, self, detector), inputs, workers=workers)
        for outcome in outcomes:
            if isinstance(outcome, Failure):
                failures.append(outcome)
            else:
                tell(outcome.line(wide))
                if outcome.doubt:
                    tell(f"{shortened(outcome.name)}: {outcome.doubt}")
        written = len(inputs) - len(failures)
        if written > 1:
            tell(f"{counted(written, 'skyline')} in {self.out}")
        return status_after(failures)


@dataclass(frozen=True)
class _Found:
    name: str
    height: int
    width: int
    seconds: float
    files: tuple[Path, ...]
    doubt: str

    def line(self, wide: int) -> str:
        size = f"{self.width}x{self.height}"
        files = " ".join(map(str, self.files))
        return f"{padded(shortened(self.name), wide)}  {size:>9}  {self.seconds:6.3f} s  {files}"


def _detect(options: Detect, detector: Method, photo: NamedItem) -> _Found:
    from skyline_viz.running.warming import warm_up

    pixels = photo.item.photo()
    warm_up()
    found = detector.detect(pixels)
    height, width = pixels.shape[:2]
    path = options.out / photo.name  # with_suffix would cut names that hold a dot
    files = [path.with_name(f"{photo.name}.csv")]
    found.skyline.write_csv(files[0])
    if options.json:
        files.append(path.with_name(f"{photo.name}.json"))
        found.skyline.write_json(files[-1])
    if options.mask or options.overlay:
        import numpy as np

        from skyline_viz.overlay import draw_overlay
        from skyline_viz.photo import write_photo

        if options.mask:
            files.append(path.with_name(f"{photo.name}-mask.png"))
            terrain = ~found.skyline.to_mask(height)
            write_photo(files[-1], terrain.astype(np.uint8) * np.uint8(255))
        if options.overlay:
            files.append(path.with_name(f"{photo.name}-overlay.jpg"))
            write_photo(files[-1], draw_overlay(pixels, found.skyline))
    doubt = found.visibility.doubt if found.visibility else ""
    return _Found(photo.name, height, width, found.total_seconds, tuple(files), doubt)
