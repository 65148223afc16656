"""What each person who labels works with on the server."""

from __future__ import annotations

from dataclasses import dataclass

from annotate.server.address import pass_id
from annotate.work.learning import Learner
from annotate.work.shown import Pictures
from annotate.work.workbench import Workbench


@dataclass(frozen=True)
class Desk:
    """One person's labels, and what shows and learns from them."""

    bench: Workbench
    """The labels."""

    learner: Learner
    """Learns from them."""

    pictures: Pictures
    """Shows their photos."""

    shown: str
    """Id of the pass."""

    @classmethod
    def of(cls, bench: Workbench) -> Desk:
        """The desk at which a workbench stands."""
        who = bench.assignment
        shown = pass_id(bench.store, who.annotator, who.number)
        return cls(bench, Learner(bench), Pictures(bench), shown)
