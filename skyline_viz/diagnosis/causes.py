"""The causes of a wrong skyline, by name; `skyline_viz.diagnosis` says what each one means."""

from typing import Literal, TypeAlias, get_args

Cause: TypeAlias = Literal[
    "truth doubtful", "missed edge", "starved bin", "misjudged", "too steep", "cheaper path"
]
"""Why a segment went wrong."""

CAUSES: tuple[Cause, ...] = get_args(Cause)
