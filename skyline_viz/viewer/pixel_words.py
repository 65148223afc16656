"""What is known of the path's pixel and the truth's in a column, as a table in Markdown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skyline_viz.arrays import Int
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.explanation import Explanation
from skyline_viz.viewer import entities

Walk = tuple[str, Int, Sequence[Explanation]]
"""Name of a line, places on the timeline ``(k,)``, and its pixels there."""

_NONE = "-"


def about_pixels(
    detection: Detection,
    walks: Sequence[Walk],
    times: Int,
    opening: int | None = entities.OPENING,
) -> list[str]:
    """A text for each place on the timeline.

    Args:
        detection: The detection.
        walks: The lines, that of the path first.
        times: All places.
        opening: The place of the column that is the worst one; None for none.
    """
    by_time = [(line, dict(zip(there.tolist(), told, strict=True))) for line, there, told in walks]
    texts = []
    for at in times.tolist():
        pixels = {line: told[at] for line, told in by_time if at in told}
        texts.append(_about(detection, pixels, opening=at == opening))
    return texts


def _about(detection: Detection, pixels: Mapping[str, Explanation], *, opening: bool) -> str:
    column = next(iter(pixels.values())).column
    head = f"**Column {column}**"
    if opening:
        head += ", the worst one: drag the *column* timeline, or click into a plot of *Columns*."
    compared = len(pixels) > 1
    names = [*pixels, *([" less ".join([*pixels][::-1])] if compared else [])]
    lines = [head, ""]
    for line, one in pixels.items():
        said = [one.why_edge, *(one.filtered.why if one.filtered else ())]
        if any(said):
            lines += [f"**{line.capitalize()}**: {'; '.join(part for part in said if part)}.", ""]
    lines += [f"| | {' | '.join(names)} |", f"| --- |{' ---: |' * len(names)}"]
    for title, values in _rows(pixels).items():
        lines.append(f"| {title} | {' | '.join(values + [''] * compared)} |")
    for term in [*detection.cost_model.nodal, None]:
        if term and not term.weight:
            continue
        paid = [one.terms[term.name] if term else one.cost for one in pixels.values()]
        words = [f"{value:.3f}" for value in paid]
        if compared:
            words.append(f"**{paid[1] - paid[0]:+.3f}**")
        title = f"pays for {term.name}" if term else "**nodal cost**"
        lines.append(f"| {title} | {' | '.join(words)} |")
    return "\n".join(lines)


def _rows(pixels: Mapping[str, Explanation]) -> dict[str, list[str]]:
    """What is told besides costs: titles, and a value for each pixel."""
    every = list(pixels.values())
    filtered = [one.filtered for one in every]
    rows = {
        "row": [str(one.row) for one in every],
        "edge": ["yes" if one.edge else "**no**" for one in every],
    }
    if all(filtered):
        known = [one for one in filtered if one]
        rows |= {
            "gradient": [_NONE if one.gradient is None else f"{one.gradient:.0f}" for one in every],
            "bin": [f"{one.bin}" for one in known],
            "its samples": [
                f"{one.samples:,}{' **starved**' if one.starved else ''}" for one in known
            ],
            "patch times filter": [f"{one.product.sum():.3f}" for one in known],
        }
    rows["score"] = [_NONE if one.score is None else f"{one.score:.3f}" for one in every]
    return rows
