"""A report as one HTML file: nothing is loaded from anywhere, and nothing but its own script runs.

The page says so itself: its content security policy allows the very style sheet and the very
script that stand in it, by their digests, and pictures that are inside.
"""

from __future__ import annotations

import base64
import hashlib
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from skyline_viz import __version__
from skyline_viz.colours import ALTERNATIVE, HALO, PATH, TRUTH
from skyline_viz.diagnosis.by_cause import by_cause
from skyline_viz.diagnosis.record import Diagnosed
from skyline_viz.diagnosis.worth import Worth, worths
from skyline_viz.evaluation.results import PhotoResult, Summary
from skyline_viz.files import write_text
from skyline_viz.overlay import css
from skyline_viz.reports.charts import SIZE, charts
from skyline_viz.reports.costs import PLOT
from skyline_viz.reports.photo_report import PhotoReport
from skyline_viz.running.batch import Failure
from skyline_viz.system.names import printable

MOST_WORTHS = 8
"""Settings that are listed, of all photos."""

MOST_STAGES = 40
"""Photos whose stages are in a report: those of more would make it too large to be mailed."""

_BESIDE = "'self' file:"  # for a browser no file is of the same origin as another
_STATIC = Path(__file__).with_name("static")


@dataclass(frozen=True, eq=False)
class Report:
    """What a report is of."""

    title: str
    """The photo or the data set."""

    photos: Sequence[PhotoReport]
    """Its photos, in any order."""

    how: str = ""
    """How they were tested, in a few words."""

    results: Mapping[str, Sequence[PhotoResult]] = field(default_factory=dict)
    """What each method came to, by its name; that of the photos unless given."""

    failures: Sequence[Failure] = ()
    """Photos that are missing, and why."""

    notes: Sequence[str] = ()
    """What else there is to know, in sentences."""

    pages: Mapping[str, str] = field(default_factory=dict)
    """Where the page of each photo lies, by its name; what is there is not in this page."""

    back: str = ""
    """Where the page of all photos lies; nothing without one."""


def write_report(path: str | os.PathLike[str], report: Report) -> None:
    """Write a report, whole or not at all.

    Raises:
        OSError: It cannot be written.
    """
    write_text(path, page(report))


def page(report: Report) -> str:
    """A report as HTML."""
    photos = sorted(report.photos, key=_need)
    results = report.results or _own_results(photos)
    diagnosed = [one.diagnosed for one in photos if one.diagnosed]
    summaries = {name: Summary.of(found) for name, found in results.items() if found}
    notes = [*report.notes, *([] if report.pages else _left_out(photos))]
    shown = [one if at < MOST_STAGES else one.without_stages() for at, one in enumerate(photos)]
    alone = len(photos) == 1 and not report.pages
    style, script = f"{_colours()}\n{_part('report.css')}", _part("report.js")
    return _templates().get_template("report.html").render(
        title=report.title,
        how=report.how,
        photos=shown,
        alone=alone,
        pages=report.pages,
        back=report.back,
        tags=sorted({tag for one in photos for tag in one.tags}),
        summaries=summaries,
        charts=charts(results) if not alone and summaries else None,
        chart_size=SIZE,
        plot_size=PLOT,
        others=_of_others(photos, results),
        causes=by_cause(diagnosed) if diagnosed else [],
        worths=_worth_trying(diagnosed) if not alone else [],
        tried=any(one.remedies for one in diagnosed),
        right=sum(one.diagnosis.right for one in diagnosed),
        diagnosed=len(diagnosed),
        failures=report.failures,
        notes=notes,
        scales=dict.fromkeys(one.scale for photo in shown for one in photo.stages if one.scale),
        version=__version__,
        style=style,
        script=script,
        policy=policy(style, script, _BESIDE if report.pages else ""),
    )  # fmt: skip


def _worth_trying(diagnosed: Sequence[Diagnosed]) -> list[Worth]:
    """The settings that make the mean error smaller, that which does most first."""
    return [one for one in worths(diagnosed) if one.change < 0][:MOST_WORTHS]


def policy(style: str, script: str, images: str = "") -> str:
    """Content security policy of a page that holds all it needs, but for pictures perhaps.

    >>> policy("", "").split("; ")[:2]
    ["default-src 'none'", 'img-src data:']

    Args:
        style: Its style sheet.
        script: Its script.
        images: Where pictures may lie besides.
    """
    return "; ".join(
        [
            "default-src 'none'",
            f"img-src data: {images}".rstrip(),
            f"style-src '{_digest(style)}'",
            f"script-src '{_digest(script)}'",
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )


def _digest(text: str) -> str:
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode('ascii')}"


def _need(one: PhotoReport) -> tuple[bool, float, float, str]:
    """The order in which to look at photos: the worst first; without truth the least sure."""
    return one.a_err is None, -(one.a_err or 0.0), one.verdict.margin, one.name


def _own_results(photos: Sequence[PhotoReport]) -> dict[str, list[PhotoResult]]:
    found: dict[str, list[PhotoResult]] = {}
    for one in photos:
        if one.result is not None:
            found.setdefault(one.method, []).append(one.result)
    return found


def _of_others(
    photos: Sequence[PhotoReport], results: Mapping[str, Sequence[PhotoResult]]
) -> dict[str, list[tuple[str, float]]]:
    """What other methods came to on each photo, by its name."""
    found: dict[str, list[tuple[str, float]]] = {one.name: [] for one in photos}
    own = {one.name: one.method for one in photos}
    for method, mine in results.items():
        for one in mine:
            if one.name in own and own[one.name] != method:
                found[one.name].append((method, one.a_err))
    return found


def _left_out(photos: Sequence[PhotoReport]) -> list[str]:
    """What a long report does without, as a sentence."""
    if len(photos) <= MOST_STAGES:
        return []
    return [f"The stages of the first {MOST_STAGES} photos are in this file, to keep it small."]


def _colours() -> str:
    """The colours of lines, for the style sheet."""
    named = {"path": PATH, "truth": TRUTH, "mended": ALTERNATIVE, "halo": HALO}
    return f":root {{ {' '.join(f'--{name}: {css(one)};' for name, one in named.items())} }}"


def _part(name: str) -> str:
    return (_STATIC / name).read_text(encoding="utf-8")


@cache
def _templates() -> Environment:
    templates = Environment(
        loader=FileSystemLoader(_STATIC),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    templates.filters["shown"] = printable
    return templates
