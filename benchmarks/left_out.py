"""Detectors that have not seen a source: neither their filters nor their sky model.

Filters are trained anew for each source, on all the others. A sky model takes hours to train, so
those come from a folder, each trained by ``skyline-viz train`` on all sources but one:

=======================  ========================================================
file                     network
=======================  ========================================================
``no-web.onnx``          small, trained without ``web_dataset``
``no-mountains.onnx``    small, trained without ``mountains``
``no-uav.onnx``          small, trained without ``uav``
``no-rendered.onnx``     small, trained without rendered scenes; without it the shipped
                         model stands in, which has seen other scenes of these kinds
``large/no-web.onnx``    large, and so on
=======================  ========================================================
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial, reduce
from operator import add
from pathlib import Path
from typing import TypeAlias

from benchmarks.sources import RENDERED, Source
from skyline_viz import Detector, DetectorConfig, evaluate
from skyline_viz.datasets.item import Item
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.running.batch import Failure, run
from skyline_viz.sky_model import SkyModel
from skyline_viz.training import GramMatrices, together

Results: TypeAlias = Mapping[str, Sequence[PhotoResult]]
"""Results of photos by the name of their source; nothing of sources that cannot be left out."""


@dataclass(frozen=True)
class Models:
    """Sky models that have not seen a place, in a folder."""

    folder: Path | None
    """None: there are none."""

    size: str = "small"
    """``small`` or ``large``."""

    def __call__(self, place: str) -> SkyModel | None:
        """The one that has not seen a place; None where there is no such file."""
        file = self.folder / f"no-{place}.onnx" if self.folder else None
        if file and file.is_file():
            return SkyModel.load(file)
        return SkyModel.named(self.size) if place == RENDERED else None

    @property
    def large(self) -> Models:
        """Those of the large size."""
        return Models(self.folder / "large" if self.folder else None, "large")

    def missing(self, sources: Sequence[Source]) -> str:
        """Say which files are not there; nothing if all are."""
        places = dict.fromkeys(source.place for source in sources)
        names = [f"`no-{place}.onnx`" for place in places if self(place) is None]
        if not names:
            return ""
        where = f"in {self.folder.name}" if self.folder else "as no folder of them was named"
        return (
            f"**Missing**: {', '.join(names)} {where}. These are sky models that have not seen a "
            "source; what needs them is not measured."
        )


@dataclass(frozen=True)
class Variant:
    """A detector to be measured."""

    name: str
    """What it is called in tables."""

    config: DetectorConfig
    """Its settings."""

    sky: Callable[[str], SkyModel | None]
    """Its sky model for each place; None where there is none that has not seen it. Not asked for
    where `DetectorConfig.sky_weight` is 0."""


@dataclass(frozen=True, eq=False)
class LeftOut:
    """Trains and tests detectors on sources that they have not seen."""

    sources: Sequence[Source]
    """All of them."""

    sums: dict[tuple[str, str], GramMatrices] = field(default_factory=dict)
    """What has been learned, by the family of detectors and the place."""

    def detector(self, variant: Variant, place: str) -> Detector | None:
        """The detector with filters and a sky model that have not seen a place."""
        sky = variant.sky(place) if variant.config.sky_weight else SkyModel.small()
        if sky is None:
            return None
        detector = Detector(config=variant.config, label=variant.name, sky=sky)
        places = dict.fromkeys(one.place for one in self.sources if one.place != place)
        return detector.from_sums(together([self._learned(detector, one) for one in places]))

    def results(self, variant: Variant) -> Results:
        """Each source, tested by the detector that has not seen it."""
        found = {}
        for source in self.sources:
            if detector := self.detector(variant, source.place):
                tested = evaluate(source.items, detector, workers=0)
                assert not tested.failures, tested.failures
                found[source.name] = tested.results[variant.name]
        return found

    def _learned(self, detector: Detector, place: str) -> GramMatrices:
        """What there is to learn from a place; gathered once for detectors that learn alike."""
        key = (detector.family, place)
        if key not in self.sums:
            of_place = [source for source in self.sources if source.place == place]
            items = [item for source in of_place for item in (*source.items, *source.rough)]
            gathered = run(partial(_gather, detector), items, workers=0, title=place)
            self.sums[key] = reduce(add, _all(gathered))
        return self.sums[key]


def _gather(detector: Detector, item: Item) -> GramMatrices:
    return detector.gather(item)


def _all(outcomes: Iterator[GramMatrices | Failure]) -> Iterator[GramMatrices]:
    for outcome in outcomes:
        assert not isinstance(outcome, Failure), outcome
        yield outcome
