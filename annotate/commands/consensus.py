"""``skyline-annotate consensus``: what several passes have in common becomes a pass of its own."""

from __future__ import annotations

from contextlib import closing
from dataclasses import dataclass
from typing import Annotated

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
)
from skyline_viz.system.names import listed, shortened

_NAMED = 20  # photos that are listed


@dataclass(frozen=True)
class Consensus:
    """Put what several passes have in common into a pass of its own, called consensus.

    Examples:
        skyline-annotate consensus photos
        skyline-annotate consensus photos --within 3
        skyline-annotate consensus photos --passes ada bo
    """

    folder: PhotoFolder
    """Folder of the photos."""

    passes: Annotated[tuple[str, ...], tyro.conf.arg(metavar="NAME[:PASS]")] = ()
    """Which passes; all unless given."""

    within: Annotated[float, tyro.conf.arg(metavar="PX")] = 2.0
    """Lines agree that differ by no more than so many pixels."""

    def run(self) -> int:
        """Write the consensus; return the exit status."""
        from annotate.store.store import Store
        from annotate.work.consensus import make_consensus
        from annotate.work.joined import joined

        if not 0 <= self.within < float("inf"):
            raise UsageError(f"--within is a number of pixels from 0 on, not {self.within:g}.")
        with opened(self.folder) as store:
            passes = [one for one in chosen_passes(store, self.passes) if one[0] != CONSENSUS]
            found = joined(store)
        for note in (*store.problems, *found.notes):
            say(note, PROGRAM)
        names = [named(*one) for one in passes]
        if len(passes) < 2:
            there = f"there is {names[0]} alone" if names else "there is none"
            raise UsageError(f"a consensus is made of two passes at least, and {there}.")
        labels = [one for one in found.labels if (one.annotator, one.number) in passes]
        with closing(Store(self.folder)) as store:
            outcome = make_consensus(store, labels, self.within)
        tell(f"{counted(len(found.photos), 'photo')} in {self.folder}, passes: {listed(names)}")
        tell(f"Accepted, since all agree within {self.within:g} px: {len(outcome.accepted)}")
        if outcome.rejected:
            tell(f"Rejected, as by all: {len(outcome.rejected)}")
        tell(f"Needs review, since they do not agree: {len(outcome.review)}")
        for name, words in outcome.review[:_NAMED]:
            tell(f"  {shortened(name)}: {words}")
        if (more := len(outcome.review) - _NAMED) > 0:
            tell(f"  and {more} more; {PROGRAM} status {self.folder} --review lists them")
        if outcome.kept:
            tell(f"As they were, since somebody has decided or worked on them: {len(outcome.kept)}")
        if outcome.changed:
            names = [shortened(one) for one in outcome.changed]
            say(f"labelled anew since the consensus was decided: {listed(names)}.", PROGRAM)
        if (left := len(found.photos) - outcome.photos) > 0:
            tell(f"Not in it, since fewer than two passes have decided them: {left}")
        if outcome.review:
            tell(f"Decide: {PROGRAM} open {self.folder} --annotator {CONSENSUS}")
        return SOME_FAILED if store.fault else GOOD
