"""``skyline-annotate agreement``: how far passes over the same photos differ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from annotate.commands.options import PROGRAM, PhotoFolder, chosen_passes, opened
from annotate.store.labels import CONSENSUS, named
from skyline_viz.command_line.messages import (
    GOOD,
    SOME_FAILED,
    UsageError,
    counted,
    say,
    tell,
    tell_drawn,
)
from skyline_viz.command_line.settings import OptionalFolder, check_picture
from skyline_viz.command_line.sizes import MaxMegapixels
from skyline_viz.system.memory import MAX_MEGAPIXELS
from skyline_viz.system.names import cell, columns_of, padded, shortened

if TYPE_CHECKING:
    from rich.table import Table

    from annotate.agreement.figures import Agreement as Figures
    from annotate.agreement.pairs import Comparison, Pass

_NAMED = 6  # photos that are named as most apart
_WIDE = 120  # columns of a table


@dataclass(frozen=True)
class Agreement:
    """Compare passes over the same photos: of several annotators, or of one who labelled twice.

    Examples:
        skyline-annotate agreement photos
        skyline-annotate agreement photos --passes ada:1 ada:2
        skyline-annotate agreement photos --out agreement --picture apart.png
    """

    folder: PhotoFolder
    """Folder of the photos."""

    passes: Annotated[tuple[str, ...], tyro.conf.arg(metavar="NAME[:PASS]")] = ()
    """Which passes; all that have accepted photos, but for the consensus, unless given."""

    out: OptionalFolder = None
    """Folder for all figures as agreement.json, and photo by photo as photos.csv."""

    picture: Annotated[Path | None, tyro.conf.arg(metavar="FILE.png")] = None
    """Where to draw the photos that differ most, at the places where they do."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Print how far they agree; return the exit status."""
        from annotate.agreement.pairs import compared
        from annotate.agreement.picture import picture as drawn
        from annotate.agreement.tables import write_tables
        from annotate.work.joined import joined
        from skyline_viz.photo import write_photo

        check_picture(self.picture)
        with opened(self.folder) as store:
            found = joined(store)
            passes = chosen_passes(store, self.passes)
        for note in (*store.problems, *found.notes):
            say(note, PROGRAM)
        decided = {(one.annotator, one.number) for one in found.labels if one.status == "accepted"}
        if not self.passes:
            passes = [one for one in passes if one[0] != CONSENSUS and one in decided]
        names = ", ".join(f"{who}:{number}" for who, number in passes) or "none"
        if len(passes) < 2:
            raise UsageError(
                f"two passes are compared at least, and with accepted photos: {names}."
            )
        comparisons = compared(found.labels, passes)
        told = [one for one in comparisons if any(len(pair.differences) for pair in one.pairs)]
        if not told:
            raise UsageError(f"no photo has been accepted in two of the passes {names}.")
        _tell_pairs(comparisons, passes)
        _tell_people(comparisons)
        _tell_making(comparisons)
        _tell_photos(comparisons)
        if self.out:
            write_tables(comparisons, passes, self.out)
            tell(str(self.out))
        if self.picture:
            picture = drawn(comparisons, passes, self.folder)
            if picture is None:
                raise UsageError(f"the photos are not in {self.folder} any more.")
            write_photo(self.picture, picture)
            tell(str(self.picture))
        return SOME_FAILED if store.fault else GOOD


def _tell_pairs(comparisons: Sequence[Comparison], passes: Sequence[Pass]) -> None:
    """Each pass with each other one: different people first, then one person with himself."""
    from annotate.agreement.figures import Agreement as Figures

    ordered = sorted(comparisons, key=lambda one: one.of_one)
    photos = {pair.first.digest for one in comparisons for pair in one.pairs}
    tell(f"{len(passes)} passes, {counted(len(photos), 'photo')} accepted in several of them")
    _tell_table([(one.name, Figures.of(one.pairs)) for one in ordered])
    if len(passes) > 2:
        tell("", "Mean difference, in pixels a column:")
        tell_drawn(_matrix(comparisons, passes), width=_WIDE)


def _tell_people(comparisons: Sequence[Comparison]) -> None:
    """Whoever has labelled photos twice, beside how far he agrees with others."""
    from annotate.agreement.figures import people

    rows = []
    for one in people(comparisons):
        if one.alone:
            rows += [(f"{one.name}, twice", one.alone), (f"{one.name} with others", one.others)]
    if rows:
        tell("", "One person twice, and with others:")
        _tell_table(rows)


def _tell_making(comparisons: Sequence[Comparison]) -> None:
    """Labels that were proposed beside blind ones, where there are some."""
    from annotate.agreement.figures import by_making, lean

    made = by_making(comparisons)
    if any(kind != "both proposed" for kind in made):
        tell("", "Labels that began with a proposal, and blind ones:")
        _tell_table(list(made.items()))
    if found := lean(comparisons):
        mean, (low, high) = found
        where = "lower"
        if mean < 0:
            mean, low, high, where = -mean, -high, -low, "higher"
        tell(f"Proposed lines lie {mean:.2f} px {where} than blind ones ({low:.2f} to {high:.2f}).")


def _tell_photos(comparisons: Sequence[Comparison]) -> None:
    """The photos that differ most, and those of which nobody knows whether they have a line."""
    from annotate.agreement.pairs import most_apart

    for one in comparisons:
        if many := one.decided_otherwise:
            tell(f"{one.name}: {counted(many, 'photo')} accepted by one, rejected by the other.")
    tell("", "Most apart:")
    pairs = most_apart(comparisons)
    names = [shortened(pair.first.name) for pair, _ in pairs[:_NAMED]]
    wide = max(map(columns_of, names))
    for name, (pair, one) in zip(names, pairs, strict=False):
        figures = f"mean {pair.mean:.2f}, worst {pair.worst:.0f} px"
        tell(f"  {padded(name, wide)}  {figures}  ({one.name})")


def _tell_table(rows: Sequence[tuple[str, Figures | None]]) -> None:
    """Figures, a row each; those of none are dashes."""
    from rich.table import Table

    from annotate.agreement.figures import WITHIN

    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("")
    within = [f"<= {most} px" for most in WITHIN]
    for head in ("photos", "mean px", "95 %", "worst", *within, "visible, kappa"):
        table.add_column(head, justify="right")
    for name, one in rows:
        if one is None:
            table.add_row(cell(name), "0", *["-"] * (len(WITHIN) + 4))
            continue
        low, high = one.interval
        shares = [f"{share:.1%}" for share in one.within]
        kappa = "-" if one.kappa is None else f"{one.kappa:.2f}"
        figures = (f"{one.mean:.2f}", f"{low:.2f} to {high:.2f}", f"{one.worst:.0f}")
        table.add_row(cell(name), str(one.photos), *figures, *shares, kappa)
    tell_drawn(table, width=_WIDE)


def _matrix(comparisons: Sequence[Comparison], passes: Sequence[Pass]) -> Table:
    """Mean differences of each pass from each other one."""
    from rich.table import Table

    from annotate.agreement.figures import Agreement as Figures

    means = {
        pair: Figures.of(one.pairs)
        for one in comparisons
        for pair in ((one.first, one.second), (one.second, one.first))
    }
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("")
    for each in passes:
        table.add_column(cell(named(*each)), justify="right")
    for each in passes:
        row = [means.get((each, other)) for other in passes]
        table.add_row(
            cell(named(*each)), *("-" if one is None else f"{one.mean:.2f}" for one in row)
        )
    return table
