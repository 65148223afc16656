"""The filter bank: a small linear filter for every bin, and where it comes from."""

import json
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from importlib import resources
from typing import Any

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, read_only
from skyline_viz.bins import Bins
from skyline_viz.config import FILTER_SIZES
from skyline_viz.files import replacing
from skyline_viz.system.headed_npz import NpzError, Stored, opened
from skyline_viz.terrain import FEATURES

FORMAT = "skyline-viz filter bank"
VERSION = 1
STARVED_SAMPLES = 50
"""A bin is starved when fewer training samples than this fell into it."""

_MOST_BYTES = 1 << 26  # that a bank may take: a thousand bins of the largest filters take 1 MB

_DTYPES = {
    "filters": np.dtype(np.float32),
    "samples": np.dtype(np.int64),
    "terrain": np.dtype(np.float32),
}


class FilterBankError(ValueError):
    """A filter bank, or a file that should hold one, is not valid; the message says why."""


@dataclass(frozen=True)
class Provenance:
    """What a filter bank was trained on."""

    dataset: str = ""
    """Name of the data set."""

    images: int = 0
    """Number of training photos."""

    seed: int = 0
    """Seed of the negative samples."""

    edges: str = "colour"
    """What Canny saw when the negatives were drawn, ``grey`` or ``colour``."""

    smoothness: float = 0.0
    """Weight of ``Q``."""

    package: str = ""
    """Version of skyline-viz."""


@dataclass(frozen=True, eq=False)
class FilterBank:
    """A learned filter for every bin.

    Examples:
        >>> bank = FilterBank.default()
        >>> bank.filters.shape, int(bank.starved.sum())
        ((288, 7, 7), 181)
    """

    filters: F32
    """``(K, n, n)`` taps, bin by bin; a filter times a patch of grey levels gives 0 to 255."""

    samples: npt.NDArray[np.int64]
    """``(K,)`` training samples, flipped ones included, that fell into each bin."""

    terrain: F32 = field(default_factory=lambda: np.zeros(FEATURES, np.float32))
    """``(FEATURES,)`` weights of the block model of sky and terrain; zeros say nothing."""

    bins: Bins = field(default_factory=Bins)
    """How a pixel finds its bin; ``K`` is ``bins.count``."""

    provenance: Provenance = field(default_factory=Provenance)
    """What the bank was trained on."""

    def __post_init__(self) -> None:
        """Check and freeze the arrays."""
        filters = np.array(self.filters, np.float32)
        samples = np.array(self.samples, np.int64)
        terrain = np.array(self.terrain, np.float32)
        count = self.bins.count
        if filters.ndim != 3 or filters.shape[0] != count or filters.shape[1] != filters.shape[2]:
            raise FilterBankError(f"{count} bins need filters ({count}, n, n), not {filters.shape}")
        if filters.shape[1] not in FILTER_SIZES:
            raise FilterBankError(
                f"filters are {FILTER_SIZES} pixels a side, not {filters.shape[1]}"
            )
        if samples.shape != (count,) or (samples < 0).any():
            raise FilterBankError(f"{count} bins need {count} sample counts of 0 or more")
        if terrain.shape != (FEATURES,):
            raise FilterBankError(f"the block model has {FEATURES} weights, not {terrain.shape}")
        if not (np.isfinite(filters).all() and np.isfinite(terrain).all()):
            raise FilterBankError("a filter or the block model has a weight that is not finite")
        for name, array in (("filters", filters), ("samples", samples), ("terrain", terrain)):
            read_only(array)
            object.__setattr__(self, name, array)

    @property
    def size(self) -> int:
        """Pixels a side of a filter."""
        return int(self.filters.shape[1])

    @property
    def starved(self) -> npt.NDArray[np.bool_]:
        """``(K,)`` True for bins with fewer than `STARVED_SAMPLES` samples."""
        return self.samples < STARVED_SAMPLES

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write one ``.npz`` file, whole or not at all; the same bank gives the same bytes."""
        header = {
            "format": FORMAT,
            "version": VERSION,
            "bins": asdict(self.bins),
            "provenance": asdict(self.provenance),
        }
        arrays = {
            "header": np.frombuffer(json.dumps(header).encode(), np.uint8),
            "filters": self.filters,
            "samples": self.samples,
            "terrain": self.terrain,
        }
        with replacing(path) as temporary, temporary.open("wb") as file:
            np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # ** reaches allow_pickle

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> "FilterBank":
        """Read what `save` wrote; nothing is ever unpickled.

        Raises:
            FilterBankError: Missing, damaged, another kind of file, or of a newer version.
        """
        try:
            with opened(path, _MOST_BYTES) as file:
                header = file.header
                if header.get("format") != FORMAT:
                    raise FilterBankError(f"{path} is not a filter bank.")
                if header.get("version") != VERSION:
                    raise FilterBankError(
                        f"{path} is a filter bank of version {str(header.get('version'))[:20]}; "
                        f"this program reads version {VERSION}."
                    )
                bins, provenance = _described(header)
                _check_announced(file.arrays, bins.count)
                filters, samples, terrain = (file.read(name) for name in _DTYPES)
        except FileNotFoundError:
            raise FilterBankError(f"{path} does not exist.") from None
        except NpzError as error:
            raise FilterBankError(f"{path} is damaged or not a filter bank: {error}.") from error
        try:
            return cls(filters, samples, terrain, bins, provenance)
        except (ValueError, TypeError) as error:
            raise FilterBankError(f"{path} holds no valid filter bank: {error}.") from error

    @classmethod
    def default(cls) -> "FilterBank":
        """Return the shipped filter bank."""
        with resources.as_file(resources.files("skyline_viz") / "filter_bank.npz") as path:
            return cls.load(path)


def _described(header: dict[str, Any]) -> tuple[Bins, Provenance]:
    """Bins and provenance as a header tells them.

    Raises:
        NpzError: It tells something else.
    """
    try:
        bins, told = Bins(**header["bins"]), header["provenance"]
        kinds = {one.name: type(one.default) for one in fields(Provenance)}
        for name, value in told.items():
            wanted = (int, float) if kinds[name] is float else kinds[name]
            if not isinstance(value, wanted) or isinstance(value, bool):
                raise NpzError(f"its header tells no {name}")
        return bins, Provenance(**told)
    except NpzError:
        raise
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
        raise NpzError("its header tells no bins or no provenance") from error


def _check_announced(arrays: Mapping[str, Stored], count: int) -> None:
    """Refuse what is not a bank of so many bins, before a byte of it is unpacked.

    Raises:
        NpzError: The message names the array.
    """
    sides = arrays["filters"].shape[-1:] if "filters" in arrays else ()
    shapes = {"filters": (count, *sides, *sides), "samples": (count,), "terrain": (FEATURES,)}
    for name, dtype in _DTYPES.items():
        if name not in arrays:
            raise NpzError(f"its {name} is missing")
        if arrays[name].dtype != dtype:
            raise NpzError(f"its {name} has another type")
        if arrays[name].shape != shapes[name]:
            raise NpzError(f"its {name} has the shape {arrays[name].shape}, not {shapes[name]}")
    if more := set(arrays) - set(_DTYPES):
        raise NpzError(f"it holds {min(more)[:40]}, which no bank has")
