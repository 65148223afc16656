"""``skyline-viz demo``: detect photos and show them on a page."""

from __future__ import annotations

import os
import sys
import webbrowser
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from skyline_viz.batch import Failure, run
from skyline_viz.commands.demo_page import Shown, page
from skyline_viz.commands.inputs import Input, collect, output_folder
from skyline_viz.commands.messages import SOME_FAILED, counted, say, status_after
from skyline_viz.commands.render import write_with_progress
from skyline_viz.commands.settings import Folder, make_detector
from skyline_viz.config import DetectorConfig
from skyline_viz.datasets import DatasetError, open_dataset

if TYPE_CHECKING:
    from skyline_viz.detector import Detector
    from skyline_viz.overlay import Tile

OVERLAY_WIDTH = 2000
"""Largest width of an overlay on the page, in pixels."""

MOST_TILES = 200
"""Photos on the contact sheet at most."""


@dataclass(frozen=True)
class Demo:
    """Find the skylines of photos and show them on a page and a contact sheet."""

    photos: Annotated[
        tuple[Path, ...],
        tyro.conf.Positional,
        tyro.conf.arg(metavar="[PHOTO ...]", help_behavior_hint="(default: the sample photos)"),
    ] = ()
    """Photos, folders of photos, or data sets."""

    out: Folder = Path("skyline-demo")
    """Folder for index.html, contact_sheet.jpg and overlays/NAME.jpg."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos."""

    def run(self) -> int:
        """Detect, draw, write and show; return the exit status."""
        inputs = collect(self.photos or [self._samples()])
        output_folder(self.out, (one.item for one in inputs))
        detector = make_detector(None, DetectorConfig())
        wide = max(len(one.name) for one in inputs)
        shown: list[Shown] = []
        tiles: list[Tile] = []
        failures: list[Failure] = []
        for outcome in run(partial(_show, self.out, detector), inputs, workers=self.workers):
            if isinstance(outcome, Failure):
                failures.append(outcome)
                continue
            one, tile = outcome
            shown.append(one)
            tiles += [tile] if len(tiles) < MOST_TILES else []
            print(one.line(wide))
        if not shown:
            status_after(failures)
            return SOME_FAILED
        index = self._write(shown, tiles)
        print(f"{counted(len(shown), 'photo')} in {index}")
        if not (_has_display() and webbrowser.open(index.resolve().as_uri())):
            print(f"Open {index.resolve().as_uri()} in a browser to look at them.")
        return status_after(failures)

    def _samples(self) -> Path:
        """Folder of the sample photos: of a checkout, or rendered now."""
        checkout = Path(__file__).resolve().parents[2]
        for folder in (Path("sample_data"), checkout / "sample_data", self.out / "sample_data"):
            try:
                if len(open_dataset(folder)):
                    return folder
            except DatasetError:
                continue
        from skyline_viz.rendering import SAMPLES, sample_scenes  # noqa: PLC0415

        folder = output_folder(self.out, ()) / "sample_data"
        say(f"rendering sample photos into {folder}.")
        list(write_with_progress(sample_scenes(), folder, len(SAMPLES)))
        return folder

    def _write(self, shown: list[Shown], tiles: list[Tile]) -> Path:
        from skyline_viz.files import write_text  # noqa: PLC0415
        from skyline_viz.overlay import contact_sheet  # noqa: PLC0415
        from skyline_viz.photo import write_photo  # noqa: PLC0415

        if len(tiles) < len(shown):
            say(f"the contact sheet shows the first {len(tiles)} of {len(shown)} photos.")
        write_photo(self.out / "contact_sheet.jpg", contact_sheet(tiles))
        write_text(self.out / "index.html", page(shown))
        return self.out / "index.html"


def _show(out: Path, detector: Detector, photo: Input) -> tuple[Shown, Tile]:
    from skyline_viz.evaluation import warm_up  # noqa: PLC0415
    from skyline_viz.metrics import a_err, is_gross_miss  # noqa: PLC0415
    from skyline_viz.overlay import draw_overlay, make_tile, shrunk  # noqa: PLC0415
    from skyline_viz.photo import write_photo  # noqa: PLC0415

    pixels = photo.item.photo()
    truth = photo.item.truth()
    warm_up()
    detection = detector.detect(pixels)
    skyline = detection.skyline
    height, width = pixels.shape[:2]
    error = None if truth is None else a_err(skyline, truth)
    overlay = f"overlays/{photo.name}.jpg"
    small, (line, true_line) = shrunk(pixels, skyline, truth, width=OVERLAY_WIDTH)
    write_photo(out / overlay, draw_overlay(small, line, true_line))
    label = photo.name if error is None else f"{photo.name}   A_err {error:.2f} px"
    gross = error is not None and is_gross_miss(error, height)
    one = Shown(photo.name, overlay, height, width, detection.total_seconds, error, gross)
    return one, make_tile(label, pixels, skyline, truth)


def _has_display() -> bool:
    if os.environ.get("CI"):
        return False
    if sys.platform in ("darwin", "win32"):
        return "SSH_CONNECTION" not in os.environ
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
