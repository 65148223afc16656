"""The short report of a detection, in Markdown."""

from __future__ import annotations

from collections.abc import Sequence

from skyline_viz.detection import Detection
from skyline_viz.evaluation.metrics import TOLERANCE, scaled
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.system.names import named_in_markdown

_MOST_SEGMENTS = 6


def report(name: str, detection: Detection, verdict: Verdict, shown: int, near: str = "") -> str:
    """Say how good a detection is, how sure, how long it took, and how it was made.

    Args:
        name: Name of the photo, or what to call it.
        detection: The detection.
        verdict: What it comes to.
        shown: Number of edge pixels that the maps show.
        near: What the maps show of a large photo, as a sentence, see `near.Near`.
    """
    height, width = detection.edges.shape
    edges = len(detection.scores)
    few = near or shown < edges
    lines = [
        f"**{named_in_markdown(name or 'photo')}**  ",
        f"{width} x {height} px",
        "",
        *_verdict(verdict, height),
        "",
        *([f"{detection.visibility.said}  "] if detection.visibility else []),
        f"{detection.certainty.said}  ",
        f"**Margin** {verdict.margin:.3g}, least sure at column {verdict.unsure_column}  ",
        f"**Edges** {edges:,} pixels ({edges / (width * height):.0%})  ",
        *([f"{near or f'Maps show the {shown:,} cheapest of their columns'}  "] if few else []),
        f"**Path cost** {detection.path_cost:.4g}  ",
    ]
    stages = ", ".join(f"{one} {1000 * took:.0f}" for one, took in detection.seconds.items())
    how = " ".join(named_in_markdown(one) for one in detection.about())
    lines += [f"**Time** {1000 * detection.total_seconds:.0f} ms: {stages}", "", how]
    return "\n".join(lines) + "\n"


def listed_segments(segments: Sequence[tuple[int, int]], most: int = _MOST_SEGMENTS) -> str:
    """Columns of segments, in words.

    >>> listed_segments([(3, 9), (40, 40)])
    '3 to 9, 40'
    """
    words = [f"{first} to {last}" if first < last else f"{first}" for first, last in segments]
    more = len(words) - most
    return ", ".join(words[:most]) + (f" and {more} more" if more > 0 else "")


def _verdict(verdict: Verdict, height: int) -> list[str]:
    if verdict.a_err is None or verdict.segments is None:
        return ["*There is no truth to compare with.*"]
    gross = "  \n**A gross miss**: over 5 % of the height." if verdict.gross_miss else ""
    wrong = listed_segments(verdict.segments)
    return [
        f"**A_err {verdict.a_err:.2f} px**{gross}  ",
        f"**Worst** {verdict.worst_error:.1f} px at column {verdict.worst_column}  ",
        f"**Wrong columns** {wrong}"
        if wrong
        else f"No column is off by more than {scaled(TOLERANCE, height):.3g} px.",
    ]
