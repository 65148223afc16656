"""The short report of a detection, in Markdown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields

from skyline_viz.config import DetectorConfig
from skyline_viz.detection import Detection
from skyline_viz.detector import FilterDetection
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.system.names import named_in_markdown

_MOST_SEGMENTS = 6


def report(name: str, detection: Detection, verdict: Verdict, shown: int) -> str:
    """Say how good a detection is, how sure, how long it took, and how it was made.

    Args:
        name: Name of the photo, or what to call it.
        detection: The detection.
        verdict: What it comes to.
        shown: Number of edge pixels that the maps show.
    """
    height, width = detection.edges.shape
    edges = len(detection.scores)
    lines = [
        f"**{named_in_markdown(name or 'photo')}**  ",
        f"{width} x {height} px",
        "",
        *_verdict(verdict),
        "",
        f"**Margin** {verdict.margin:.3g}, least sure at column {verdict.unsure_column}  ",
        f"**Edges** {edges:,} pixels ({edges / (width * height):.0%}){_thresholds(detection)}  ",
        *([f"Maps show the {shown:,} cheapest of their columns  "] if shown < edges else []),
        f"**Path cost** {detection.path_cost:.4g}  ",
    ]
    stages = ", ".join(f"{one} {1000 * took:.0f}" for one, took in detection.seconds.items())
    lines += [f"**Time** {1000 * detection.total_seconds:.0f} ms: {stages}", "", _how(detection)]
    return "\n".join(lines) + "\n"


def listed_segments(segments: Sequence[tuple[int, int]], most: int = _MOST_SEGMENTS) -> str:
    """Columns of segments, in words.

    >>> listed_segments([(3, 9), (40, 40)])
    '3 to 9, 40'
    """
    words = [f"{first} to {last}" if first < last else f"{first}" for first, last in segments]
    more = len(words) - most
    return ", ".join(words[:most]) + (f" and {more} more" if more > 0 else "")


def settings_changed(config: DetectorConfig) -> list[str]:
    """Settings that differ from the defaults.

    >>> settings_changed(DetectorConfig(delta=1))
    ['delta 1']
    """
    default = DetectorConfig()
    return [
        f"{field.name} {getattr(config, field.name)}"
        for field in fields(config)
        if getattr(config, field.name) != getattr(default, field.name)
    ]


def _verdict(verdict: Verdict) -> list[str]:
    if verdict.a_err is None or verdict.segments is None:
        return ["*There is no truth to compare with.*"]
    gross = "  \n**A gross miss**: over 5 % of the height." if verdict.gross_miss else ""
    wrong = listed_segments(verdict.segments)
    return [
        f"**A_err {verdict.a_err:.2f} px**{gross}  ",
        f"**Worst** {verdict.worst_error:.1f} px at column {verdict.worst_column}  ",
        f"**Wrong columns** {wrong}" if wrong else "No column is wrong by over 1 % of the height.",
    ]


def _thresholds(detection: Detection) -> str:
    if not isinstance(detection, FilterDetection):
        return ""
    low, high = detection.thresholds
    return f", Canny {low:.0f} and {high:.0f}"


def _how(detection: Detection) -> str:
    if not isinstance(detection, FilterDetection):
        return f"Method {detection.method}."
    if detection.config == DetectorConfig.paper():
        settings = "the paper's settings"
    else:
        settings = ", ".join(settings_changed(detection.config)) or "default settings"
    made = detection.bank.provenance
    bank = (
        f"{made.images} photos of {named_in_markdown(made.dataset)}"
        if made.images
        else "an unknown source"
    )
    return f"{settings.capitalize()}; filters learned from {bank}."
