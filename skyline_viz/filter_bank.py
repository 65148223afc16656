"""The filter bank: a small linear filter for every bin, and where it comes from."""

import json
import os
import struct
import zipfile
import zlib
from dataclasses import asdict, dataclass, field
from importlib import resources
from pathlib import Path

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, read_only
from skyline_viz.bins import Bins
from skyline_viz.config import FILTER_SIZES
from skyline_viz.files import replacing
from skyline_viz.terrain import FEATURES

FORMAT = "skyline-viz filter bank"
VERSION = 1
STARVED_SAMPLES = 50
"""A bin is starved when fewer training samples than this fell into it."""

_DAMAGE = (
    *(OSError, ValueError, LookupError, TypeError, EOFError, RuntimeError, ArithmeticError),
    *(MemoryError, zipfile.BadZipFile, zlib.error, struct.error),
)  # what numpy, zipfile and json raise on damaged files


_DTYPES = (np.dtype(np.float32), np.dtype(np.int64), np.dtype(np.float32))


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
    """A learned filter for every bin."""

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
            # np.load, given a path, leaves damaged files open
            with Path(path).open("rb") as file:
                if not zipfile.is_zipfile(file):
                    raise FilterBankError(f"{path} is damaged or not a filter bank.")
            with Path(path).open("rb") as file, np.load(file, allow_pickle=False) as archive:
                if "header" not in archive:
                    raise FilterBankError(f"{path} is not a filter bank.")
                header = json.loads(archive["header"].tobytes())
                if not isinstance(header, dict) or header.get("format") != FORMAT:
                    raise FilterBankError(f"{path} is not a filter bank.")
                if header.get("version") != VERSION:
                    raise FilterBankError(
                        f"{path} is a filter bank of version {header.get('version')}; "
                        f"this program reads version {VERSION}."
                    )
                filters, samples = archive["filters"], archive["samples"]
                terrain = archive["terrain"]
                if (filters.dtype, samples.dtype, terrain.dtype) != _DTYPES:
                    raise FilterBankError(f"{path} is damaged: its arrays have other types.")
                bins = Bins(**header["bins"])
                provenance = Provenance(**header["provenance"])
        except FileNotFoundError:
            raise FilterBankError(f"{path} does not exist.") from None
        except FilterBankError:
            raise
        except _DAMAGE as error:
            raise FilterBankError(f"{path} is damaged or not a filter bank.") from error
        try:
            return cls(filters, samples, terrain, bins, provenance)
        except (ValueError, TypeError) as error:
            raise FilterBankError(f"{path} holds no valid filter bank: {error}.") from error

    @classmethod
    def default(cls) -> "FilterBank":
        """Return the shipped filter bank."""
        with resources.as_file(resources.files("skyline_viz") / "filter_bank.npz") as path:
            return cls.load(path)
