"""Sweeps as Rerun entities: one timeline a setting, the same entities on all of them.

The viewer shows what was logged on the timeline that is chosen, and nothing else. So whatever
should stay in sight while a setting is scrubbed is logged at the first step of its timeline, too.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import rerun as rr

from skyline_viz.colours import ALTERNATIVE, PATH
from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.sweep import Step, Sweep
from skyline_viz.evaluation.metrics import TOLERANCE, scaled, wrong_segments
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.skyline import Skyline
from skyline_viz.stage import COST
from skyline_viz.viewer import entities
from skyline_viz.viewer.column_views import ALTERNATIVE_RADIUS, log_line
from skyline_viz.viewer.documents import markdown_document
from skyline_viz.viewer.maps.stage_maps import encoded_edges, shown_pixels
from skyline_viz.viewer.maps.value_maps import COARSE, sparse_map
from skyline_viz.viewer.report import listed_segments

_AXIS = (0x60, 0x60, 0x60)
_PRESENT = f"{entities.SWEEP_ERROR}/present"
_ZERO = f"{entities.SWEEP_ERROR}/zero"  # lest the plot magnify what hardly differs


@dataclass(frozen=True)
class _Outcome:
    """What a value comes to."""

    step: Step
    verdict: Verdict
    apart: float
    """Mean distance from the present path, in pixels."""
    words: str
    """How it differs from the present path."""

    @property
    def error(self) -> float:
        """A_err; without a truth the distance from the present path. In pixels."""
        return self.apart if self.verdict.a_err is None else self.verdict.a_err


def opening_of(sweep: Sweep) -> int:
    """Where the timeline of a sweep begins, and the viewer opens it.

    It is 0, which shows the present value, in front of the others; or the first of these where
    that is 0.
    """
    return min(entities.OPENING, sweep.steps[0].at)


def log_sweeps(
    recording: rr.RecordingStream,
    sweeps: Sequence[Sweep],
    found: FilterDetection,
    truth: Skyline | None = None,
    advance: Callable[[], None] = lambda: None,
) -> None:
    """Detect with each value of each sweep, and log paths, edges, costs, errors and reports.

    On the timelines `entities.IMAGE` and `entities.COLUMN`, which hold no sweep, and where that of
    a setting opens before its values, see `opening_of`, the same entities show the present path and
    the table of all settings.

    Args:
        recording: Where to; afterwards it is at no time at all.
        sweeps: The sweeps.
        found: The detection around which they were made.
        truth: The true skyline.
        advance: Called after each value.
    """
    for entity, look in (
        (entities.SWEEP_ERROR, rr.SeriesLines(colors=[ALTERNATIVE], widths=[2.0])),
        (_PRESENT, rr.SeriesPoints(colors=[PATH], marker_sizes=[5.0], markers=["diamond"])),
        (_ZERO, rr.SeriesLines(colors=[_AXIS], widths=[1.0])),
    ):
        recording.log(entity, look, static=True)
    outcomes = {}
    for sweep in sweeps:
        recording.reset_time()
        outcomes[sweep.timeline] = _log_sweep(recording, sweep, found, truth, advance)
    now = Verdict.of(found.skyline, found.margins(), len(found.photo), truth)
    summary = _summary(sweeps, outcomes, now)
    for sweep in sweeps:
        recording.reset_time()
        for outcome in outcomes[sweep.timeline]:
            recording.set_time(sweep.timeline, sequence=outcome.step.at)
            recording.log(
                entities.SWEEP_REPORT, markdown_document(_report(sweep, outcome, now, summary))
            )
    recording.reset_time()
    recording.set_time(entities.IMAGE, sequence=0)
    recording.set_time(entities.COLUMN, sequence=0)
    for sweep in sweeps:
        if opening_of(sweep) < sweep.steps[0].at:
            recording.set_time(sweep.timeline, sequence=opening_of(sweep))
    _log_stages(recording, found, truth, None)
    words = (
        f"**The present settings**\n\nChoose a setting's timeline below, and drag it.\n\n{summary}"
    )
    recording.log(entities.SWEEP_REPORT, markdown_document(words))
    recording.reset_time()


def _log_sweep(
    recording: rr.RecordingStream,
    sweep: Sweep,
    found: FilterDetection,
    truth: Skyline | None,
    advance: Callable[[], None],
) -> list[_Outcome]:
    """Log all of a sweep but its reports."""
    outcomes = []
    before: Detection | None = None
    for step, detection in sweep.detections(found):
        recording.set_time(sweep.timeline, sequence=step.at)
        _log_stages(recording, detection, truth, before)
        outcome = _outcome(step, detection, found, truth)
        recording.log(entities.SWEEP_ERROR, rr.Scalars(outcome.error))
        recording.log(_ZERO, rr.Scalars(0.0))
        if step.at == sweep.present:
            recording.log(_PRESENT, rr.Scalars(outcome.error))
        outcomes.append(outcome)
        before = detection
        advance()
    return outcomes


def _log_stages(
    recording: rr.RecordingStream,
    detection: Detection,
    truth: Skyline | None,
    before: Detection | None,
) -> None:
    """Log path, edges and cost; the last two only where they are others than before."""
    log_line(recording, entities.SWEEP_PATH, detection.skyline, ALTERNATIVE, ALTERNATIVE_RADIUS)
    if before is None or before.edges is not detection.edges:
        recording.log(entities.SWEEP_EDGES, encoded_edges(detection.edges))
    if before is None or before.cost is not detection.cost:
        kept = shown_pixels(detection, truth)
        rows, columns = detection.edge_rows[kept], detection.edge_columns[kept]
        costs = detection.cost[rows, columns]
        shown = sparse_map(COST, detection.edges.shape, rows, columns, costs, COARSE)
        shown.log(recording, entities.SWEEP_COST)


def _outcome(
    step: Step, detection: Detection, found: FilterDetection, truth: Skyline | None
) -> _Outcome:
    height = len(found.photo)
    verdict = Verdict.of(detection.skyline, detection.margins(), height, truth)
    apart = np.abs(detection.skyline.rows - found.skyline.rows).astype(np.float64)
    words = "The same path as now."
    if apart.any():
        segments = wrong_segments(apart, height)
        allowed = f"{scaled(TOLERANCE, height):.3g} px"
        where = (
            f"over {allowed} in columns {listed_segments(segments)}"
            if segments
            else f"nowhere over {allowed}"
        )
        words = (
            f"Apart from the present path: {apart.mean():.2f} px in the mean, "
            f"{apart.max():.0f} px at most, {where}."
        )
    return _Outcome(step, verdict, float(apart.mean()), words)


def _report(sweep: Sweep, outcome: _Outcome, now: Verdict, summary: str) -> str:
    """All about a value, in Markdown."""
    verdict = outcome.verdict
    lines = [f"**{sweep.title} {outcome.step.value}**, now {sweep.now}", ""]
    if verdict.a_err is not None:
        gross = ", **a gross miss**" if verdict.gross_miss else ""
        lines += [
            f"**A_err {verdict.a_err:.2f} px**{gross}, now {now.a_err:.2f} px  ",
            f"Worst {verdict.worst_error:.1f} px at column {verdict.worst_column}  ",
        ]
    lines += [f"Margin {verdict.margin:.3g}, now {now.margin:.3g}", "", outcome.words]
    if sweep.note:
        lines += ["", sweep.note]
    counts = f"The timeline *{sweep.timeline}* counts {sweep.counts}."
    return "\n".join([*lines, "", counts, "", summary])


def _summary(sweeps: Sequence[Sweep], outcomes: dict[str, list[_Outcome]], now: Verdict) -> str:
    """What each setting can do, as a table in Markdown."""
    with_truth = now.a_err is not None
    head = "best A_err" if with_truth else "moves the path by"
    lines = [f"| setting | {head} | with |", "| --- | --- | --- |"]
    sign = 1 if with_truth else -1
    for sweep in sweeps:

        def rank(one: _Outcome, sweep: Sweep = sweep) -> tuple[float, int]:
            """Of values that are as good as each other the nearest to the present one is named."""
            return sign * round(one.error, 2), abs(one.step.at - sweep.present)

        best = min(outcomes[sweep.timeline], key=rank)
        lines.append(f"| {sweep.title} | {best.error:.2f} px | {best.step.value} |")
    return "\n".join(lines) + "\n"
