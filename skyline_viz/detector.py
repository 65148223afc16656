"""The detector: a photo through all stages, and everything that they saw on the way."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cache, cached_property, partial
from typing import Any

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, U8, Bool, Int, check_photo
from skyline_viz.colours import bin_legend
from skyline_viz.config import DetectorConfig, TrainingConfig
from skyline_viz.cost import CostModel, Seen
from skyline_viz.datasets.item import Item
from skyline_viz.detection import Detection, timed
from skyline_viz.edges import candidate_edges, edge_pixels, edge_settings, to_grey
from skyline_viz.files import replacing
from skyline_viz.filter_bank import FilterBank, bank_file, read_bank
from skyline_viz.path import shortest_path
from skyline_viz.score import score_at
from skyline_viz.skyline import Skyline
from skyline_viz.stage import BIN, COHERENCE, EDGES, ORIENTATION, SCORE, STRENGTH, Stage
from skyline_viz.system import headed_npz
from skyline_viz.system.headed_npz import HeadedNpz, NpzError
from skyline_viz.tensor import tensor_at, tensor_map
from skyline_viz.training import GramMatrices, gather_item, solve, train

FILTERS = "filters"
"""What our detector is called as a method in the header of a file."""


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

    label: str = ""
    """What it is called; empty to be called after its configuration."""

    @property
    def name(self) -> str:
        """Its label, or ``default``, ``paper`` or the nearer one and what differs from it."""
        return self.label or self.config.name

    @property
    def learned_from(self) -> str:
        """See `Configurable.learned_from`: where its filters are from."""
        return self.bank.provenance.dataset

    @property
    def training(self) -> TrainingConfig:
        """How it learns: with its own edges, and filters of the size and bins that its bank has.

        In all else it learns as its bank did, if that saw the photo as this detector does; or as
        is usual for its edges.
        """
        bank, made = self.bank, self.bank.provenance
        usual = replace(TrainingConfig.of(self.config), bins=bank.bins, filter_size=bank.size)
        if not made.images or made.edges != self.config.edge_source:
            return usual
        return replace(usual, reach=made.reach, smoothness=made.smoothness, pooling=made.pooling)

    @property
    def family(self) -> str:
        """Detectors learn the same filters when they see the same edges and have such filters."""
        training = self.training
        shape = (training.bins, training.filter_size)
        rule = (training.reach, training.smoothness, training.pooling)
        return f"filters {shape} by {rule} of edges {edge_settings(self.config)}"

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

    def settings(self) -> dict[str, object]:
        """The configuration, by name."""
        return asdict(self.config)

    def kinds(self) -> dict[str, object]:
        """Type of each setting."""
        return self.config.kinds()

    def with_settings(self, values: Mapping[str, object]) -> Detector:
        """The same filters with other settings.

        Raises:
            ValueError: One has a value that it refuses.
        """
        return replace(self, config=self.config.with_settings(values))

    def own_name(self) -> str:
        """What it is called without a label."""
        return self.config.name

    def labelled(self, label: str) -> Detector:
        """The same under another name."""
        return replace(self, label=label)

    def header(self) -> dict[str, Any]:
        """What its file says of it."""
        about = {"method": FILTERS, "label": self.label, "settings": self.config.described()}
        return {**about, **self.bank.header()}

    def model_bytes(self) -> int:
        """See `Configurable.model_bytes`: of its filters."""
        return self.bank.filters.nbytes

    def require_told(self) -> None:
        """See `Configurable.require_told`.

        Raises:
            SettingError: Its settings, or those of its bank, are of a class of somebody's.
        """
        self.config.require_ours()
        self.bank.provenance.settings.require_ours()

    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """The arrays of its file."""
        return self.bank.arrays()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write one ``.npz`` file with bank, configuration and label, whole or not at all.

        Raises:
            SettingError: Its settings are of a class of somebody's.
        """
        self.require_told()
        with replacing(path) as temporary, temporary.open("wb") as file:
            headed_npz.write(file, self.header(), self.arrays())

    @classmethod
    def load(cls, path: str | os.PathLike[str] | bytes) -> Detector:
        """Read what `save` wrote, or a filter bank; nothing is ever unpickled.

        A bank brings the settings for which it was trained. One of an earlier version knows of
        them only whether Canny saw the grey photo; the others are the default ones then.

        Raises:
            FilterBankError: Missing, damaged, another kind of file, or of a newer version.
        """
        with bank_file(path) as file:
            return cls.read(file, path)

    @classmethod
    def read(cls, file: HeadedNpz, path: str | os.PathLike[str] | bytes) -> Detector:
        """The detector in an open file.

        Raises:
            FilterBankError: There is none, or of another version, or it is not valid.
            NpzError: It is damaged.
        """
        bank, header = read_bank(file, path), file.header
        if "method" not in header:
            return cls(bank, bank.provenance.settings)
        label, settings = header.get("label"), header.get("settings")
        told = isinstance(label, str) and isinstance(settings, dict)
        if header["method"] != FILTERS or not told:
            raise NpzError("its header names no detector")
        if further := sorted(name for name in file.arrays if "__" in name):
            raise NpzError(f"it holds {further[0][:40]}, which this version does not know")
        try:
            return cls(bank, DetectorConfig(**dict(settings or {})), str(label))
        except (TypeError, ValueError) as error:
            reason = f": {error}" if isinstance(error, ValueError) else ""
            raise NpzError(f"its settings are none of a detector{reason}") from error

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
            model = self._costs(photo, edges, tensor.strength, scores)
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

    def _costs(self, photo: U8, edges: Bool, strength: F32, scores: F32) -> CostModel:
        """What the stages before the cost have seen, as terms."""
        seen = Seen(
            photo=photo,
            edges=edges,
            strength=strength,
            scores=scores,
            config=self.config,
            bank=self.bank,
        )
        return CostModel.of(seen)

    def again(self, found: FilterDetection) -> FilterDetection:
        """Find the skyline of a detection's photo, as `detect` does.

        The stages on which this detector and that of the detection agree are not computed anew:
        their arrays are the very ones of the detection, and take no time.

        Args:
            found: What another detector, or this one, found.
        """
        config, bank = self.config, self.bank
        bins_agree = bank.bins == found.bank.bins
        if not bins_agree or edge_settings(config) != edge_settings(found.config):
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
                model = self._costs(found.photo, found.edges, found.strength, scores)
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
