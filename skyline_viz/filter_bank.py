"""The filter bank: a small linear filter for every bin, and where it comes from."""

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, fields
from importlib import resources
from typing import Any

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, read_only
from skyline_viz.bins import Bins
from skyline_viz.config import FILTER_SIZES, DetectorConfig, EdgeSource
from skyline_viz.files import replacing
from skyline_viz.system import headed_npz
from skyline_viz.system.fingerprints import packed, unpacked
from skyline_viz.system.headed_npz import HeadedNpz, NpzError, Stored, opened
from skyline_viz.system.settings import plain_number

EARLIER_FORMAT, EARLIER_VERSION = "skyline-viz filter bank", 1
"""How the header of banks began that were written before detectors were files."""

STARVED_SAMPLES = 50
"""A bin is starved when fewer training samples than this fell into it."""

MOST_BYTES = 1 << 26
"""Bytes that a bank may take: a thousand bins of the largest filters take 1 MB."""

_DTYPES = {"filters": np.dtype(np.float32), "samples": np.dtype(np.int64)}
_GONE = {"terrain"}  # arrays that banks of earlier versions have, and nobody needs


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
    """What Canny saw when the samples were drawn, ``grey`` or ``colour``."""

    smoothness: float = 0.0
    """Weight of ``Q``."""

    package: str = ""
    """Version of skyline-viz."""

    detector: DetectorConfig | None = None
    """Settings of the detector for which it was trained; banks of earlier versions know none."""

    reach: int = 0
    """See `TrainingConfig`; banks of earlier versions, which do not tell, have 0."""

    pooling: float = 50.0
    """See `TrainingConfig`; banks of earlier versions pooled bins of fewer samples only."""

    def __post_init__(self) -> None:
        """Make numbers Python's own, as files need them."""
        for name in ("images", "seed", "reach", "smoothness", "pooling"):
            value = plain_number(getattr(self, name), real=name in ("smoothness", "pooling"))
            object.__setattr__(self, name, value)

    @property
    def settings(self) -> DetectorConfig:
        """Settings to detect with: those that it was trained for, as far as they are known."""
        if self.detector is not None:
            return self.detector
        known: EdgeSource = "grey" if self.edges == "grey" else "colour"
        return DetectorConfig(edge_source=known)


@dataclass(frozen=True, eq=False)
class FilterBank:
    """A learned filter for every bin.

    Examples:
        >>> bank = FilterBank.default()
        >>> bank.filters.shape, int(bank.starved.sum())
        ((288, 7, 7), 120)
    """

    filters: F32
    """``(K, n, n)`` taps, bin by bin; a filter times a patch of grey levels gives 0 to 255."""

    samples: npt.NDArray[np.int64]
    """``(K,)`` training samples, flipped ones included, that fell into each bin."""

    bins: Bins = field(default_factory=Bins)
    """How a pixel finds its bin; ``K`` is ``bins.count``."""

    provenance: Provenance = field(default_factory=Provenance)
    """What the bank was trained on."""

    seen: tuple[str, ...] = ()
    """Fingerprints of the training photos, by which they are known again; banks of earlier versions
    have none."""

    def __repr__(self) -> str:
        """One line, as a console shows it."""
        side = self.filters.shape[-1]
        made = self.provenance
        learned = f", learned from {made.images} photos of {made.dataset}" if made.images else ""
        return f"FilterBank({len(self.filters)} filters of {side} x {side} pixels{learned})"

    def __post_init__(self) -> None:
        """Check and freeze the arrays."""
        filters = np.array(self.filters, np.float32)
        samples = np.array(self.samples, np.int64)
        count = self.bins.count
        if filters.ndim != 3 or filters.shape[0] != count or filters.shape[1] != filters.shape[2]:
            raise FilterBankError(f"{count} bins need filters ({count}, n, n), not {filters.shape}")
        if filters.shape[1] not in FILTER_SIZES:
            raise FilterBankError(
                f"filters are {FILTER_SIZES} pixels a side, not {filters.shape[1]}"
            )
        if samples.shape != (count,) or (samples < 0).any():
            raise FilterBankError(f"{count} bins need {count} sample counts of 0 or more")
        if not np.isfinite(filters).all():
            raise FilterBankError("a filter has a weight that is not finite")
        for name, array in (("filters", filters), ("samples", samples)):
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
        """Write one ``.npz`` file, whole or not at all; the same bank gives the same bytes.

        Raises:
            SettingError: It was trained for settings of a class of somebody's.
        """
        self.provenance.settings.require_ours()
        with replacing(path) as temporary, temporary.open("wb") as file:
            headed_npz.write(file, self.header(), self.arrays())

    def header(self) -> dict[str, Any]:
        """What a file that holds the bank says of it."""
        about = {"bins": asdict(self.bins), "provenance": asdict(self.provenance)}
        return {"bank": {**about, "seen": packed(self.seen)} if self.seen else about}

    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """The arrays of a file that holds the bank."""
        return {"filters": self.filters, "samples": self.samples}

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> "FilterBank":
        """Read what `save` wrote, or the bank of a detector's file; nothing is ever unpickled.

        Raises:
            FilterBankError: Missing, damaged, another kind of file, or of a newer version.
        """
        with bank_file(path) as file:
            return read_bank(file, path)

    @classmethod
    def default(cls) -> "FilterBank":
        """Return the shipped filter bank."""
        with resources.as_file(resources.files("skyline_viz") / "filter_bank.npz") as path:
            return cls.load(path)


@contextmanager
def bank_file(path: str | os.PathLike[str] | bytes) -> Iterator[HeadedNpz]:
    """The open file of a bank, or of a detector.

    Raises:
        FilterBankError: It is missing, or turns out to be damaged in the block.
    """
    name = "the bank" if isinstance(path, bytes) else str(path)
    try:
        with opened(path, MOST_BYTES) as file:
            yield file
    except FileNotFoundError:
        raise FilterBankError(f"{name} does not exist.") from None
    except NpzError as error:
        raise FilterBankError(f"{name} is damaged or not a filter bank: {error}.") from error


def read_bank(file: HeadedNpz, path: str | os.PathLike[str] | bytes) -> FilterBank:
    """The bank in an open file, which may hold more than that.

    Raises:
        FilterBankError: There is none, or of another version, or it is not valid.
        NpzError: It is damaged.
    """
    name = "the bank" if isinstance(path, bytes) else str(path)
    header, version = file.header, headed_npz.VERSION
    told = header.get("bank")
    if header.get("format") == EARLIER_FORMAT:
        told, version = header, EARLIER_VERSION
    elif header.get("format") != headed_npz.FORMAT or told is None:
        raise FilterBankError(f"{name} is not a filter bank.")
    if header.get("version") != version:
        raise FilterBankError(
            f"{name} is a filter bank of version {str(header.get('version'))[:20]}; "
            f"this program reads version {version}."
        )
    bins, provenance = _described(told)
    _check_announced(file.arrays, bins.count)
    filters, samples = (file.read(part) for part in _DTYPES)
    try:
        return FilterBank(filters, samples, bins, provenance, _seen(told))
    except (ValueError, TypeError) as error:
        raise FilterBankError(f"{name} holds no valid filter bank: {error}.") from error


def _described(header: dict[str, Any]) -> tuple[Bins, Provenance]:
    """Bins and provenance as the part of a header about the bank tells them.

    Raises:
        NpzError: It tells something else.
    """
    try:
        bins, told = Bins(**header["bins"]), dict(header["provenance"])
        settings = told.pop("detector", None)
        detector = None if settings is None else DetectorConfig.from_file(settings)
        kinds = {one.name: type(one.default) for one in fields(Provenance)}
        for name, value in told.items():
            wanted = (int, float) if kinds[name] is float else kinds[name]
            if not isinstance(value, wanted) or isinstance(value, bool):
                raise NpzError(f"its header tells no {name}")
        return bins, Provenance(**told, detector=detector)
    except NpzError:
        raise
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
        raise NpzError("its header tells no bins or no provenance") from error


def _seen(header: dict[str, Any]) -> tuple[str, ...]:
    """The fingerprints that a header tells.

    Raises:
        NpzError: It tells something else.
    """
    try:
        return unpacked(header.get("seen", ""))
    except ValueError as error:
        raise NpzError("its header tells no fingerprints of photos") from error


def _check_announced(arrays: Mapping[str, Stored], count: int) -> None:
    """Refuse what is not a bank of so many bins, before a byte of it is unpacked.

    Raises:
        NpzError: The message names the array.
    """
    sides = arrays["filters"].shape[-1:] if "filters" in arrays else ()
    shapes = {"filters": (count, *sides, *sides), "samples": (count,)}
    for name, dtype in _DTYPES.items():
        if name not in arrays:
            raise NpzError(f"its {name} is missing")
        if arrays[name].dtype != dtype:
            raise NpzError(f"its {name} has another type")
        if arrays[name].shape != shapes[name]:
            raise NpzError(f"its {name} has the shape {arrays[name].shape}, not {shapes[name]}")
    if more := {name for name in arrays if "__" not in name} - set(_DTYPES) - _GONE:
        raise NpzError(f"it holds {min(more)[:40]}, which no bank has")
