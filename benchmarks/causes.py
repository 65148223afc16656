"""Diagnoses of failures whose cause is known, and what they cost."""

import statistics
from collections import Counter
from pathlib import Path
from time import process_time

from benchmarks.table import markdown
from skyline_viz.datasets.layouts import open_dataset
from skyline_viz.detector import Detector
from skyline_viz.diagnosis.causes import CAUSES, PLACES
from skyline_viz.diagnosis.diagnosing import diagnose
from testing.injected import (
    CONSULTED,
    FAMILIAR,
    MAKERS,
    NEW,
    PLACE_MAKERS,
    UNSEEN,
    Injected,
    cases,
    main_cause,
)

EACH = 40
"""Cases of each cause."""

SAMPLES = Path(__file__).resolve().parents[1] / "sample_data"


def confusion(each: int = EACH) -> str:
    """Confusion matrices of injected and diagnosed causes."""
    return "\n\n".join(
        [
            "## Diagnoses of failures of a known cause, put into rendered scenes",
            _matrix(UNSEEN, each, "Scenes that were first used when the rules stood"),
            _matrix(CONSULTED, each, "Scenes by which the rules were checked while being made"),
            _matrix(FAMILIAR, each, "The scenes by which the rules were made"),
            _places(NEW, each, "Places, painted into scenes that were first used for this"),
            _dearest(),
        ]
    )


def _matrix(first_scene: int, each: int, title: str) -> str:
    rows, right, proved, costs = [], 0, 0, []
    for cause in MAKERS:
        said = Counter()
        for one in cases(cause, each, first_scene):
            segment = main_cause(one)
            said[segment.cause] += 1
            proved += segment.cause == cause and segment.proof is not None
            costs.append(_cost(Detector(one.detection.bank, one.detection.config), one))
        right += said[cause]
        rows.append([cause, *(str(said[other] or "") for other in CAUSES)])
    total = each * len(MAKERS)
    table = markdown(["injected \\ diagnosed", *CAUSES], rows)
    return (
        f"{title}:\n\n{table}\n\n"
        f"The main cause is right in {right} of {total} ({right / total:.1%}); {proved} of these "
        f"are proved: with just what is named made right, the path comes back. A diagnosis takes "
        f"{statistics.median(costs):.1f} times as long as the detection (median; at most "
        f"{max(costs):.1f})."
    )


def _places(first_scene: int, each: int, title: str) -> str:
    rows, right, named = [], 0, 0
    for place in PLACE_MAKERS:
        said = Counter()
        for one in cases(place, each, first_scene):
            segment = main_cause(one)
            said[segment.place] += 1
            named += bool(segment.terms and segment.proof)
        right += said[place]
        rows.append([place, *(str(said[other] or "") for other in (*PLACES, None))])
    total = each * len(PLACE_MAKERS)
    table = markdown(["painted \\ diagnosed", *PLACES, "none"], rows)
    return (
        f"{title}:\n\n{table}\n\nThe place is right in {right} of {total} ({right / total:.1%}). "
        f"In {named} a proved cause names a term."
    )


def _dearest() -> str:
    """How long diagnoses of the samples take, whose segments can be as wide as the photo."""
    detector, costs = Detector(), {}
    for item in open_dataset(SAMPLES):
        photo = item.photo()
        costs[item.name] = _cost(
            detector, Injected("", detector.detect(photo), item.truth(), (0, 0))
        )
    name = max(costs, key=costs.get)
    return (
        f"Of the samples the dearest diagnosis, that of {name}, takes {costs[name]:.1f} times as "
        f"long as the detection (median {statistics.median(costs.values()):.1f})."
    )


def _cost(detector: Detector, one: Injected) -> float:
    """How many detections a diagnosis takes as long as."""
    start = process_time()
    detector.detect(one.detection.photo)
    between = process_time()
    diagnose(one.detection, one.truth)
    return (process_time() - between) / (between - start)
