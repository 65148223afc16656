"""Any sky-segmentation network, given as an ONNX file; OpenCV runs it.

The network takes one photo, ``(1, 3, h, w)`` or ``(1, h, w, 3)``. Where the file fixes ``h`` and
``w``, photos are stretched to that; otherwise their rims are repeated up to a multiple of 32. The
first output is one of

* ``(1, C, h, w)``: logits or probabilities of C classes, of which one is the sky;
* ``(1, 1, h, w)`` or ``(1, h, w)``: the logit or the probability of sky;
* the same of integers: a map of labels, of which one is the sky.

It may be smaller than the input, and is scaled back to the photo. A network that takes ``(1, h, w,
3)`` may give ``(1, h, w, C)``, too.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8, check_photo
from skyline_viz.detection import Detection, timed
from skyline_viz.method import MethodError
from skyline_viz.methods.sky_boundary import detect_boundary
from skyline_viz.networks.onnx_files import (
    MEAN,
    STD,
    HoldsNetwork,
    Network,
    normalised,
    padded,
    probabilities,
    read_network,
)
from skyline_viz.system.settings import Configured, name_with, within


@dataclass(frozen=True)
class SkyNetwork(HoldsNetwork, Configured):
    """A network of somebody's, called after its file."""

    network: Path
    """The ONNX file."""

    sky_class: int = 0
    """Which of its classes is the sky, from 0; 0 where it gives the sky alone."""

    mean: tuple[float, float, float] = MEAN
    """What is taken from red, green and blue in [0, 1]; that of ImageNet unless given."""

    std: tuple[float, float, float] = STD
    """What they are divided by then; that of ImageNet unless given."""

    columns: int | None = within(None, 1)
    """Columns that photos are scaled to for networks that take any size; None leaves them."""

    def kinds(self) -> dict[str, object]:
        """See `Configurable.kinds`: the file, and numbers of each colour, are not given as text."""
        kinds = super().kinds()
        return {one: kinds[one] for one in ("sky_class", "columns")}

    def own_name(self) -> str:
        """See `Configurable.own_name`."""
        settings = {one: getattr(self, one) for one in self.kinds()}
        return name_with(self.network.name, settings, {"sky_class": 0, "columns": None})

    def model_bytes(self) -> int:
        """See `Configurable.model_bytes`: of its file."""
        return self.network.stat().st_size

    def check(self) -> None:
        """Open the file.

        Raises:
            MethodError: It is missing, no ONNX file, or its network takes something else.
        """
        _ = self._network

    def detect(self, photo: U8) -> Detection:
        """Find the skyline of a photo ``(H, W, 3)`` uint8 RGB.

        Raises:
            MethodError: The file is no ONNX file, or its network takes or gives something else.
        """
        check_photo(photo)
        network = self._network
        seconds: dict[str, float] = {}
        with timed(seconds, "network"):
            sky = self._sky(network, photo)
        return detect_boundary(self.name, photo, sky, seconds)

    def _sky(self, network: Network, photo: U8) -> F32:
        """Probability of sky ``(H, W)``."""
        shape = network.header.inputs[0].shape
        last = shape[1] != 3 and shape[3] == 3  # channels
        fixed = shape[1:3] if last else shape[2:]
        size = tuple(want or have for want, have in zip(fixed, photo.shape[:2], strict=True))
        if not all(fixed) and self.columns:
            rows = round(photo.shape[0] * self.columns / photo.shape[1])
            size = (fixed[0] or max(rows, 1), fixed[1] or self.columns)
        shrinks = size[0] * size[1] < photo.shape[0] * photo.shape[1]
        how = cv2.INTER_AREA if shrinks else cv2.INTER_LINEAR
        small = np.asarray(cv2.resize(photo, size[::-1], interpolation=how), np.uint8)
        whole = small if all(fixed) else padded(small)
        blob = normalised(whole, self.mean, self.std)
        output = network.run(np.ascontiguousarray(blob.transpose(0, 2, 3, 1)) if last else blob)
        sky = self._of_class(output, network.header.outputs[0].whole, last)
        # what was added at the rim goes again, at the output's own scale
        down, across = (side / full for side, full in zip(sky.shape, whole.shape, strict=False))
        matrix = np.array(
            [
                [size[1] / photo.shape[1] * across, 0, 0],
                [0, size[0] / photo.shape[0] * down, 0],
            ]
        )
        matrix[:, 2] = (np.diag(matrix[:, :2]) - 1) / 2  # pixels are areas, not points
        return enlarged(sky, photo.shape[:2], matrix)

    def _of_class(self, output: np.ndarray[Any, np.dtype[Any]], labels: bool, last: bool) -> F32:
        """Probability of sky in what the network gave, at its size."""
        shape = output.shape
        if output.ndim == 4 and last and shape[3] < shape[1]:  # channels last, as they came
            output = output.transpose(0, 3, 1, 2)
        if output.ndim == 3:
            output = output[:, None]
        if output.ndim != 4 or output.shape[0] != 1 or min(output.shape[2:], default=0) < 2:
            raise MethodError(
                f"{self.network} gives {shape}, and not a map (1, classes, rows, columns)."
            )
        classes = output.shape[1]
        if labels and classes == 1:
            if self.sky_class < 0:
                raise MethodError(f"{self.network} has no class {self.sky_class}.")
            sky: F32 = np.asarray(output[0, 0] == self.sky_class, np.float32)
            if not sky.any():
                told = ", ".join(map(str, np.unique(output)[:9]))
                raise MethodError(
                    f"{self.network} calls no pixel of this photo {self.sky_class}, only {told}."
                )
            return sky
        if not 0 <= self.sky_class < classes:
            raise MethodError(
                f"{self.network} has no class {self.sky_class}: it tells {classes}, from 0."
            )
        values: F32 = output[0].astype(np.float32)
        if classes == 1:
            return probabilities(values[0])
        if values.min() < 0 or np.abs(values.sum(axis=0) - 1).max() > 1e-2:
            values = np.exp(values - values.max(axis=0))
            values /= values.sum(axis=0)
        return np.asarray(values[self.sky_class], np.float32)

    @cached_property
    def _network(self) -> Network:
        network = Network(read_network(Path(self.network)), str(self.network))
        inputs = network.header.inputs
        shapes = [one.shape for one in inputs]
        if len(inputs) != 1 or len(shapes[0]) != 4 or not {3, 0} & {shapes[0][1], shapes[0][3]}:
            wants = " and ".join(str(shape) for shape in shapes) or "nothing"
            raise MethodError(
                f"{self.network} takes {wants}, and not one photo (1, 3, rows, columns)."
            )
        return network


def enlarged(sky: F32, shape: tuple[int, ...], matrix: np.ndarray[Any, Any] | None = None) -> F32:
    """A map scaled to the shape ``(H, W)`` of a photo, bilinear.

    Args:
        sky: ``(h, w)`` map.
        shape: Rows and columns of the photo.
        matrix: ``(2, 3)`` from places in the photo to places in the map; None fits them together.
    """
    size = shape[1], shape[0]
    if matrix is None:
        return np.asarray(cv2.resize(sky, size, interpolation=cv2.INTER_LINEAR), np.float32)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    whole = cv2.warpAffine(sky, matrix, size, flags=flags, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(whole, np.float32)
