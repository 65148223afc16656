"""The detector: a photo through all stages, and everything that they saw on the way."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, U8, Int, check_photo
from skyline_viz.config import DetectorConfig, TrainingConfig
from skyline_viz.datasets.item import Item
from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detecting.pipeline import Stages, run_stages, sky_inside
from skyline_viz.detection import timed
from skyline_viz.edges import edge_settings
from skyline_viz.files import replacing
from skyline_viz.filter_bank import FilterBank, bank_file, read_bank
from skyline_viz.frames.frame import Frame
from skyline_viz.frames.visibility import visibility
from skyline_viz.sky_model import NETWORK, SkyModel
from skyline_viz.skyline import Skyline
from skyline_viz.system import headed_npz
from skyline_viz.system.headed_npz import HeadedNpz, NpzError
from skyline_viz.training import GramMatrices, gather_item, solve

FILTERS = "filters"
"""What our detector is called as a method in the header of a file."""


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

    sky: SkyModel = field(default_factory=SkyModel.small)
    """The sky model, which runs unless `DetectorConfig.sky_weight` is 0; the small one unless
    given."""

    @property
    def name(self) -> str:
        """Its label, or ``default``, ``paper`` or the nearer one and what differs from it."""
        return self.label or self.own_name()

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
        sums = GramMatrices.empty(self.training)
        for item in items:
            if item.truth() is not None:
                sums += self.gather(item, seed)
        return self.from_sums(sums, seed)

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
        """The configuration by name, and the sky model."""
        return {**asdict(self.config), "sky": self.sky.name}

    def kinds(self) -> dict[str, object]:
        """Type of each setting."""
        return {**self.config.kinds(), "sky": str}

    def with_settings(self, values: Mapping[str, object]) -> Detector:
        """The same filters with other settings.

        Args:
            values: Fields of the configuration, and under ``sky`` a sky model, or what
                `SkyModel.named` takes for one.

        Raises:
            ValueError: One has a value that it refuses.
        """
        others = dict(values)
        named = others.pop("sky", self.sky)
        sky = named if isinstance(named, SkyModel) else SkyModel.named(str(named))
        config = self.config.with_settings(others)
        if sky != self.sky and not config.sky_weight:
            raise ValueError(f"the sky model {sky.name} would not be run, for sky_weight is 0")
        return replace(self, config=config, sky=sky)

    def own_name(self) -> str:
        """What it is called without a label: its configuration, and a sky model of its own."""
        name = self.config.name
        if self.sky == SkyModel.small():
            return name
        return f"{name}{',' if ':' in name else ':'}sky={self.sky.name}"

    def labelled(self, label: str) -> Detector:
        """The same under another name."""
        return replace(self, label=label)

    def header(self) -> dict[str, Any]:
        """What its file says of it."""
        about = {"method": FILTERS, "label": self.label, "settings": self.config.described()}
        return {**about, **self.sky.header(), **self.bank.header()}

    def model_bytes(self) -> int:
        """See `Configurable.model_bytes`: of its filters, and of the sky model if it runs."""
        return self.bank.filters.nbytes + (len(self.sky.network) if self.config.sky_weight else 0)

    def require_told(self) -> None:
        """See `Configurable.require_told`.

        Raises:
            SettingError: Its settings, or those of its bank, are of a class of somebody's.
        """
        self.config.require_ours()
        self.bank.provenance.settings.require_ours()

    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """The arrays of its file."""
        return {**self.bank.arrays(), **self.sky.arrays()}

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write one ``.npz`` file with all that it is made of, whole or not at all.

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
        them only whether Canny saw the grey photo; the others are the default ones then. A detector
        of a version that had no sky model does without one.

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
        name = "a kept detector" if isinstance(path, bytes) else str(path)
        if "method" not in header:
            trained_for = dict(header.get("bank", header)["provenance"]).get("detector")
            known = DetectorConfig.from_file(trained_for, name) if trained_for else None
            return cls(bank, known or bank.provenance.settings)
        label, settings = header.get("label"), header.get("settings")
        sound = isinstance(label, str) and isinstance(settings, dict)
        if header["method"] != FILTERS or not sound:
            raise NpzError("its header names no detector")
        others = {name for name in file.arrays if "__" in name} - {NETWORK}
        if further := sorted(others):
            raise NpzError(f"it holds {further[0][:40]}, which this version does not know")
        sky = SkyModel.read(file)
        told = {**({} if sky else {"sky_weight": 0.0}), **dict(settings or {})}
        try:
            config = DetectorConfig.from_file(told, name)
        except (TypeError, ValueError) as error:
            reason = f": {error}" if isinstance(error, ValueError) else ""
            raise NpzError(f"its settings are none of a detector{reason}") from error
        return cls(bank, config, str(label), sky or SkyModel.small())

    def detect(self, photo: U8) -> FilterDetection:
        """Find the skyline of a photo.

        In a photo without a single edge the line follows the sky model's map. Without a sky model,
        or where its map says nothing, it is level in the middle, and its margins are 0. Where the
        line cannot be seen, and in photos without a skyline everywhere, it is marked as not
        visible, see `visibility.Visibility`; without a sky model it counts as visible everywhere.

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.

        Raises:
            TypeError: Not a uint8 array.
            ValueError: Another shape.
        """
        check_photo(photo)
        return self._detect(np.ascontiguousarray(photo))

    def again(self, found: FilterDetection) -> FilterDetection:
        """Find the skyline of a detection's photo, as `detect` does.

        The stages on which this detector and that of the detection agree are not computed anew:
        their arrays are the very ones of the detection, and take no time.

        Args:
            found: What another detector, or this one, found.
        """
        return self._detect(found.photo, found)

    def rows_again(self, found: FilterDetection) -> Int:
        """``(W,)`` int32 rows of the line that `again` finds, without asking where it is visible.

        Args:
            found: What another detector, or this one, found.
        """
        return self._stages(found.photo, found).path.rows

    def _detect(self, photo: U8, found: FilterDetection | None = None) -> FilterDetection:
        """See `detect` and `again`."""
        made = self._stages(photo, found)
        frame, sky, looks = made.frame, made.sky, made.looks
        with timed(made.seconds, "path"):
            line = Skyline(made.path.rows.astype(np.float32), frame.shows(photo.shape[1]))
            shown = None
            if sky is not None:
                shown = visibility(sky, line.rows, *made.pixels, len(made.edges), frame)
                line = Skyline(line.rows, shown.visible)
        return FilterDetection(
            method=self.name,
            photo=photo,
            skyline=line,
            frame=frame,
            visibility=shown,
            sky=sky,
            edges=made.edges,
            edge_rows=made.pixels[0],
            edge_columns=made.pixels[1],
            strength=looks.tensor.strength,
            coherence=looks.tensor.coherence,
            orientation=looks.tensor.orientation,
            bins=looks.bins,
            scores=looks.scores,
            cost=made.cost,
            path_cost=made.path.cost,
            thresholds=made.thresholds,
            seconds=made.seconds,
            cost_model=made.cost_model,
            config=self.config,
            bank=self.bank,
            detector=self,
        )

    def _stages(self, photo: U8, found: FilterDetection | None) -> Stages:
        return run_stages(photo, self.bank, self.config, self.sky, found)

    def sky_of(self, photo: U8, frame: Frame) -> F32:
        """``(h, w)`` the map of the sky model, which sees the picture inside a frame alone.

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.
            frame: Its frame.
        """
        return sky_inside(self.sky, photo, frame)
