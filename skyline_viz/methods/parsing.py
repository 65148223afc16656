"""Scene parsing: networks that tell sky from terrain, trained on a skyline data set.

FCN-8s, FCN-16s, FCN-32s and SegNet, with a setting for their width. At a width of 1 they are of
the published size (half a gigabyte), which needs pretrained weights of VGG-16 and a GPU. The
default, an eighth, is made for a CPU: some minutes for 40 photos, from scratch.

Training needs PyTorch (the extra ``deep``). What has been trained is an ONNX file
in the model, which OpenCV runs: detecting needs nothing further.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar, Literal, TypeAlias

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8, check_photo
from skyline_viz.datasets.item import Item
from skyline_viz.detection import Detection, timed
from skyline_viz.method import LearnedMethod, MethodError, Model, shown_to_learners
from skyline_viz.methods.extras import needed
from skyline_viz.methods.sky_boundary import detect_boundary
from skyline_viz.methods.sky_network import enlarged
from skyline_viz.networks.onnx_files import (
    MEAN,
    STD,
    HoldsNetwork,
    Network,
    normalised,
    padded,
    sigmoid,
)
from skyline_viz.system.settings import Presets, within

Architecture: TypeAlias = Literal["fcn-8s", "fcn-16s", "fcn-32s", "segnet"]
"""Which network."""

_MOST_COLUMNS = 20_000


@dataclass(frozen=True)
class SceneParsing(HoldsNetwork, LearnedMethod):
    """What the networks have in common."""

    architecture: ClassVar[Architecture]
    """Which network."""

    width: float = within(1 / 8, 1e-3, 4)
    """Share of the published channels of every layer; 1 is the published network."""

    epochs: int = within(40, 1)
    """Times that every photo is shown."""

    columns: int = within(352, 32, _MOST_COLUMNS)
    """Columns that photos are scaled to, for training and for detecting."""

    pretrained: Path | None = None
    """File of pretrained weights of the backbone: a PyTorch state dict of VGG-16 (``.pth`` with
    ``features.0.weight`` and so on). Published ones need a width of 1."""

    def learn(self, items: Sequence[Item], seed: int) -> Model:
        """Train the network.

        Raises:
            MethodError: PyTorch is missing, or the pretrained weights do not fit.
            ValueError: No photo has a truth, or a setting is out of range.
        """
        if self.width <= 0 or self.epochs < 1 or self.columns < 32:
            raise ValueError(
                "width is above 0, epochs is 1 or more and columns is 32 or more, not "
                f"{self.width:g}, {self.epochs} and {self.columns}"
            )
        needed("onnx", "deep", self.name)  # which PyTorch asks for only after hours, to export
        training = needed("skyline_viz.methods.parsing_training", "deep", self.name)
        network: bytes = training.train_network(
            shown_to_learners(items),
            self.architecture,
            seed,
            width=self.width,
            epochs=self.epochs,
            columns=self.columns,
            pretrained=self.pretrained,
        )
        return {
            "network": np.frombuffer(network, np.uint8),
            "columns": np.array(self.columns, np.int32),
        }

    def model_shapes(self) -> Mapping[str, tuple[int | None, ...]]:
        """See `LearnedMethod.model_shapes`."""
        return {"network": (None,), "columns": ()}

    def detect(self, photo: U8) -> Detection:
        """Find the skyline of a photo ``(H, W, 3)`` uint8 RGB."""
        check_photo(photo)
        network = self._network
        seconds: dict[str, float] = {}
        with timed(seconds, "network"):
            sky = self._sky(network, photo)
        return detect_boundary(self.name, photo, sky, seconds)

    def _sky(self, network: Network, photo: U8) -> F32:
        columns = int(self.part("columns"))
        if not 32 <= columns <= _MOST_COLUMNS:
            raise MethodError(f"{self.name} is damaged: it scales photos to {columns} columns.")
        small = to_columns(photo, columns)
        logits = network.run(normalised(padded(small), MEAN, STD))
        rows = len(small)
        if logits.ndim != 4 or logits.shape[2] < rows or logits.shape[3] < columns:
            raise MethodError(f"{network.name} gives {logits.shape}, and no map of the photo.")
        return enlarged(sigmoid(logits[0, 0, :rows, :columns]), photo.shape[:2])

    @cached_property
    def _network(self) -> Network:
        return Network(self.part("network").tobytes(), f"the network of {self.name}")


@dataclass(frozen=True)
class Fcn8s(SceneParsing):
    """FCN-8s: adds scores of the fourth and third pooling, of stride 8."""

    architecture: ClassVar[Architecture] = "fcn-8s"

    PRESETS: ClassVar[Presets] = {"fcn-8s": {}}


@dataclass(frozen=True)
class Fcn16s(SceneParsing):
    """FCN-16s: adds scores of the fourth pooling, of stride 16."""

    architecture: ClassVar[Architecture] = "fcn-16s"

    PRESETS: ClassVar[Presets] = {"fcn-16s": {}}


@dataclass(frozen=True)
class Fcn32s(SceneParsing):
    """FCN-32s: scores of stride 32, scaled up."""

    architecture: ClassVar[Architecture] = "fcn-32s"

    PRESETS: ClassVar[Presets] = {"fcn-32s": {}}


@dataclass(frozen=True)
class SegNet(SceneParsing):
    """SegNet: a decoder that mirrors VGG-16."""

    architecture: ClassVar[Architecture] = "segnet"

    PRESETS: ClassVar[Presets] = {"segnet": {}}


def to_columns(photo: U8, columns: int) -> U8:
    """A photo at so many columns, rows in proportion."""
    height, width = photo.shape[:2]
    size = (columns, max(round(height * columns / width), 1))
    smaller = cv2.INTER_AREA if columns < width else cv2.INTER_LINEAR
    return np.asarray(cv2.resize(photo, size, interpolation=smaller), np.uint8)
