"""The causes of a wrong skyline, by name; `skyline_viz.diagnosis` says what each one means."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal, TypeAlias, get_args

Cause: TypeAlias = Literal[
    "truth doubtful", "missed edge", "starved bin", "misjudged", "too steep", "cheaper path"
]
"""Why a segment went wrong."""

CAUSES: tuple[Cause, ...] = get_args(Cause)

DOUBTFUL: Cause = "truth doubtful"
"""The cause of segments whose annotation is to be checked."""

TERMS: Mapping[Cause, str] = MappingProxyType(
    {
        "missed edge": "no edge",
        "starved bin": "score",
        "misjudged": "score",
        "too steep": "link",
    }
)
"""The term of the cost by which the truth loses, where the cause says it: a cheaper path names its
own terms, see `trials.Trials.preferring`, and of a doubtful truth there are none."""

Place: TypeAlias = Literal["cloud above", "haze", "wire", "snow", "frame", "foreground ridge"]
"""Where a path leaves the truth, by what is measured there, see `places.place_of`."""

PLACES: tuple[Place, ...] = get_args(Place)

Preferring: TypeAlias = Literal["score", "strength", "no edge", "clear sky", "sky", "link"]
"""The terms of our detector, by which a path is cheaper."""


def filter_words(wanted: Cause | Place | Preferring) -> str:
    """What stands in the title of segments with a cause, a place, or a term that prefers the path.

    >>> filter_words("haze"), filter_words("sky")
    ('haze', 'by sky')
    """
    return f"by {wanted}" if wanted in get_args(Preferring) else wanted
