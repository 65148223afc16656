"""The detector: a photo through all stages, and everything that they saw on the way."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from typing import Any, TypedDict

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, F64, U8, Bool, Int, check_photo
from skyline_viz.config import DetectorConfig, TrainingConfig
from skyline_viz.cost import add_blocks, edge_cost, nodal_cost, normalised
from skyline_viz.datasets.layouts import DatasetItem
from skyline_viz.detection import Detection, timed
from skyline_viz.edges import candidate_edges, edge_pixels, to_grey
from skyline_viz.files import replacing
from skyline_viz.filter_bank import FilterBank, bank_file, read_bank
from skyline_viz.path import shortest_path
from skyline_viz.score import score_at
from skyline_viz.skyline import Skyline
from skyline_viz.system import headed_npz
from skyline_viz.system.headed_npz import HeadedNpz, NpzError
from skyline_viz.tensor import tensor_at
from skyline_viz.terrain import BLOCK, terrain_above
from skyline_viz.training import train

FILTERS = "filters"
"""What our detector is called as a method in the header of a file."""


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

    @cached_property
    def edge_rest(self) -> F64:
        """``(n,)`` what the gradient strength of each edge pixel costs."""
        strength = normalised(self.strength, self.config.strength_percentile)
        return (1 - self.config.v) * (1 - strength.astype(np.float64))

    @property
    def shown_cost(self) -> F32:
        """``(H, W)`` nodal costs; no pixel is ruled out."""
        return self.cost

    def no_edge_costs(self, rows: Int, columns: npt.NDArray[np.integer]) -> F64:
        """What pixels ``(k,)`` pay for having no edge; terrain and clear sky are not in it."""
        del columns
        return np.full(len(rows), self.non_edge_cost)


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
    def family(self) -> str:
        """Detectors that look at the same edges learn the same filters."""
        return f"filters of {_edge_settings(self.config)}"

    def fit(self, items: Sequence[DatasetItem], seed: int = 0) -> Detector:
        """The detector with filters that were learned from photos with truth.

        Args:
            items: Photos; those without a truth are left out.
            seed: Seed of the negative samples.

        Raises:
            ValueError: No photo has a truth.
        """
        pairs = ((item.photo(), truth) for item in items if (truth := item.truth()) is not None)
        bank = train(pairs, seed=seed, config=TrainingConfig(detector=self.config))
        return replace(self, bank=bank)

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
        about = {"method": FILTERS, "label": self.label, "settings": asdict(self.config)}
        return {**about, **self.bank.header()}

    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """The arrays of its file."""
        return self.bank.arrays()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write one ``.npz`` file with bank, configuration and label, whole or not at all."""
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
            cost = self._cost(photo, edges, tensor.strength, scores)
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
            config=config,
            bank=bank,
            **_search_settings(config),
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
        if bank is not found.bank:
            with timed(seconds, "score"):
                grey = to_grey(found.photo)
                rows, columns = found.edge_rows, found.edge_columns
                scores = score_at(grey, rows, columns, found.bins, bank.filters)
        alike = replace(config, delta=found.config.delta, link_weight=found.config.link_weight)
        if bank is not found.bank or alike != found.config:
            with timed(seconds, "cost"):
                cost = self._cost(found.photo, found.edges, found.strength, scores)
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
            config=config,
            bank=bank,
            **_search_settings(config),
        )

    def _cost(self, photo: U8, edges: Bool, strength: F32, scores: F32) -> F32:
        """Nodal cost ``(H, W)`` from the gradient strengths and scores ``(n,)`` of the edges."""
        config = self.config
        strength = normalised(strength, config.strength_percentile)
        at_edges = edge_cost(scores, strength, config.v)
        cost = nodal_cost(edges, at_edges, config.non_edge_cost, config.clear_sky)
        if config.terrain_weight and len(scores):  # without edges, every line is a guess
            above = terrain_above(photo, edges, self.bank.terrain)
            add_blocks(cost, above, config.terrain_weight, BLOCK)
        return cost


class _SearchSettings(TypedDict):
    delta: int
    link_weight: float
    non_edge_cost: float
    score_weight: float
    clear_sky: float


def _search_settings(config: DetectorConfig) -> _SearchSettings:
    """What a detection says of how its costs were made and searched."""
    return {
        "delta": config.delta,
        "link_weight": config.link_weight,
        "non_edge_cost": config.non_edge_cost,
        "score_weight": config.v,
        "clear_sky": config.clear_sky,
    }


def _edge_settings(config: DetectorConfig) -> tuple[object, ...]:
    """What `candidate_edges` depends on."""
    thresholds = (config.low_threshold, config.high_threshold, config.fit_thresholds)
    return (config.edge_source, *thresholds, config.frame)
