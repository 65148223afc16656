"""What our detector found, and every stage that led to it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from typing import TYPE_CHECKING

import cv2
import numpy as np

from skyline_viz.arrays import F32, Bool, Int, read_only
from skyline_viz.colours import bin_legend
from skyline_viz.config import DetectorConfig
from skyline_viz.detection import Detection
from skyline_viz.filter_bank import FilterBank
from skyline_viz.frames.frame import Frame
from skyline_viz.stage import (
    BIN,
    COHERENCE,
    EDGES,
    FUSED,
    ORIENTATION,
    OURS,
    PATH,
    SCORE,
    SKY,
    STRENGTH,
    Quantity,
    Stage,
)
from skyline_viz.system.fingerprints import fingerprint, known_as
from skyline_viz.tensor import tensor_at, tensor_map

_SEEN = {
    "exact": "this photo", "near": "a near copy of this photo", "clip": "a frame of its clip",
}  # fmt: skip

if TYPE_CHECKING:
    from skyline_viz.detector import Detector


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class FilterDetection(Detection):
    """What our detector found, and every stage that led to it."""

    strength: F32
    """``(n,)`` gradient strength, in grey levels a pixel."""

    coherence: F32
    """``(n,)`` coherence, in [0, 1]."""

    orientation: F32
    """``(n,)`` orientation of the gradient, in degrees, in [0, 180)."""

    bins: Int
    """``(n,)`` int32 bin, which is the index of the filter."""

    frame: Frame
    """The frame around the picture; columns in it are not visible."""

    sky: F32 | None
    """``(h, w)`` probability of sky of each region of the photo, see `sky_model.SkyModel.sky`; None
    where the sky model was switched off."""

    thresholds: tuple[float, float]
    """Canny thresholds that were used."""

    config: DetectorConfig
    """The configuration that was used."""

    bank: FilterBank
    """The filter bank that was used."""

    detector: Detector
    """What found it."""

    @cached_property
    def starved(self) -> Bool:
        """``(n,)`` edge pixels in starved bins."""
        starved: Bool = self.bank.starved[self.bins]
        return starved

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """See `Detection.quantities`."""
        ours = OURS if self.sky is not None else tuple(one for one in OURS if one != SKY)
        return (*ours, PATH)

    def _stages(self) -> Iterator[Stage]:
        if self.sky is not None:
            yield Stage(SKY, self._sky_map(self.sky), "photo")
        yield Stage(EDGES, self.edges, "mask")
        whole = cache(partial(tensor_map, self.photo))  # one for all three
        for one in (STRENGTH, COHERENCE, ORIENTATION):
            dense = partial(lambda name: getattr(whole(), name), one.name)
            at = partial(lambda name, *some: getattr(tensor_at(self.photo, *some), name), one.name)
            yield Stage(one, getattr(self, one.name), "edges", dense=dense, at=at)
        yield Stage(BIN, self.bins, "edges", legend=bin_legend(self.bank.bins))
        yield Stage(SCORE, self.scores, "edges")
        both = [self.cost_model[name].of_edges() for name in ("score", "strength")]
        yield Stage(FUSED, np.add(*both, dtype=np.float32), "edges")
        yield from self._last_stages()

    def _sky_map(self, sky: F32) -> F32:
        """``(H, W)`` probability of sky of each pixel, between centres of regions; made anew."""
        read_only(whole := np.asarray(cv2.resize(sky, self.edges.shape[::-1]), np.float32))
        return whole

    def _sky_asked(self) -> F32:
        return self.detector.sky_of(self.photo, self.frame) if self.sky is None else self.sky

    def _shown(self) -> Bool:
        return self.frame.shows(self.photo.shape[1])

    def again(self, config: DetectorConfig) -> FilterDetection:
        """See `Detector.again`."""
        return replace(self.detector, config=config, label="").again(self)

    @cached_property
    def fingerprint(self) -> str:
        """The fingerprint of the photo without its name, see `system.fingerprints`."""
        return fingerprint(self.photo)

    def about(self) -> list[str]:
        """How it was made, in short sentences: settings, and where the filters are from."""
        changed = ", ".join(self.config.changed()) or "default settings"
        settings = "the paper's settings" if self.config == DetectorConfig.paper() else changed
        low, high = self.thresholds
        made = self.bank.provenance
        photos = f"{made.images} photos of {made.dataset}" if made.images else "an unknown source"
        sky = [] if self.sky is None else [f"Sky model {self.detector.sky.name}."]
        learned = [("Filters have", self.bank.seen)]
        if self.sky is not None:
            learned.append(("The sky model has", self.detector.sky.seen))
        own = self.fingerprint if any(others for _, others in learned) else ""
        return [
            f"{settings.capitalize()}.",
            *sky,
            f"Canny thresholds {low:.0f} and {high:.0f}.",
            f"Filters learned from {photos}.",
            *(
                f"{who} seen {_SEEN[known]} in training: its error is no test."
                for who, others in learned
                if (known := known_as(own, others))
            ),
        ]
