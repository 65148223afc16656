"""Options of a cross-validation: which photos stay together, and which fold each is in."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import tyro

from skyline_viz.command_line.messages import counted, say
from skyline_viz.system.names import listed

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from skyline_viz.datasets import DatasetItem


@dataclass(frozen=True)
class Folds:
    """How photos are dealt into folds."""

    folds: int = 0
    """Folds of a cross-validation, which trains on all folds but the one it tests; 0 is none.
    Photos that are nearly the same, and frames of a clip, stay in one."""

    group: Annotated[str | None, tyro.conf.arg(metavar="{folder,near,PATTERN}")] = None
    """Photos that stay in one fold: those of a folder, those that are nearly the same, or those in
    whose names a pattern finds the same, such as clip[0-9]+. Intervals take them together, too."""

    split: Annotated[Path | None, tyro.conf.arg(metavar="FILE.csv")] = None
    """Folds as a file says, with the columns name and fold; --out writes such a folds.csv."""

    def __post_init__(self) -> None:
        """Refuse two ways at once."""
        if self.split is not None and (self.folds or self.group is not None):
            raise ValueError(
                "--split says which fold each photo is in; leave out --folds and --group"
            )

    @property
    def asked(self) -> bool:
        """Whether there is a cross-validation."""
        return bool(self.folds) or self.split is not None

    def groups(self, items: Sequence[DatasetItem], workers: int = 1) -> Mapping[str, str] | None:
        """The group of each photo by its name; None where each is one of its own.

        In a cross-validation photos that are nearly the same are in one, whatever --group says.

        Raises:
            ValueError: It is no grouping.
        """
        from skyline_viz.evaluation import grouped, groups_for, kept_together

        asked = None if self.group in (None, "near") else grouped(items, str(self.group))
        if self.group == "near":
            return kept_together(items, workers=workers)
        if not self.folds:
            return asked
        groups = groups_for(items, self.folds, asked, workers=workers)
        if asked is None and groups is not None:
            several = {one for one, count in Counter(groups.values()).items() if count > 1}
            names = [name for name, group in groups.items() if group in several]
            which = f"{counted(len(names), 'photo')} in {counted(len(several), 'group')}"
            say(f"kept in one fold, as they are nearly the same or of a clip: {which}.")
        return groups

    def dealt(
        self, items: Sequence[DatasetItem], groups: Mapping[str, str] | None
    ) -> Mapping[str, int] | None:
        """The fold of each photo by its name; None without a cross-validation.

        Raises:
            ValueError: The file says nothing of the photos, or there are too few photos for so many
                folds.
        """
        from skyline_viz.evaluation import deal, read_split

        if self.split is not None:
            found = read_split(self.split, items)
            if left := [item.name for item in items if item.name not in found]:
                say(f"left out, because {self.split} has no fold for them: {listed(left)}.")
            return found
        return deal(items, self.folds, groups) if self.folds else None

    def said(self, folds: Mapping[str, int] | None, groups: Mapping[str, str] | None) -> str:
        """How the photos are tested, in a few words; nothing without a cross-validation."""
        if folds is None:
            return ""
        number = max(folds.values()) + 1
        words = f"{number}-fold cross-validation"
        if groups is not None:
            words += f" of {counted(len(set(groups.values())), 'group')}"
        return words


FoldOptions: TypeAlias = Annotated[Folds, tyro.conf.arg(name="")]
"""`Folds` without a prefix of their own."""
