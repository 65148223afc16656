"""Diagnoses of failures whose cause is known, and what they cost."""

import statistics
from collections import Counter
from time import process_time

from benchmarks.table import markdown
from skyline_viz.causes import CAUSES
from skyline_viz.detector import Detector
from skyline_viz.diagnosis import diagnose
from tests.injected import FAMILIAR, MAKERS, UNSEEN, cases, main_cause

EACH = 40
"""Cases of each cause."""


def confusion(each: int = EACH) -> str:
    """Confusion matrices of injected and diagnosed causes."""
    return "\n\n".join(
        [
            "## Diagnoses of failures of a known cause, put into rendered scenes",
            _matrix(UNSEEN, each, "Scenes that nothing was decided by"),
            _matrix(FAMILIAR, each, "The scenes by which the rules were made"),
        ]
    )


def _matrix(first_scene: int, each: int, title: str) -> str:
    rows, right, costs = [], 0, []
    for cause in MAKERS:
        said = Counter()
        for one in cases(cause, each, first_scene):
            said[main_cause(one).cause] += 1
            start = process_time()
            Detector(one.detection.bank, one.detection.config).detect(one.detection.photo)
            between = process_time()
            diagnose(one.detection, one.truth)
            costs.append((process_time() - between) / (between - start))
        right += said[cause]
        rows.append([cause, *(str(said[other] or "") for other in CAUSES)])
    total = each * len(MAKERS)
    table = markdown(["injected \\ diagnosed", *CAUSES], rows)
    return (
        f"{title}:\n\n{table}\n\n"
        f"The main cause is right in {right} of {total} ({right / total:.1%}). A diagnosis takes "
        f"{statistics.median(costs):.1f} times as long as the detection (median; at most "
        f"{max(costs):.1f})."
    )
