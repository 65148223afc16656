"""Gram matrices as files: what a shard of a training has gathered, and what all of them add up to.

A file is one of `system.headed_npz`. Its header says under ``gathered`` what was gathered and how,
and under ``shard`` which one it is, such as 3/8, as its name might have been changed since;
of the data set number K it holds ``sums_K``, ``samples_K`` and the fingerprints ``seen_K``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import reduce
from operator import add
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from skyline_viz.bins import Bins
from skyline_viz.config import DetectorConfig, TrainingConfig
from skyline_viz.files import replacing
from skyline_viz.running.line_table import TableError
from skyline_viz.running.resume import digest_of
from skyline_viz.running.shards import Shard, check_own, shards_in
from skyline_viz.system import headed_npz
from skyline_viz.system.headed_npz import HeadedNpz, NpzError, opened
from skyline_viz.training import GramMatrices

SUFFIX = ".npz"
"""How the name of such a file ends."""

_PRINT = 40  # bytes of a fingerprint


@dataclass(frozen=True)
class Gathered:
    """What a training has gathered."""

    method: str
    """What is trained, as `find_method` takes it."""

    training: TrainingConfig
    """How samples were drawn, and filters are to be solved."""

    seed: int
    """Seed of the negative samples."""

    photos: int
    """Photos of all data sets, with a truth or without."""

    sets: Mapping[str, GramMatrices]
    """Sums over the photos of each data set, by its name."""

    def about(self) -> dict[str, Any]:
        """All but the sums, which is the same in all shards of a training."""
        told = {"method": self.method, "training": asdict(self.training), "seed": self.seed}
        return {**told, "photos": self.photos, "sets": [*self.sets], "program": digest_of()}


def write_gathered(folder: Path, shard: Shard, gathered: Gathered) -> Path:
    """Write what a shard has gathered into a folder, whole or not at all; return the file.

    Raises:
        OSError: The disk is full or read-only.
    """
    arrays: dict[str, npt.NDArray[Any]] = {}
    images = []
    for number, gram in enumerate(gathered.sets.values()):
        prints = bytes.fromhex("".join(gram.seen))
        arrays[f"sums_{number}"] = gram.sums
        arrays[f"samples_{number}"] = gram.samples
        arrays[f"seen_{number}"] = np.frombuffer(prints, np.uint8)
        images.append(gram.images)
    header = {"shard": str(shard), "gathered": {**gathered.about(), "images": images}}
    path = folder / shard.file_of(SUFFIX)
    with replacing(path) as temporary, temporary.open("wb") as file:
        headed_npz.write(file, header, arrays)
    return path


def joined(folder: Path) -> Gathered:
    """What all shards of a folder have gathered together.

    Raises:
        TableError: A shard is missing or damaged, is another one than its name says, or was
            gathered otherwise than the first one.
        OSError: A file cannot be read.
    """
    first: tuple[Path, Gathered, dict[str, Any]] | None = None
    sets: dict[str, GramMatrices] = {}
    for shard, path in shards_in(folder, SUFFIX):
        gathered, about = _read(path, shard)
        if first is None:
            first, sets = (path, gathered, about), dict(gathered.sets)
            continue
        if about != first[2]:
            raise TableError(f"{path} was gathered otherwise, or from others, than {first[0]}.")
        sets = {name: reduce(add, (sets[name], gram)) for name, gram in gathered.sets.items()}
    assert first is not None  # a folder without shards is refused
    one = first[1]
    return Gathered(one.method, one.training, one.seed, one.photos, sets)


def _read(path: Path, shard: Shard) -> tuple[Gathered, dict[str, Any]]:
    try:
        with opened(path, headed_npz.MOST_BYTES) as file:
            check_own(path, shard, file.header.get("shard"))
            about = dict(file.header["gathered"])
            images = about.pop("images")
            told = dict(about["training"])
            bins = Bins(**told.pop("bins"))
            detector = DetectorConfig.from_file(told.pop("detector"))
            training = TrainingConfig(bins=bins, detector=detector, **told)
            sets = {
                str(name): _gram(file, number, int(images[number]), training)
                for number, name in enumerate(about["sets"])
            }
            settings = str(about["method"]), training, int(about["seed"]), int(about["photos"])
    except TableError:
        raise
    except (NpzError, LookupError, TypeError, ValueError, AttributeError) as error:
        raise TableError(f"{path} is damaged, or no shard of a training.") from error
    return Gathered(*settings, sets), about


def _gram(file: HeadedNpz, number: int, images: int, training: TrainingConfig) -> GramMatrices:
    sums, samples, seen = (file.read(f"{one}_{number}") for one in ("sums", "samples", "seen"))
    empty = GramMatrices.empty(training)
    for found, wanted in ((sums, empty.sums), (samples, empty.samples)):
        if found.shape != wanted.shape or found.dtype != wanted.dtype:
            raise ValueError("its sums have another shape or type")
    digits = seen.astype(np.uint8).tobytes()
    prints = [digits[at : at + _PRINT].hex() for at in range(0, len(digits), _PRINT)]
    return GramMatrices(sums, samples, samples.astype(np.float64), images, tuple(prints))
