"""``skyline-annotate status``: how far the labels are."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from annotate.commands.options import PROGRAM, PhotoFolder, opened
from annotate.store.cards import seconds_a_photo
from annotate.store.labels import STATUSES, named
from skyline_viz.command_line.messages import (
    GOOD,
    SOME_FAILED,
    counted,
    say,
    tell,
    tell_drawn,
)
from skyline_viz.command_line.settings import Switch
from skyline_viz.system.names import cell, shortened


@dataclass(frozen=True)
class Status:
    """Show how far each annotator is, and how long a photo takes.

    Examples:
        skyline-annotate status photos
        skyline-annotate status photos --review
        skyline-annotate status photos --orphans
    """

    folder: PhotoFolder
    """Folder of the photos."""

    orphans: Switch = False
    """List the labels whose photos are not in the folder any more, with the photos' digests."""

    review: Switch = False
    """List the photos that need review or are rejected, with what was said of them."""

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
            each = seconds_a_photo(cards)
            left = len(cards) - counts["accepted"] - counts["rejected"]
            cells = [str(counts[status]) for status in STATUSES]
            seconds = "" if each is None else f"{each:.1f}"
            time = "" if each is None else spoken(each * left)
            table.add_row(cell(who), str(number), *cells, seconds, time)
        tell(f"{counted(len(present), 'photo')} in {self.folder}")
        if passes:
            tell_drawn(table, width=100)
        if self.orphans:
            for one in found.orphans:
                whose = f"{one.annotator}, pass {one.number}, {one.status}"
                tell(f"{shortened(one.name)} ({one.digest}): {whose}")
        if self.review:
            for who, number, every in passes:
                for photo, card in every.items():
                    if photo in present and card.status in ("needs review", "rejected"):
                        said = f", {card.comment}" if card.comment else ""
                        name = shortened(card.photo.name)
                        tell(f"{name} ({named(who, number)}): {card.status}{said}")
        notes = [*store.problems, *found.damaged, *aside, *gone(found.orphans)]
        notes += Tree.of(self.folder).said()
        for note in notes:
            say(note, PROGRAM)
        return SOME_FAILED if store.fault else GOOD


def spoken(seconds: float) -> str:
    """A time as people say it.

    >>> spoken(40), spoken(600), spoken(9000)
    ('40 s', '10 min', '2.5 h')
    """
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
