"""Other lines than the one that is, as JSON: along other ridges, and those of other passes."""

from __future__ import annotations

from pydantic import BaseModel

from annotate.engine.guide import along
from annotate.store.operations import Take
from annotate.work.choices import Choice
from skyline_viz.certainty.other_lines import OtherLine
from skyline_viz.skyline import Skyline


class ShownAlternative(BaseModel):
    """Another line. A guide along its points, with its radius, chooses it, or what `take` says."""

    rows: list[int]
    detour: float
    """How much dearer than the line as it is."""

    apart: float
    """Share of columns in which it follows another ridge."""

    points: list[tuple[int, int]]
    radius: int
    name: str = ""
    """Whose line it is, where it is that of another pass."""

    take: Take | None = None
    """The operation that takes the line of another pass over, in the span in which they differ."""

    @classmethod
    def of_pass(cls, choice: Choice, line: Skyline) -> ShownAlternative:
        """Show the line of a pass beside the line as it is."""
        points, radius = along(choice.line.rows.astype(int))
        return cls(
            rows=choice.line.rows.astype(int).tolist(),
            detour=0.0,
            apart=round(float((choice.line.rows != line.rows).mean()), 4),
            points=points,
            radius=radius,
            name=choice.name,
            take=choice.take,
        )

    @classmethod
    def of(cls, line: OtherLine) -> ShownAlternative:
        """Show a line."""
        points, radius = along(line.rows)
        return cls(
            rows=line.rows.tolist(),
            detour=round(line.detour, 4),
            apart=round(line.apart, 4),
            points=points,
            radius=radius,
        )


class Alternatives(BaseModel):
    """Lines along other ridges: second opinions, then the cheapest ones; or those of passes."""

    alternatives: list[ShownAlternative]
