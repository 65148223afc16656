"""Photographs of several cameras, each source with the tolerance to which its truth is good."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from skyline_viz import LoadedItem, open_dataset, render
from skyline_viz.datasets.item import Item
from skyline_viz.evaluation.intervals import Interval, resampled, wilson
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.rendering import KINDS

EACH = 4
"""Rendered scenes of each kind."""

FIRST_SCENE = 900_000
"""Seed of the first rendered scene: no sky model is trained on scenes from here on."""

RENDERED = "rendered"
"""The place of the rendered scenes."""


@dataclass(frozen=True, eq=False)
class Source:
    """Photos of one camera or place, which resemble each other more than those of others."""

    name: str
    """What it is called in tables."""

    place: str
    """What is left out of training with it: two grades of one set are of one place."""

    items: Sequence[Item]
    """Its photos, all with a truth."""

    tolerance: float
    """A_err below which a line is near the truth, in pixels."""

    rough: Sequence[Item] = ()
    """More photos of the place, by whose truth others learn, but nothing is tested."""

    clips: bool = False
    """Whether the photos are frames of clips, named ``CLIP-FRAME``: such are not independent."""

    @property
    def groups(self) -> list[str]:
        """For each photo the name of what is drawn together: its clip, or itself."""
        return [item.name.split("-")[0] if self.clips else item.name for item in self.items]

    def near(self, results: Sequence[PhotoResult]) -> list[bool]:
        """Which lines are near the truth."""
        return [one.a_err < self.tolerance for one in results]

    def share(self, hits: Sequence[bool]) -> Interval:
        """Interval of the share of photos for which something holds.

        By Wilson's score; of frames by drawing clips anew. Where all frames agree that cannot
        tell, and the clips are counted as photos.
        """
        if not self.clips:
            return wilson(sum(hits), len(hits))
        if any(hits) and not all(hits):
            return resampled(np.asarray(hits, float), self.groups)
        clips = len(set(self.groups))
        return wilson(clips if all(hits) else 0, clips)


def sources(data: Path) -> list[Source]:
    """The sources of which there are photos in a folder, and scenes rendered here."""
    web, mountains, uav = (_items(data / name) for name in ("web_dataset", "mountains", "uav"))
    good, fair, rough = (
        [item for item in mountains if item.name.startswith(grade)] for grade in ("A", "B", "C")
    )
    known = [
        Source("Web", "web", web, 4),
        Source("mountains A", "mountains", good, 5, rough),
        Source("mountains B", "mountains", fair, 10),
        Source("UAV", "uav", uav, 6, clips=True),
        Source("rendered", RENDERED, _rendered(), 4),
    ]
    return [source for source in known if source.items]


def _items(folder: Path) -> list[Item]:
    """Photos with a truth; none where there is no such folder."""
    if not folder.is_dir():
        return []
    return [item for item in open_dataset(folder) if item.truth_path]


def _rendered() -> list[Item]:
    scenes = (render(kind, FIRST_SCENE + seed) for kind in KINDS for seed in range(EACH))
    return [LoadedItem(scene.name, scene.photo, scene.truth) for scene in scenes]
