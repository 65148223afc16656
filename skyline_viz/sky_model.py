"""The sky model: a learned map of what is sky, region by region, before anything else is seen.

A small network sees the whole photo, reduced, and says of each region how probably it is sky: what
no edge and no filter of a few pixels can know. The shipped ones come in two sizes; any other
network that tells sky can take the place, as an ONNX file that fixes the size of its input.
"""

from __future__ import annotations

import json
import os
import threading
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib import resources
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, U8, check_photo
from skyline_viz.networks.onnx_files import (
    MEAN,
    STD,
    Network,
    probabilities,
    read_network,
    read_notes,
)
from skyline_viz.networks.trial import digest_of, remember, survived
from skyline_viz.system.fingerprints import unpacked
from skyline_viz.system.headed_npz import HeadedNpz, NpzError
from skyline_viz.system.settings import MethodError

SHIPPED = ("small", "large")
"""The models that come with the package: that of the default, and a larger and slower one."""

PLAIN_INPUT = "photo"
"""Name of an input that takes RGB in [0, 1]; by any other name it is less ImageNet's mean, over its
standard deviation."""

NETWORK = "sky__network"
"""The array of a file that holds the network."""

TRAINED = "trained"
"""Name of the note of a file that says what the network was trained on, as JSON: ``photos`` holds
the number of photos by data set, and ``of`` how many it has, where only a part of them was read."""

SEEN = "seen"
"""Name of the note that holds fingerprints of these photos, see `system.fingerprints.packed`."""

LOGITS = "logit"
"""Name of an output that gives logits; by any other name it gives what its values look like."""


@dataclass(frozen=True)
class SkyModel:
    """A network that says how probably each region of a photo is sky.

    Examples:
        >>> photo = np.full((90, 160, 3), 200, np.uint8)
        >>> photo[60:] = (60, 50, 40)
        >>> sky = SkyModel.small().sky(photo)
        >>> bool(sky[0].mean() > sky[-1].mean())
        True
    """

    name: str
    """``small``, ``large``, or the name of its file."""

    network: bytes = field(repr=False)
    """The content of its ONNX file."""

    @classmethod
    def small(cls) -> SkyModel:
        """Return the shipped model that takes about half as long as Canny in a grey photo."""
        return _shipped("small")

    @classmethod
    def large(cls) -> SkyModel:
        """Return the shipped model that sees more, and takes some times as long as Canny."""
        return _shipped("large")

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> SkyModel:
        """Read a sky network from an ONNX file, and run it once.

        It takes one photo ``(1, 3, rows, columns)``, of a size that the file fixes, and its first
        output is one map ``(1, 1, h, w)`` or ``(1, h, w)``.

        Raises:
            MethodError: The file is missing, or its network takes or gives something else.
        """
        model = cls(Path(path).name, read_network(Path(path)))
        model.check(str(path))
        return model

    @classmethod
    def named(cls, text: str | os.PathLike[str]) -> SkyModel:
        """The model of a name: ``small``, ``large``, or that of an ONNX file.

        Raises:
            MethodError: There is none of that name, or it is of no use.
        """
        if text in SHIPPED:
            return _shipped(str(text))
        if Path(text).suffix.lower() != ".onnx":
            raise MethodError(f"{text} is no sky model: name small, large, or a FILE.onnx.")
        return cls.load(text)

    def check(self, name: str = "") -> None:
        """Run it once.

        Args:
            name: What to call it in messages.

        Raises:
            MethodError: Its network takes or gives something else.
        """
        self._map(self._opened(name or self.said), np.zeros((2, 2, 3), np.uint8))

    @property
    def said(self) -> str:
        """What it is called in sentences."""
        return f"the sky model {self.name}"

    @cached_property
    def learned_from(self) -> str:
        """Names of the data sets that it was trained on, ``", "`` between; empty if not known."""
        return ", ".join(self.photos_learned)

    @cached_property
    def photos_learned(self) -> dict[str, int]:
        """From how many photos of each data set it has learned; empty if not known."""
        try:
            photos = json.loads(read_notes(self.network)[TRAINED])["photos"]
            return {str(name): int(count) for name, count in photos.items()}
        except (ValueError, KeyError, TypeError, AttributeError):
            return {}  # a network of somebody's

    @cached_property
    def seen(self) -> tuple[str, ...]:
        """Fingerprints of the photos that it was trained on; none if these are not known."""
        try:
            return unpacked(read_notes(self.network).get(SEEN, ""))
        except ValueError:
            return ()  # a network of somebody's

    def sky(self, photo: U8) -> F32:
        """How probably each region of a photo is sky, ``(h, w)`` float32 in [0, 1].

        Region ``(a, b)`` are the rows ``a H / h`` to ``(a + 1) H / h`` and the columns ``b W / w``
        to ``(b + 1) W / w``, wherever these fall between pixels.

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.

        Raises:
            TypeError: Not a uint8 array.
            ValueError: Another shape.
            MethodError: The network takes or gives something else.
        """
        check_photo(photo)
        return self._map(self._network, photo)

    def header(self) -> dict[str, Any]:
        """What a file that holds the model says of it."""
        return {"sky": self.name}

    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """The array of a file that holds the model: the bytes of its network."""
        return {NETWORK: np.frombuffer(self.network, np.uint8)}

    @classmethod
    def read(cls, file: HeadedNpz) -> SkyModel | None:
        """The model in an open file; None in a file without one.

        Raises:
            NpzError: It is of no use.
        """
        if NETWORK not in file.arrays:
            return None
        name, network = file.header.get("sky"), file.read(NETWORK)
        if not isinstance(name, str) or network.dtype != np.uint8:
            raise NpzError("its sky model has no name, or is no file")
        model = cls(name, network.tobytes())
        try:
            model.check()
        except MethodError as error:
            raise NpzError(str(error).rstrip(".")) from error
        return model

    @property
    def _network(self) -> Network:
        """The network, opened once in each thread: a run changes it."""
        opened: Network | None = getattr(self._here, "network", None)
        if opened is None:
            opened = self._here.network = self._opened(self.said)
        return opened

    @cached_property
    def _here(self) -> threading.local:
        return threading.local()

    def _opened(self, name: str) -> Network:
        if self.name in SHIPPED:
            with suppress(MethodError):  # of a file that an installation before this one wrote
                _shipped(self.name)  # from then on such a content is known to do no harm
        network = Network(self.network, name, classic=True)
        shapes = [one.shape for one in network.header.inputs]
        if len(shapes) != 1 or len(shapes[0]) != 4 or shapes[0][1] != 3:
            wants = " and ".join(map(str, shapes))
            raise MethodError(f"{name} takes {wants}, and not one photo (1, 3, rows, columns).")
        if not all(shapes[0][2:]):
            raise MethodError(f"{name} takes photos of any size; a sky model fixes its size.")
        return network

    def _map(self, network: Network, photo: U8) -> F32:
        """The map that an opened network gives."""
        taken, given = network.header.inputs[0], network.header.outputs[0]
        rows, columns = taken.shape[2:]
        blob: F32 = cv2.dnn.blobFromImage(reduced(photo, rows, columns), 1 / 255)
        if taken.name != PLAIN_INPUT:
            mean, std = (np.array(one, np.float32).reshape(1, 3, 1, 1) for one in (MEAN, STD))
            blob = (blob - mean) / std
        output = network.run(blob)
        if output.ndim not in (3, 4) or set(output.shape[:-2]) != {1} or not output.size:
            raise MethodError(
                f"{network.name} gives {output.shape}, and not one map (1, 1, rows, columns)."
            )
        values = output.reshape(output.shape[-2:]).astype(np.float32)
        return probabilities(values, logits=given.name == LOGITS)

    def __reduce__(self) -> tuple[Any, ...]:
        """Go to other processes: by name if shipped, else with the word that it was tried."""
        if self.name in SHIPPED and self == _shipped(self.name):
            return _shipped, (self.name,)
        tried = survived(digest_of(self.network, classic=True))
        return _received, (self.name, self.network, tried)


def reduced(photo: U8, rows: int, columns: int) -> U8:
    """The whole photo at the size that a network takes.

    In two steps: to four times the columns and twice the rows by looking at single pixels, and from
    there by means of areas. So the time does not grow with the photo, and little is lost; photos
    that are no larger are reduced by areas alone.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        rows: Rows of the result.
        columns: Columns of the result.
    """
    height, width = photo.shape[:2]
    between = min(width, 4 * columns), min(height, 2 * rows)
    if between != (width, height):
        photo = np.asarray(cv2.resize(photo, between, interpolation=cv2.INTER_LINEAR), np.uint8)
    small = cv2.resize(photo, (columns, rows), interpolation=cv2.INTER_AREA)
    return np.asarray(small, np.uint8)


@cache
def _shipped(name: str) -> SkyModel:
    """A model that comes with the package, which need not be tried before it is opened.

    Raises:
        MethodError: Its file is missing.
    """
    file = resources.files("skyline_viz") / f"sky_{name}.onnx"
    try:
        network = file.read_bytes()
    except OSError as error:
        raise MethodError(
            f"the sky model {name} is missing: {file} cannot be read; install skyline-viz anew."
        ) from error
    remember(digest_of(network, classic=True))
    return SkyModel(name, network)


def _received(name: str, network: bytes, tried: bool) -> SkyModel:
    """A model that comes from another process, which may have tried its network."""
    if tried:
        remember(digest_of(network, classic=True))
    return SkyModel(name, network)
