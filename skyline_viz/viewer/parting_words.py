"""Where two detections part, in words: a sentence, and a document."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from skyline_viz.diagnosis.parting import Part, Parting
from skyline_viz.system.names import named_in_markdown, shortened
from skyline_viz.viewer.report import listed_segments

_MOST = 32  # characters of a name in the document


def said(found: Parting) -> str:
    """Where two detections part, in a sentence without an end."""
    if found.at is None:
        return "all stages alike"
    if not found.apart:
        return f"part at {place(found.at)}, same line"
    words = [f"lines apart at {listed_segments(found.apart, most=2)}"]
    words.append(f"part at {place(found.on_lines or found.at)}")
    if found.turned_by:
        words.append(f"turned by {found.turned_by}")
    return "; ".join(words)


def place(part: Part) -> str:
    """A stage and a column: the first on the lines, where it differs there."""
    if part.only:
        return f"{part.title}, which only {shortened(part.only)} has"
    return f"{part.title}, column {part.on_lines[0] if part.on_lines else part.column}"


def markdown(found: Parting) -> str:
    """All that is known of where two detections part, as a Markdown document."""
    first, second = (named_in_markdown(shortened(name, _MOST)) for name in found.names)
    lines = [f"**{second}** (yellow) against **{first}** (magenta)", ""]
    if found.a_errs:
        one, other = found.a_errs
        lines += [
            f"**A_err** {first} {one:.2f} px, {second} {other:.2f} px: {other - one:+.2f} px  "
        ]
    apart = f"apart in columns {listed_segments(found.apart)}" if found.apart else "nowhere apart"
    lines += [
        f"**Lines** {apart}; mean distance {found.distance:.2f} px, "
        f"largest {found.furthest:.0f} px  ",
        f"**They part** {_where(found)}  ",
        f"**Maps** red where {second} has more, blue where {first} has; edges of both are grey.",
    ]
    if found.turns:
        lines += [
            "",
            f"**Turned by {found.turned_by or 'nothing'}.** {_about_turns(first, second)}",
        ]
        rows = [
            (one.term, f"{one.first:+.1f}", f"{one.second:+.1f}", f"{one.change:+.1f}")
            for one in found.turns
            if one.first or one.second or one.change
        ]
        lines += _table(("term", first, second, "change"), rows)
    if found.settings:
        lines += ["", "**Settings that differ**"]
        told = [(one.name, one.first, one.second) for one in found.settings]
        lines += _table(("setting", first, second), (map(named_in_markdown, one) for one in told))
    if found.parts:
        lines += ["", "**What differs**, in the order in which it is made"]
        head = ("what", "first column", "columns", "on the lines", "largest")
        lines += _table(head, map(_row, found.parts))
    return "\n".join(lines) + "\n"


def _where(found: Parting) -> str:
    if found.at is None:
        return "nowhere: all stages are alike."
    told = f"first at {named_in_markdown(place(found.at))}"
    if found.on_lines and found.on_lines is not found.at:
        told += (
            f"; where the lines are apart, on them, at {named_in_markdown(place(found.on_lines))}"
        )
    return f"{told}."


def _about_turns(first: str, second: str) -> str:
    return (
        f"What the line of {second} pays more than that of {first}, by the costs of each; "
        "the term whose change speaks most for it comes first."
    )


def _row(part: Part) -> tuple[str, ...]:
    if part.only:
        return part.title, f"only {named_in_markdown(part.only)} has it", "", "", ""
    largest = {"edges": "", "bin": ""}.get(part.name, f"{part.largest:+.3g} {part.unit}")
    return part.title, f"{part.column}", f"{part.columns}", f"{len(part.on_lines)}", largest


def _table(head: Sequence[str], rows: Iterable[Iterable[str]]) -> list[str]:
    rule = ["---", *["---:"] * (len(head) - 1)]
    return ["", *(f"| {' | '.join(row)} |" for row in (head, rule, *rows))]
