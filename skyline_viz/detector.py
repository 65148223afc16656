"""The detector: a photo through all stages, and everything that they saw on the way."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, lru_cache, partial

import numpy as np

from skyline_viz.arrays import F32, U8, Bool, Int, check_photo
from skyline_viz.bins import Bins
from skyline_viz.colours import Colour, coloured
from skyline_viz.config import DetectorConfig, TrainingConfig
from skyline_viz.cost import CostModel, Seen
from skyline_viz.datasets.item import Item
from skyline_viz.detection import Detection, timed
from skyline_viz.edges import candidate_edges, edge_pixels, to_grey
from skyline_viz.filter_bank import FilterBank
from skyline_viz.path import shortest_path
from skyline_viz.score import score_at
from skyline_viz.skyline import Skyline
from skyline_viz.stage import BIN, COHERENCE, EDGES, ORIENTATION, SCORE, STRENGTH, Stage
from skyline_viz.tensor import tensor_at, tensor_map
from skyline_viz.training import GramMatrices, gather_item, solve, train


@dataclass(frozen=True, eq=False, kw_only=True)
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

    thresholds: tuple[float, float]
    """Canny thresholds that were used."""

    config: DetectorConfig
    """The configuration that was used."""

    bank: FilterBank
    """The filter bank that was used."""

    @cached_property
    def starved(self) -> Bool:
        """``(n,)`` edge pixels in starved bins."""
        starved: Bool = self.bank.starved[self.bins]
        return starved

    def _stages(self) -> Iterator[Stage]:
        whole = cache(partial(tensor_map, self.photo))  # one for all three
        yield Stage(EDGES, self.edges, "mask")
        for quantity in (STRENGTH, COHERENCE, ORIENTATION):
            name = quantity.name
            yield Stage(
                quantity,
                getattr(self, name),
                "edges",
                dense=lambda name=name: getattr(whole(), name),  # type: ignore[misc]  # default
            )
        yield Stage(BIN, self.bins, "edges", legend=bin_legend(self.bank.bins))
        yield Stage(SCORE, self.scores, "edges")
        yield from self._last_stages()

    def again(self, config: DetectorConfig) -> FilterDetection:
        """See `Detector.again`."""
        return Detector(self.bank, config).again(self)

    def about(self) -> list[str]:
        """How it was made, in short sentences: settings, and where the filters are from."""
        if self.config == DetectorConfig.paper():
            settings = "the paper's settings"
        else:
            settings = ", ".join(self.config.changed()) or "default settings"
        low, high = self.thresholds
        made = self.bank.provenance
        photos = f"{made.images} photos of {made.dataset}" if made.images else "an unknown source"
        return [
            f"{settings.capitalize()}.",
            f"Canny thresholds {low:.0f} and {high:.0f}.",
            f"Filters learned from {photos}.",
        ]


@lru_cache(maxsize=4)
def bin_legend(bins: Bins) -> tuple[tuple[str, Colour], ...]:
    """Words and colour of each bin: its orientation as a hue, brighter with strength."""
    hues = coloured("twilight_shifted", np.arange(bins.orientations) / bins.orientations)
    legend = []
    for index in range(bins.count):
        row, orientation = divmod(index, bins.orientations)
        strength = row % bins.strengths
        bright = 0.55 + 0.45 * strength / max(bins.strengths - 1, 1)
        red, green, blue = (int(bright * one) for one in hues[orientation].tolist())
        legend.append((bins.label(index), (red, green, blue)))
    return tuple(legend)


@dataclass(frozen=True)
class Detector:
    """Finds skylines.

    Examples:
        >>> photo = np.full((40, 60, 3), 200, np.uint8)
        >>> photo[25:] = 60
        >>> set(Detector().detect(photo).skyline.rows.tolist())
        {25.0}
    """

    bank: FilterBank = field(default_factory=FilterBank.default)
    """The filter bank; the shipped one unless given."""

    config: DetectorConfig = field(default_factory=DetectorConfig)
    """The configuration."""

    @property
    def name(self) -> str:
        """``default``, or ``paper`` with the published settings."""
        return "paper" if self.config == DetectorConfig.paper() else "default"

    @property
    def training(self) -> TrainingConfig:
        """How it learns: with its own edges, and filters of the size and bins that its bank has."""
        bank = self.bank
        known = {"smoothness": bank.provenance.smoothness} if bank.provenance.images else {}
        return TrainingConfig(bank.bins, bank.size, detector=self.config, **known)

    @property
    def family(self) -> str:
        """Detectors learn the same filters when they see the same edges and have such filters."""
        training = self.training
        learned = (training.bins, training.filter_size, training.smoothness)
        return f"filters {learned} of edges {_edge_settings(self.config)}"

    def fit(self, items: Iterable[Item], seed: int = 0) -> Detector:
        """The detector with filters that were learned from photos with truth.

        Args:
            items: Photos, such as a data set; those without a truth are left out.
            seed: Seed of the negative samples.

        Returns:
            A detector with the same settings and another bank.

        Raises:
            ValueError: No photo has a truth.

        Examples:
            >>> from skyline_viz.datasets.item import LoadedItem
            >>> from skyline_viz.rendering import render
            >>> scenes = [render("desert", seed, 160, 120) for seed in (1, 2)]
            >>> items = [LoadedItem(one.name, one.photo, one.truth) for one in scenes]
            >>> Detector().fit(items).bank.provenance.images
            2
        """
        pairs = ((item.photo(), truth) for item in items if (truth := item.truth()) is not None)
        return replace(self, bank=train(pairs, seed=seed, config=self.training))

    def gather(self, item: Item, seed: int = 0) -> GramMatrices:
        """What there is to learn from one photo: Gram matrices, which add up.

        Raises:
            PhotoError: The photo cannot be read.
            SkylineError: It has no truth, or one that does not fit.
        """
        return gather_item(self.training, seed, item)

    def from_sums(self, sums: GramMatrices, seed: int = 0) -> Detector:
        """The detector with the filters that Gram matrices of several photos give.

        Raises:
            ValueError: There is not a single sample in them.
        """
        return replace(self, bank=solve(sums, seed, self.training))

    def sharing(self, other: Detector) -> Detector:
        """This detector with the filters of another one."""
        return replace(self, bank=other.bank)

    def detect(self, photo: U8) -> FilterDetection:
        """Find the skyline of a photo.

        A photo without a single edge gets a level line in the middle; its margins are 0.

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.

        Raises:
            TypeError: Not a uint8 array.
            ValueError: Another shape.
        """
        check_photo(photo)
        photo = np.ascontiguousarray(photo)
        config, bank = self.config, self.bank
        seconds: dict[str, float] = {}
        with timed(seconds, "edges"):
            edges, thresholds = candidate_edges(photo, config)
            rows, columns = edge_pixels(edges)
        with timed(seconds, "tensor"):
            tensor = tensor_at(photo, rows, columns)
        with timed(seconds, "bins"):
            bins = bank.bins.of(tensor)
        with timed(seconds, "score"):
            scores = score_at(to_grey(photo), rows, columns, bins, bank.filters)
        with timed(seconds, "cost"):
            seen = Seen(
                photo=photo,
                edges=edges,
                strength=tensor.strength,
                scores=scores,
                config=config,
                bank=bank,
            )
            model = CostModel.of(seen)
            cost = model.total()
        with timed(seconds, "path"):
            path = shortest_path(cost, config.delta, config.link_weight)
        return FilterDetection(
            method=self.name,
            photo=photo,
            skyline=Skyline(rows=path.rows.astype(np.float32)),
            edges=edges,
            edge_rows=rows,
            edge_columns=columns,
            strength=tensor.strength,
            coherence=tensor.coherence,
            orientation=tensor.orientation,
            bins=bins,
            scores=scores,
            cost=cost,
            path_cost=path.cost,
            forward=path.forward,
            thresholds=thresholds,
            seconds=seconds,
            cost_model=model,
            config=config,
            bank=bank,
        )

    def again(self, found: FilterDetection) -> FilterDetection:
        """Find the skyline of a detection's photo, as `detect` does.

        The stages on which this detector and that of the detection agree are not computed anew:
        their arrays are the very ones of the detection, and take no time.

        Args:
            found: What another detector, or this one, found.
        """
        config, bank = self.config, self.bank
        bins_agree = bank.bins == found.bank.bins
        if not bins_agree or _edge_settings(config) != _edge_settings(found.config):
            return self.detect(found.photo)
        seconds = dict.fromkeys(found.seconds, 0.0)
        scores, cost = found.scores, found.cost
        model = found.cost_model.searched(config)
        if bank is not found.bank:
            with timed(seconds, "score"):
                grey = to_grey(found.photo)
                rows, columns = found.edge_rows, found.edge_columns
                scores = score_at(grey, rows, columns, found.bins, bank.filters)
        alike = replace(config, delta=found.config.delta, link_weight=found.config.link_weight)
        if bank is not found.bank or alike != found.config:
            with timed(seconds, "cost"):
                seen = Seen(
                    photo=found.photo,
                    edges=found.edges,
                    strength=found.strength,
                    scores=scores,
                    config=config,
                    bank=bank,
                )
                model = CostModel.of(seen)
                cost = model.total()
        with timed(seconds, "path"):
            path = shortest_path(cost, config.delta, config.link_weight)
        return replace(
            found,
            method=self.name,
            skyline=Skyline(rows=path.rows.astype(np.float32)),
            scores=scores,
            cost=cost,
            path_cost=path.cost,
            forward=path.forward,
            seconds=seconds,
            cost_model=model,
            config=config,
            bank=bank,
        )


def _edge_settings(config: DetectorConfig) -> tuple[object, ...]:
    """What `candidate_edges` depends on."""
    thresholds = (config.low_threshold, config.high_threshold, config.fit_thresholds)
    return (config.edge_source, *thresholds, config.frame)
