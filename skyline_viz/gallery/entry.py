"""A photo of a gallery, and what its detection came to, as it is kept."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skyline_viz.diagnosis.causes import Cause
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.frames.visibility import Case
from skyline_viz.gallery.documents import GalleryError, made
from skyline_viz.stage import Quantity
from skyline_viz.viewer.report import listed_segments


@dataclass(frozen=True)
class Entry:
    """A photo of a gallery, and what its detection came to."""

    name: str
    """Unique in the gallery; also the name of its recording."""

    photo: str
    """The photo's file."""

    made_from: str
    """Digest of photo, truth, filter bank and configuration."""

    height: int
    """Rows of the photo."""

    width: int
    """Its columns."""

    verdict: Verdict
    """What the detection came to."""

    stages: tuple[Quantity, ...] = ()
    """The stages that its recording holds."""

    causes: tuple[Cause, ...] | None = None
    """Why it went wrong, see `diagnosis.Diagnosis.causes`; nothing where it is right, None without
    a truth."""

    titles: tuple[str, ...] = ()
    """The causes with the terms and the places that they name, see `diagnosing.Segment.title`, each
    once, that of the main segment first."""

    confidence: float | None = None
    """Probability that its line is no gross miss, see `certainty.confidence`."""

    shows: Case | None = None
    """Whether it has a skyline, and one visible everywhere; None of methods that cannot tell."""

    method: str = "default"
    """Name of the method."""

    seen: str = ""
    """What has seen the photo in training, see `evaluation.seen.seen_in_training`."""

    compared: str = ""
    """Name of the method beside the first; nothing without one."""

    other_a_err: float | None = None
    """Mean error of its line in pixels."""

    difference: float | None = None
    """Mean distance between both lines, in pixels."""

    parts_at: str = ""
    """Stage or term, and column, at which both part, see `parting_words.place`; nothing where all
    is alike."""

    turned_by: str = ""
    """The term that turned the path, see `parting.Turn`; nothing where none did."""

    @property
    def change(self) -> float | None:
        """How much larger A_err of the second method is; None without one, or without a truth."""
        if self.other_a_err is None or self.verdict.a_err is None:
            return None
        return self.other_a_err - self.verdict.a_err

    @property
    def cause(self) -> Cause | None:
        """The main cause."""
        return self.causes[0] if self.causes else None

    @property
    def wrong(self) -> str:
        """The segments that went wrong, in words."""
        return listed_segments(self.verdict.segments or (), most=2)


def by_need(entries: Sequence[Entry]) -> list[Entry]:
    """Entries in the order in which to look at them.

    Where two methods are compared, those first on which the second is worse, the largest change of
    A_err before, and those last on which it is better; without a truth, those before on which they
    differ most. Else those with a truth first, the largest error before; then those without, the
    least sure before.
    """
    return sorted(
        entries,
        key=lambda one: (
            one.change is None,
            -(one.change or 0.0),
            -(one.difference or 0.0),
            one.verdict.a_err is None,
            -(one.verdict.a_err or 0.0),
            one.verdict.margin,
            one.name,
        ),
    )


def read_entry(path: Path, values: dict[str, Any]) -> Entry:
    """An entry as `asdict` took it apart, put together again.

    Args:
        path: The gallery's file.
        values: What it says of the photo.

    Raises:
        GalleryError: Something is missing, or there is more.
    """
    try:
        told = dict(values["verdict"])
        if told["segments"] is not None:
            told["segments"] = tuple((int(a), int(b)) for a, b in told["segments"])
        if values["causes"] is not None:
            values["causes"] = tuple(values["causes"])
        values["titles"] = tuple(values["titles"])
        stages = tuple(
            Quantity(**{**one, "span": tuple(one["span"]), "tabs": tuple(one["tabs"])})
            for one in values["stages"]
        )
        verdict = Verdict(**told)
    except (LookupError, TypeError, ValueError) as error:
        raise GalleryError(f"{path} is damaged: {error}.") from error
    entry: Entry = made(Entry, path, {**values, "verdict": verdict, "stages": stages})
    return entry
