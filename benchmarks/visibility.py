"""Photos without a skyline: how many are told, and how many that have one are denied it.

The negatives are parts of photographs: the truth tells which are all sky, which all terrain, and
where the line leaves through a rim half of the way. Each source is looked at with the sky model
that has not seen it.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from benchmarks.left_out import Models
from benchmarks.table import markdown
from skyline_viz import Detector, Skyline, open_dataset
from skyline_viz.arrays import U8, Bool
from skyline_viz.sky_model import SkyModel

SIDE = 512
"""Larger side of what is looked at, in pixels: maps are far coarser, and time is short."""

LEAST = 0.2
"""Parts of fewer rows, as a share of the photo's, are not cut."""

AWAY = 0.03
"""Rows between a part without the line and the line, as a share of the photo's."""


@dataclass
class Tally:
    """What photos of a kind came to."""

    photos: int = 0
    denied: int = 0
    in_part: int = 0
    visible: int = 0
    lost: int = 0
    hidden: int = 0
    found: int = 0

    def add(self, detector: Detector, photo: U8, visible: Bool) -> None:
        """Look at a photo of which it is known where the line is visible."""
        scale = SIDE / max(photo.shape[:2])
        if scale < 1:
            small = np.asarray(cv2.resize(photo, None, fx=scale, fy=scale), np.uint8)
            columns = (np.arange(small.shape[1]) + 0.5) * len(visible) / small.shape[1]
            photo, visible = small, visible[columns.astype(int)]
        shown = detector.detect(np.ascontiguousarray(photo)).skyline.visible
        self.photos += 1
        self.denied += not shown.any()
        self.in_part += bool(shown.any() and not shown.all())
        self.visible += int(visible.sum())
        self.lost += int((visible & ~shown).sum())
        self.hidden += int((~visible).sum())
        self.found += int((~visible & ~shown).sum())

    def cells(self) -> list[str]:
        """Cells of the table."""
        lost = f"{self.lost / self.visible:.2%}" if self.visible else ""
        found = f"{self.found / self.hidden:.0%}" if self.hidden else ""
        return [str(self.photos), str(self.denied), str(self.in_part), lost, found]


def denied(folders: Iterable[Path], models: Models) -> str:
    """The table, for data sets with truth.

    Args:
        folders: The data sets.
        models: Sky models that have not seen them; the shipped one, which has, stands in.
    """
    tallies: dict[str, Tally] = defaultdict(Tally)
    seen = []
    for folder in folders:
        unseen = models(folder.name.removesuffix("_dataset"))
        detector = Detector(sky=unseen or SkyModel.small())
        seen += [] if unseen else [folder.name]
        for item in open_dataset(folder):
            truth = item.truth()
            if truth is None:
                continue
            photo = item.photo()
            tallies[f"whole: {folder.name}"].add(detector, photo, truth.visible)
            for kind, part, visible in parts(photo, truth):
                tallies[f"{kind}: {folder.name}"].add(detector, part, visible)
    rows = [[kind, *tallies[kind].cells()] for kind in sorted(tallies)]
    header = ["photographs", "number", "no skyline", "does not cross"]
    table = markdown([*header, "visible columns lost", "hidden columns found"], rows)
    told = "Sky models have not seen the photographs, and filters have."
    if seen:
        told = f"**Not a test** where the sky model has seen the photographs: {', '.join(seen)}."
    return f"## Photos without a skyline\n\nReduced to {SIDE} pixels. {told}\n\n{table}"


def parts(photo: U8, truth: Skyline) -> Iterator[tuple[str, U8, Bool]]:
    """Parts of a photo without its line, or with half of it: kind, photo, where it is visible."""
    height = len(photo)
    rows = truth.rows[truth.visible]
    high, low, middle = (int(np.percentile(rows, one)) for one in (0, 100, 50))
    away, least = int(AWAY * height), LEAST * height
    if high - away >= least:
        yield "all sky", *_like(photo[: high - away], photo.shape)
    if height - low - away >= least:
        yield "all terrain", *_like(photo[low + away :], photo.shape)
    if low - high < away:
        return
    if height - middle >= least:
        yield "leaves at the top", photo[middle:], truth.visible & (truth.rows > middle)
    if middle >= least:
        yield "leaves at the bottom", photo[:middle], truth.visible & (truth.rows < middle)


def _like(part: U8, shape: tuple[int, ...]) -> tuple[U8, Bool]:
    """The middle of a part without the line, in about the shape of the photo."""
    width = min(shape[1], max(2, int(1.5 * len(part) * shape[1] / shape[0])))
    first = (shape[1] - width) // 2
    return part[:, first : first + width], np.zeros(width, np.bool_)
