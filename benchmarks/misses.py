"""The gross misses of a detector, photo by photo, each with what `diagnose` says of it."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.left_out import LeftOut, Results, Variant
from benchmarks.table import markdown
from skyline_viz import Detector, diagnose
from skyline_viz.datasets.item import Item, photo_and_truth


def explained(left_out: LeftOut, variant: Variant, results: Results) -> str:
    """A line for each wrong segment of each gross miss, source by source, the worst photo first.

    Args:
        left_out: The sources, and what their detectors have learned.
        variant: The detector.
        results: What was measured of it.
    """
    if not results:
        return ""
    title = "### The gross misses of the default, and why"
    rows = []
    for source in left_out.sources:
        gross = [one for one in results.get(source.name, ()) if one.gross_miss]
        detector = left_out.detector(variant, source.place) if gross else None
        if detector:
            items = {item.name: item for item in source.items}
            for one in sorted(gross, key=lambda one: -one.a_err):
                rows += _lines(detector, items[one.name], f"{one.a_err:.0f} px")
    if not rows:
        return f"{title}\n\nThere are none."
    header = ["photo", "A_err", "columns", "off by", "cause", "what is missing"]
    return f"{title}\n\n{markdown(header, rows)}"


def _lines(detector: Detector, item: Item, a_err: str) -> Iterator[list[str]]:
    """The segments that make up most of the error, the worst first."""
    photo, truth = photo_and_truth(item)
    segments = diagnose(detector.detect(photo), truth).by_error
    enough = 0.8 * sum(one.total_error for one in segments)
    told = 0.0
    for place, one in enumerate(segments):
        if told > enough:
            return
        told += one.total_error
        also = f", with {' and '.join(one.contributing)}" if one.contributing else ""
        first, last = one.columns
        yield [
            "" if place else item.name,
            "" if place else a_err,
            f"{first} to {last}",
            f"{one.mean_error:.0f} px",
            f"{one.cause}{also}",
            " ".join(one.evidence.replace("|", "/").split()),
        ]
