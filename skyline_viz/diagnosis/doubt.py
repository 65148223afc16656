"""What speaks against a truth: a photo without contrast along it, and with much beside it."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import U8, Int
from skyline_viz.diagnosis.counterfactual import REPAIRED, Case
from skyline_viz.evaluation.metrics import scaled

_ON_EDGES = 0.7  # share of the path's columns on edges from which on the truth can be doubtful,
_NO_PEAK, _LESS_PEAK = 0.5, 0.2  # if its contrast stands out no more than this, or than this share
_MORE_PEAK = 0.5  # of the path's, and the path's stands out by this much more
_BAND = 8  # rows beside a line that its contrast is compared with
_SPREAD = 1.0  # how much the distance may vary (its median deviation), in pixels
_BESIDE = 20.0  # distance up to which the path is a few pixels beside, at 519 rows


@dataclass(frozen=True)
class Doubt:
    """What speaks against a truth."""

    evidence: str
    """What was found, in two sentences."""

    columns: int
    """Visible columns in which the truth was moved."""

    repaired: float
    """Share of the wrong ones that are right then."""


def doubt_of(case: Case, first: int, last: int) -> Doubt | None:
    """What speaks against the truth in the columns of a segment; None where nothing does.

    The photo itself is asked, in colour, whatever the detector's edges are: along a true line the
    contrast from above to below is stronger than along its neighbours a few rows off. The
    counterfactual moves the truth, as a whole, to where the path is.
    """
    part = slice(first, last + 1)
    columns = np.arange(first, last + 1)[case.truth.visible[part]]
    detection = case.detection
    height = len(detection.photo)
    path = case.path_rows
    away = path[columns] - case.truth.rows[columns]
    apart = float(np.median(away))
    spread = float(np.median(np.abs(away - apart)))
    near = abs(apart) <= scaled(_BESIDE, height) and spread <= scaled(_SPREAD, height)
    on = float(detection.edges[path[columns], columns].mean())
    if not near or on < _ON_EDGES or len(columns) < 8:
        return None
    of_truth = _contrast(detection.photo, case.drawn_rows, columns)
    of_path = _contrast(detection.photo, path, columns)
    if of_truth > max(_NO_PEAK, _LESS_PEAK * of_path) or of_path < of_truth + _MORE_PEAK:
        return None
    wrong = case.errors[columns] > case.tolerance
    moved = float((np.abs(away[wrong] - apart) <= case.tolerance).mean())
    if moved < REPAIRED:
        return None
    where = "lower" if apart > 0 else "higher"
    return Doubt(
        f"Along the path the photo's contrast is {1 + of_path:.1f} times that of the rows beside "
        f"it, along the truth {1 + of_truth:.1f} times. With the truth {abs(apart):.0f} px "
        f"{where}, {moved:.0%} of the wrong columns are right: check the annotation.",
        len(columns),
        moved,
    )


def _contrast(photo: U8, rows: Int, columns: npt.NDArray[np.intp]) -> float:
    """How much the contrast from above to below stands out along a line, about 0 on no edge.

    Mean gradient down the columns, in the channel where it is strongest, on the best of the rows
    next to the line, over the mean of those 3 to 6 rows off, less 1.
    """
    top = max(int(rows[columns].min()) - _BAND, 0)
    bottom = int(rows[columns].max()) + _BAND
    part = photo[top : bottom + 1].astype(np.float32)
    down = np.abs(cv2.Sobel(part, cv2.CV_32F, 0, 1, ksize=3)).reshape(*part.shape).max(axis=2)
    profile = {
        off: float(down[(rows[columns] + off - top).clip(0, len(down) - 1), columns].mean())
        for off in range(-6, 7)
    }
    here = max(profile[off] for off in (-2, -1, 0, 1))
    around = [value for off, value in profile.items() if off >= 3 or off <= -4]
    return here / max(float(np.mean(around)), 1e-6) - 1
