"""``skyline-annotate status`` and ``agreement``: how far the labels are, and how sure they are."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from annotate.commands.options import PROGRAM, PhotoFolder, opened
from annotate.store.labels import STATUSES
from skyline_viz.command_line.messages import (
    GOOD,
    SOME_FAILED,
    UsageError,
    counted,
    say,
    tell,
    tell_drawn,
)
from skyline_viz.command_line.settings import Switch, check_picture
from skyline_viz.command_line.sizes import MaxMegapixels
from skyline_viz.system.memory import MAX_MEGAPIXELS
from skyline_viz.system.names import cell, columns_of, padded, shortened


@dataclass(frozen=True)
class Status:
    """Show how far each annotator is, and how long a photo takes.

    Examples:
        skyline-annotate status photos
        skyline-annotate status photos --orphans
        skyline-annotate status photos/june
    """

    folder: PhotoFolder
    """Folder of the photos."""

    orphans: Switch = False
    """List the labels whose photos are not in the folder any more, with the photos' digests."""

    def run(self) -> int:
        """Print a table; return the exit status."""
        from rich.table import Table

        from annotate.formats.orphans import gone
        from annotate.work.joined import joined
        from skyline_viz.datasets.tree import Tree

        with opened(self.folder) as store:
            found = joined(store)
            present = {photo.id for photo in found.photos}
            passes = [(who, number, store.cards(who, number)) for who, number in store.passes()]
            aside = store.set_aside()
        table = Table(box=None, pad_edge=False, header_style="bold")
        table.add_column("annotator")
        for title in ("pass", *STATUSES, "s a photo", "left"):
            table.add_column(title, justify="right")
        for who, number, every in passes:
            cards = [card for photo, card in every.items() if photo in present]
            counts = Counter(card.status for card in cards)
            done = [card.seconds for card in cards if card.status in ("accepted", "rejected")]
            each = sum(done) / len(done) if done else None
            left = "" if each is None else spoken(each * (len(cards) - len(done)))
            cells = [str(counts[status]) for status in STATUSES]
            seconds = "" if each is None else f"{each:.1f}"
            table.add_row(cell(who), str(number), *cells, seconds, left)
        tell(f"{counted(len(present), 'photo')} in {self.folder}")
        if passes:
            tell_drawn(table, width=100)
        if self.orphans:
            for one in found.orphans:
                whose = f"{one.annotator}, pass {one.number}, {one.status}"
                tell(f"{shortened(one.name)} ({one.digest}): {whose}")
        notes = [*store.problems, *found.damaged, *aside, *gone(found.orphans)]
        notes += Tree.of(self.folder).said()
        for note in notes:
            say(note, PROGRAM)
        return SOME_FAILED if store.fault else GOOD


@dataclass(frozen=True)
class Agreement:
    """Compare two passes over the same photos: two annotators, or one who labelled them twice.

    Examples:
        skyline-annotate agreement photos
        skyline-annotate agreement photos --first ada:1 --second ada:2
        skyline-annotate agreement photos --first ada --second bo --picture apart.png
    """

    folder: PhotoFolder
    """Folder of the photos."""

    first: Annotated[str, tyro.conf.arg(metavar="NAME[:PASS]")] = ""
    """One pass; may be left out where there are just two."""

    second: Annotated[str, tyro.conf.arg(metavar="NAME[:PASS]")] = ""
    """The other."""

    picture: Annotated[Path | None, tyro.conf.arg(metavar="FILE.png")] = None
    """Where to draw the photos that differ most."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Print how far they agree; return the exit status."""
        from annotate.agreement import WITHIN, paired
        from annotate.agreement import Agreement as Found
        from annotate.agreement import picture as drawn
        from annotate.work.joined import joined
        from skyline_viz.photo import write_photo

        check_picture(self.picture)
        with opened(self.folder) as store:
            one, other = _two(store.passes(), self.first, self.second)
            first, second = joined(store, *one), joined(store, *other)
        for note in (*store.problems, *first.notes, *second.notes):
            say(note, PROGRAM)
        pairs = paired(first.labels, second.labels)
        if not pairs:
            raise UsageError(
                f"no photo has been accepted by both {_named(one)} and {_named(other)}."
            )
        found = Found.of(pairs)
        tell(f"{_named(one)} and {_named(other)}, {counted(found.photos, 'photo')}")
        tell(f"  mean difference   {found.mean:.2f} px a column")
        tell(f"  worst difference  {found.worst:.0f} px")
        for most, share in zip(WITHIN, found.within, strict=True):
            tell(f"  within {most} px       {share:.1%} of {found.columns:,} columns")
        tell("Most apart:")
        names = [shortened(pair.first.name) for pair in pairs[:6]]
        wide = max(map(columns_of, names))
        for name, pair in zip(names, pairs, strict=False):
            tell(f"  {padded(name, wide)}  mean {pair.mean:.2f}, worst {pair.worst:.0f} px")
        if self.picture:
            picture = drawn(pairs, self.folder)
            if picture is None:
                raise UsageError(f"the photos are not in {self.folder} any more.")
            write_photo(self.picture, picture)
            tell(str(self.picture))
        return SOME_FAILED if store.fault else GOOD


def spoken(seconds: float) -> str:
    """A time as people say it.

    >>> spoken(40), spoken(600), spoken(9000)
    ('40 s', '10 min', '2.5 h')
    """
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def _two(
    passes: list[tuple[str, int]], first: str, second: str
) -> tuple[tuple[str, int], tuple[str, int]]:
    """The two passes that are meant."""
    if not first and not second and len(passes) == 2:
        return passes[0], passes[1]
    names = ", ".join(f"{who}:{number}" for who, number in passes) or "none"
    if not first or not second:
        raise UsageError(f"which two passes? There are {names}; say --first and --second.")
    chosen = []
    for asked in (first, second):
        who, _, number = asked.rpartition(":") if asked[-1:].isdecimal() else (asked, "", "")
        found = [
            one for one in passes if one == ((who, int(number)) if who and number else (asked, 1))
        ]
        if not found:
            raise UsageError(f"there is no pass {asked}; there are {names}.")
        chosen.append(found[0])
    return chosen[0], chosen[1]


def _named(one: tuple[str, int]) -> str:
    who, number = one
    return who if number == 1 else f"{who}, pass {number}"
