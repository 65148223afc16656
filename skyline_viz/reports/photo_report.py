"""What a report shows of one photo: its lines, stages and costs, the cause, and the remedy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from skyline_viz.detection import Detection
from skyline_viz.diagnosis.diagnosing import Segment
from skyline_viz.diagnosis.record import Diagnosed
from skyline_viz.diagnosis.remedies import Remedy, best, line_with
from skyline_viz.evaluation.metrics import TOLERANCE, scaled
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.frames.visibility import Case
from skyline_viz.reports.costs import Plot, cost_plots
from skyline_viz.reports.lines import line_path
from skyline_viz.reports.pictures import Picture, StagePicture, photo_picture, stage_pictures
from skyline_viz.skyline import Skyline

ALONE = 1
"""Photos up to which a report shows them large."""

_LARGE = (1280, 300_000, 480, 300_000)
_SMALL = (640, 38_000, 300, 36_000)  # 40 of them are under 5 MB
_MOST = 8  # remedies that are listed
_LINE = 0.3  # by how much a line may be off, in pixels of its picture


@dataclass(frozen=True, eq=False)
class PhotoReport:
    """A photo, what was found in it, and why."""

    name: str
    """What it is called."""

    method: str
    """Name of the method."""

    height: int
    """Rows of the photo."""

    width: int
    """Its columns."""

    verdict: Verdict
    """What the detection came to."""

    result: PhotoResult | None
    """How far it is from the truth; None without one."""

    about: tuple[str, ...]
    """How it was made, in sentences."""

    confidence: float | None
    """Probability that the line is no gross miss."""

    shows: Case | None
    """Whether it has a skyline; None of methods that cannot tell."""

    doubt: str
    """Why its line may be none, in a sentence; nothing where it is a skyline."""

    diagnosed: Diagnosed | None
    """Why it went wrong, with the remedies that were tried; None where that was not asked."""

    remedy: Remedy | None
    """The best remedy; None where none helps, or none was tried."""

    photo: Picture
    """The photo."""

    stages: tuple[StagePicture, ...]
    """Its stages."""

    plots: tuple[Plot, ...]
    """Error and costs along the columns."""

    path: str
    """The line as a path of SVG, in pixels of the photo."""

    truth: str
    """The truth; empty without one."""

    mended: str
    """The line with the best remedy; empty without one."""

    seen: str = ""
    """What has seen the photo in training, see `evaluation.seen.seen_in_training`."""

    own_tags: tuple[str, ...] = ()
    """Words by which it can be chosen, such as the folder it lies in."""

    @property
    def tags(self) -> tuple[str, ...]:
        """Words by which it can be chosen, with what the detection came to."""
        found = list(self.own_tags)
        if self.a_err is None:
            found.append("no truth")
        elif self.verdict.gross_miss:
            found.append("gross miss")
        if self.shows not in (None, "skyline"):
            found.append(str(self.shows))
        return tuple(dict.fromkeys(found))

    @property
    def a_err(self) -> float | None:
        """Mean error in pixels; None without a truth."""
        return self.verdict.a_err

    @property
    def segments(self) -> tuple[Segment, ...]:
        """Why it went wrong, the segment with the largest total error first."""
        return self.diagnosed.diagnosis.by_error if self.diagnosed else ()

    @property
    def helping(self) -> list[Remedy]:
        """The remedies that make the error smaller, the best of them first."""
        tried = self.diagnosed.remedies if self.segments and self.diagnosed else ()
        return sorted((one for one in tried if one.change < 0), key=lambda one: one.a_err)[:_MOST]

    def without_stages(self) -> PhotoReport:
        """The same with less to show, for a report of many photos."""
        return replace(self, stages=())


def photo_report(
    name: str,
    detection: Detection,
    truth: Skyline | None = None,
    diagnosed: Diagnosed | None = None,
    *,
    photos: int = 1,
) -> PhotoReport:
    """Gather what a report shows of a photo.

    Args:
        name: What the photo is called.
        detection: What was found in it.
        truth: The true line; one that is visible nowhere counts as none.
        diagnosed: Why it went wrong, and what was tried; nothing unless given.
        photos: How many the report is of: one is shown large.
    """
    if truth is not None and not truth.visible.any():
        truth = None
    height, width = detection.edges.shape
    side, photo_bytes, stage_side, stage_bytes = _LARGE if photos <= ALONE else _SMALL
    remedy = best(diagnosed.remedies) if diagnosed and not diagnosed.diagnosis.right else None
    mended = line_with(detection, remedy, diagnosed.remedies) if diagnosed and remedy else None
    tolerance = diagnosed.diagnosis.tolerance if diagnosed else scaled(TOLERANCE, height)
    visibility = detection.visibility
    off = _LINE * max(height, width) / side
    lines = [
        line_path(line, max(off, 0.05)) if line is not None else ""
        for line in (_drawn(detection.skyline), truth, mended and _drawn(mended))
    ]
    seconds = detection.total_seconds
    return PhotoReport(
        name=name,
        method=detection.method,
        height=height,
        width=width,
        verdict=Verdict.of(detection.skyline, detection.margins(), height, truth),
        result=PhotoResult.of(name, detection.skyline, truth, height, seconds) if truth else None,
        about=tuple(detection.about()),
        confidence=detection.confidence,
        shows=visibility.case if visibility else None,
        doubt=visibility.doubt if visibility else "",
        diagnosed=diagnosed,
        remedy=remedy if mended else None,
        photo=photo_picture(detection.photo, side, photo_bytes),
        stages=stage_pictures(detection, stage_side, stage_bytes),
        plots=cost_plots(detection, truth, tolerance),
        path=lines[0],
        truth=lines[1],
        mended=lines[2],
    )


def _drawn(line: Skyline) -> Skyline:
    """A line as it was found, also where the photo does not show it."""
    return Skyline(line.rows, np.ones(line.width, np.bool_))
