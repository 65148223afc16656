"""What an evaluation found, method by method and photo by photo."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from skyline_viz.evaluation import terminal
from skyline_viz.evaluation.results import PhotoResult, Summary
from skyline_viz.evaluation.seen import by_name, notes
from skyline_viz.evaluation.tasks import PhotoTask
from skyline_viz.method import Method
from skyline_viz.running.batch import Failure


@dataclass(frozen=True, eq=False)
class Evaluation:
    """Methods that were tested on the same photos. Printed, it is a table, as in a notebook."""

    results: Mapping[str, Sequence[PhotoResult]]
    """For each method, by its name, the results of the photos; those that failed have none."""

    failures: tuple[Failure, ...] = ()
    """Photos that could not be read or tested, and methods that could not learn, with the reason.
    What failed under one method of several has its name behind that of the photo."""

    methods: Mapping[str, Method] = field(default_factory=dict)
    """The methods by name: of a cross-validation as the first fold was tested with them. One that
    could not learn is missing."""

    tasks: Mapping[str, Sequence[PhotoTask]] = field(default_factory=dict)
    """For each method, by its name, the photos, each with the method as it was tested on it."""

    fold_of: Mapping[str, int] = field(default_factory=dict)
    """The fold of each photo of a cross-validation by its name; empty where there is none."""

    seed: int = 0
    """Seed of all that was drawn."""

    @property
    def folds(self) -> int:
        """Folds of the cross-validation; 0 is none."""
        return max(self.fold_of.values(), default=-1) + 1

    @property
    def summaries(self) -> dict[str, Summary]:
        """Mean, median and other figures over all photos, for each method."""
        return {name: Summary.of(found) for name, found in self.results.items()}

    @property
    def notes(self) -> list[str]:
        """Which photos were seen in training, in sentences: their errors are no test."""
        return [
            note
            for name, found in self.results.items()
            for note in notes(name, by_name(found), folds=bool(self.folds))
        ]

    def __str__(self) -> str:
        """A line for each method, and one for each failure and note."""
        table = terminal.drawn(terminal.methods_table(self.results), width=110)
        return "\n".join([table, *map(str, self.failures), *self.notes])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        """The same for a notebook."""
        return terminal.methods_html(self.results, [*map(str, self.failures), *self.notes])
