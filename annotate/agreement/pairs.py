"""Two labels of one photo, column by column, and two passes, photo by photo."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from annotate.store.labels import Label, named
from skyline_viz.arrays import F64, Int, runs

Pass: TypeAlias = tuple[str, int]
"""An annotator, and the number of the pass."""

Made: TypeAlias = Literal["both proposed", "one blind", "both blind"]
"""How two labels were made: from a proposal, or without one."""

NEAR = 1 / 100
"""Part of a photo's width: spans in which lines differ that are nearer to each other are one."""


@dataclass(frozen=True, eq=False)
class Pair:
    """Two accepted labels of a photo."""

    first: Label
    second: Label

    differences: F64
    """``(m,)`` rows of the second less those of the first, in the columns that are visible in both:
    above 0 where the second line lies lower. There may be no such column."""

    seen: Int
    """``(2, 2)`` number of columns, by whether they are visible in the first and in the second."""

    @classmethod
    def of(cls, first: Label, second: Label) -> Pair | None:
        """Compare two labels; None where one of them has no line."""
        if first.skyline is None or second.skyline is None:
            return None
        one, other = first.skyline, second.skyline
        both = one.visible & other.visible
        cells = 2 * one.visible.astype(np.intp) + other.visible
        return cls(
            first,
            second,
            (other.rows.astype(np.float64) - one.rows)[both],
            np.bincount(cells, minlength=4).reshape(2, 2).astype(np.int32),
        )

    @property
    def apart(self) -> F64:
        """``(m,)`` how far the lines are from each other, in pixels."""
        return np.abs(self.differences)

    @property
    def mean(self) -> float:
        """Mean difference, in pixels; no number where no column is visible in both."""
        return float(self.apart.mean()) if len(self.differences) else float("nan")

    @property
    def worst(self) -> float:
        """Largest difference, in pixels; 0 where no column is visible in both."""
        return float(self.apart.max(initial=0.0))

    @property
    def made(self) -> Made:
        """Whether they were proposed, or labelled blind."""
        if self.first.blind and self.second.blind:
            return "both blind"
        return "one blind" if self.first.blind or self.second.blind else "both proposed"

    def span(self, within: float) -> tuple[int, int] | None:
        """First and last column of the span with most pixels between the lines.

        Args:
            within: Lines that are no further from each other do not differ there.

        Returns:
            None where they differ nowhere.
        """
        one, other = self.first.skyline, self.second.skyline
        assert one is not None
        assert other is not None
        between = np.where(one.visible & other.visible, np.abs(one.rows - other.rows), 0.0)
        spans = runs(between > within, gap=round(NEAR * one.width))
        area = np.concatenate([[0.0], np.cumsum(between, dtype=np.float64)])
        return max(spans, key=lambda span: area[span[1] + 1] - area[span[0]], default=None)


@dataclass(frozen=True, eq=False)
class Comparison:
    """Two passes."""

    first: Pass
    second: Pass

    pairs: tuple[Pair, ...]
    """Photos that both have accepted, the ones that differ most in the mean first."""

    decided_otherwise: int
    """Number of photos that one has accepted and the other rejected."""

    @property
    def of_one(self) -> bool:
        """Whether both passes are of the same annotator."""
        return self.first[0] == self.second[0]

    @property
    def name(self) -> str:
        """Both passes by name."""
        return f"{named(*self.first)} and {named(*self.second)}"


def compared(labels: Iterable[Label], passes: Sequence[Pass]) -> list[Comparison]:
    """Each of some passes with each other one.

    Args:
        labels: Labels of any passes.
        passes: Those that are compared.
    """
    by_pass: dict[Pass, dict[str, Label]] = {one: {} for one in passes}
    for label in labels:
        by_pass.get((label.annotator, label.number), {})[label.digest] = label
    return [
        _comparison((one, by_pass[one]), (other, by_pass[other]))
        for place, one in enumerate(passes)
        for other in passes[place + 1 :]
    ]


def most_apart(comparisons: Iterable[Comparison]) -> list[tuple[Pair, Comparison]]:
    """The two labels of each photo that differ most, and their passes; the worst photo first."""
    worst: dict[str, tuple[Pair, Comparison]] = {}
    for one in comparisons:
        for pair in one.pairs:
            kept = worst.get(pair.first.digest)
            if len(pair.differences) and (kept is None or pair.mean > kept[0].mean):
                worst[pair.first.digest] = pair, one
    return sorted(worst.values(), key=lambda told: -told[0].mean)


def _comparison(
    one: tuple[Pass, dict[str, Label]], other: tuple[Pass, dict[str, Label]]
) -> Comparison:
    pairs, otherwise = [], 0
    for digest, label in one[1].items():
        beside = other[1].get(digest)
        if beside is None:
            continue
        decided = {label.status, beside.status}
        otherwise += decided == {"accepted", "rejected"}
        pair = Pair.of(label, beside) if decided == {"accepted"} else None
        if pair is not None:
            pairs.append(pair)
    pairs.sort(key=lambda pair: -np.nan_to_num(pair.mean))
    return Comparison(one[0], other[0], tuple(pairs), otherwise)
