"""What a recording holds, which decides how the viewer lays it out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from skyline_viz.detection import Detection
from skyline_viz.stage import ADDED, FUSED, OURS, Quantity, of_term
from skyline_viz.system.memory import FULL_MEGAPIXELS
from skyline_viz.viewer.maps.stage_maps import shown_terms

Fidelity: TypeAlias = Literal["lean", "full", "exact"]
"""How much is kept.

*lean*, for data sets: the photo as JPEG; maps, in 255 levels, of the `stage_maps.LEAN_PIXELS`
cheapest edge pixels of each column, and of those on the path and on the truth.
*full*, for a photo: the photo without loss; tensor, cost and detour of every pixel, score and bin
of every edge pixel, to four digits on hovering, and exact as numbers. Of photos of more than
`FULL_MEGAPIXELS` they are kept near the lines, see `near.Near`, and the report says so.
*exact*: the same of all pixels, however large the photo is.
"""


def fidelity_of(
    pixels: int, full_megapixels: float = FULL_MEGAPIXELS, *, alone: bool = False
) -> Fidelity:
    """How much to keep of photos of so many pixels in all.

    Args:
        pixels: How many.
        full_megapixels: Million pixels that may all be kept.
        alone: Whether it is a single photo, which is kept near its lines if it is larger, unless
            less than usual is wanted.

    >>> fidelity_of(1388 * 519), fidelity_of(20000 * 2000), fidelity_of(20000 * 2000, alone=True)
    ('full', 'lean', 'full')
    >>> fidelity_of(20000 * 2000, 40)
    'exact'
    """
    if pixels <= full_megapixels * 1e6:
        return "full" if pixels <= FULL_MEGAPIXELS * 1e6 else "exact"
    return "full" if alone and full_megapixels >= FULL_MEGAPIXELS else "lean"


@dataclass(frozen=True)
class MethodContents:
    """What a recording holds of another method."""

    name: str
    """Its name."""

    stages: tuple[Quantity, ...] = OURS
    """Its stages, in their order."""

    @classmethod
    def of(cls, detection: Detection) -> MethodContents:
        """What a recording holds of a detection."""
        return cls(detection.method, _shown(detection))


@dataclass(frozen=True)
class Contents:
    """What a recording holds, which decides about its views."""

    height: int
    """Rows of the photo, of the first one where there are several."""

    width: int
    """Its columns."""

    one_size: bool = True
    """Whether all photos are as large as that: then views show a photo's pixels and no more. Else
    each view fits itself to what is in it."""

    truth: bool = False
    """Whether there is a truth."""

    stages: tuple[Quantity, ...] = OURS
    """The stages that are in it, in their order; those of our detector unless given."""

    terms: tuple[Quantity, ...] = ()
    """The terms of the nodal cost whose maps are in it."""

    search: bool = False
    """Whether the maps of the search for the path are in it, see `stage_maps.SEARCH`."""

    lean: bool = False
    """Whether maps hold the cheapest edge pixels of each column only."""

    bank: bool = True
    """Whether the filter bank is in it."""

    columns: bool = False
    """Whether the `entities.COLUMN` timeline is in it: the pixels of path and truth, and plots."""

    photos: int = 1
    """Number of photos on the `entities.IMAGE` timeline."""

    diagnosed: bool = False
    """Whether there is a diagnosis with failing segments."""

    compared: str = ""
    """Name of the second detection; nothing without one."""

    first: str = "the first"
    """Name of the first, where there is a second."""

    apart: tuple[Quantity, ...] = ()
    """Maps of what the second has more than the first, see `comparison.log_comparison`."""

    compared_stages: tuple[Quantity, ...] = OURS
    """Its stages, in their order."""

    methods: tuple[MethodContents, ...] = ()
    """Other methods on the photo."""

    other_lines: int = 0
    """Number of lines along other ridges that are in it."""

    swept: str = ""
    """Timeline of the setting that is swept first; nothing without a sweep."""

    @classmethod
    def of(cls, detection: Detection, fidelity: Fidelity, **more: Any) -> Contents:  # noqa: ANN401
        """What a recording of a detection holds.

        Args:
            detection: The detection, of the first photo where there are several.
            fidelity: How much is kept of it.
            more: What else there is to say, by the names of the fields.
        """
        height, width = detection.edges.shape
        full = fidelity != "lean"
        paying = shown_terms(detection)
        terms = tuple(of_term(term.name) for term in paying)
        if any(term.paid_by == "all" for term in paying):
            terms = *terms, ADDED
        bank = full and detection.bank is not None
        return cls(
            height,
            width,
            stages=tuple(one for one in _shown(detection) if full or one != FUSED),
            terms=terms if full else (),
            search=full,
            lean=not full,
            bank=bank,
            **more,
        )


def _shown(detection: Detection) -> tuple[Quantity, ...]:
    """Stages that have a view: where all pixels are edges, there is nothing to see in these."""
    everywhere = bool(detection.edges.all())
    stages = [one for one in detection.quantities if one.tabs]
    return tuple(one for one in stages if not (everywhere and one.name == "edges"))
