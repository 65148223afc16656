"""Methods by name, and trained ones as files."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from importlib import import_module
from pathlib import Path
from typing import Any, get_args

import numpy as np

from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.files import replacing
from skyline_viz.filter_bank import FilterBank, FilterBankError
from skyline_viz.method import LearnedMethod, Method, MethodError
from skyline_viz.methods.names import MethodName
from skyline_viz.system.headed_npz import HeadedNpz, NpzError, opened

NAMES: tuple[str, ...] = get_args(MethodName)
"""All names, in the order of the paper's Table I."""

FORMAT, VERSION = "skyline-method", 1

_LARGEST = 1_000_000  # setting of any method: pixels, costs, epochs

_CLASSES = {
    "edges": ("edges_only", "EdgesOnly"),
    "gradient": ("gradient", "GradientCost"),
    "sift-hog-edges": ("sift_hog", "SiftHogEdges"),
    "sift-hog-scores-gradient": ("sift_hog", "SiftHogScoresGradient"),
    "sift-hog-scores": ("sift_hog", "SiftHogScores"),
    "svm": ("dense_scores", "SvmScores"),
    "cnn": ("cnn_scores", "CnnScores"),
    "fcn-8s": ("parsing", "Fcn8s"),
    "fcn-16s": ("parsing", "Fcn16s"),
    "fcn-32s": ("parsing", "Fcn32s"),
    "segnet": ("parsing", "SegNet"),
}
"""Module and class of the methods whose names begin so."""


@dataclass(frozen=True)
class Trained:
    """What a trained method was learned from."""

    dataset: str = ""
    """Name of the data set."""

    images: int = 0
    """Number of photos."""

    seed: int = 0
    """Seed of what was drawn."""


def make_method(name: str) -> Method:
    """A method by its name; one that learns has learned nothing yet, but for our detector.

    Raises:
        MethodError: There is none of that name.
    """
    if name in ("default", "paper"):
        return Detector(config=DetectorConfig.paper() if name == "paper" else DetectorConfig())
    if name not in NAMES:
        raise MethodError(f"there is no method {name}; there are {', '.join(NAMES)}.")
    module, kind = next(home for start, home in _CLASSES.items() if name.startswith(start))
    method: Method = getattr(import_module(f"skyline_viz.methods.{module}"), kind)(name=name)
    return method


def find_method(text: str) -> Method:
    """A method by its name, or by the file of a trained one or of a filter bank.

    Raises:
        MethodError: It is neither.
    """
    if text in NAMES:
        return make_method(text)
    path = Path(text)
    if path.suffix != ".npz" and not path.exists():
        raise MethodError(
            f"{text} is neither a method nor the file of a trained one; "
            f"methods are {', '.join(NAMES)}."
        )
    return load_method(path)


def save_method(method: Method, path: str | os.PathLike[str], trained: Trained) -> None:
    """Write a method, with what it has learned, as one ``.npz`` file, whole or not at all."""
    settings = {
        one.name: getattr(method, one.name)
        for one in fields(method)  # type: ignore[arg-type]  # all methods are dataclasses
        if one.name not in ("name", "model")
    }
    if "network" in settings:
        settings["network"] = Path(settings["network"]).resolve()
    header = {
        "format": FORMAT,
        "version": VERSION,
        "name": method.name,
        "settings": settings,
        "digest": method_digest(method),
        "trained": asdict(trained),
    }
    arrays: dict[str, Any] = {
        "header": np.frombuffer(json.dumps(header, default=str).encode(), np.uint8),
        **getattr(method, "model", {}),
    }
    with replacing(path) as temporary, temporary.open("wb") as file:
        np.savez_compressed(file, **arrays)


def load_method(path: Path) -> Method:
    """Read what `save_method` wrote, or a filter bank; nothing is ever unpickled.

    Raises:
        MethodError: Missing, damaged, another kind of file, or of another version.
    """
    try:
        with opened(path) as file:
            if file.header.get("format") == FORMAT:
                return _loaded(path, file)
    except FileNotFoundError:
        raise MethodError(f"{path} does not exist.") from None
    except NpzError as error:
        raise MethodError(f"{path} is damaged or no trained method: {error}.") from error
    try:
        return Detector(FilterBank.load(path))
    except FilterBankError as error:
        raise MethodError(f"{path} is neither a trained method nor a filter bank.") from error


def _loaded(path: Path, file: HeadedNpz) -> Method:
    """The method in a file whose header is one of ours.

    Raises:
        NpzError: An array is damaged.
        MethodError: Something else is.
    """
    header = file.header
    if header.get("version") != VERSION:
        said = str(header.get("version"))[:20]
        raise MethodError(f"{path} is of version {said}, not {VERSION}.")
    name, settings = header.get("name"), header.get("settings")
    if not isinstance(name, str) or not isinstance(settings, dict):
        raise MethodError(f"{path} is damaged: its header names no method.")
    try:
        if name == "network":
            return _network(settings, str(header.get("digest")))
        made: Any = make_method(name)
        if not isinstance(made, LearnedMethod):
            model = {}
        else:
            made.check_announced(file.arrays)
            model = {"model": {part: file.read(part) for part in made.model_shapes()}}
        loaded: Method = type(made)(name=name, **model, **settings)
        if isinstance(loaded, LearnedMethod):
            loaded.check_model()
        _check_settings(loaded, made)
    except (NpzError, MethodError):
        raise
    except (LookupError, TypeError, ValueError, ArithmeticError) as error:
        raise MethodError(f"{path} is damaged: {_told(error)}.") from error
    return loaded


def _told(error: Exception) -> str:
    """What is wrong with settings; Python's words for it are no help."""
    ours = isinstance(error, _SettingError | ValueError)
    return str(error) if ours else "its settings are of another kind"


class _SettingError(TypeError):
    """A setting of another kind."""


def learned_from(text: str) -> str:
    """Name of the data set that a method, named or in a file, was trained on; empty if unknown.

    Raises:
        MethodError: There is no such method.
    """
    method = find_method(text)
    if isinstance(method, Detector):
        return method.bank.provenance.dataset
    if text in NAMES:
        return ""
    try:
        with opened(text) as file:
            trained = file.header.get("trained")
    except (NpzError, OSError) as error:
        raise MethodError(f"{text} is damaged or no trained method.") from error
    dataset = trained.get("dataset") if isinstance(trained, dict) else ""
    return dataset if isinstance(dataset, str) else ""


def _check_settings(loaded: Method, made: Method) -> None:
    """Refuse settings of other kinds than a new method of that name has, and absurd ones.

    Raises:
        _SettingError: The message names the setting.
    """
    for one in fields(made):  # type: ignore[arg-type]  # all methods are dataclasses
        value, usual = getattr(loaded, one.name), getattr(made, one.name)
        if one.name == "model" or (value is None and usual is None):
            continue
        number = isinstance(usual, float) and isinstance(value, int)
        path = usual is None and isinstance(value, str)
        fits = number or path or type(value) is type(usual)
        if fits and not isinstance(value, str):
            fits = abs(value) <= _LARGEST  # nor is it infinite, or no number at all
        if not fits:
            raise _SettingError(f"its {one.name} is {str(value)[:40]!r}")


def _network(settings: dict[str, Any], digest: str) -> Method:
    """A network from its settings; the file is the user's, and stays where it is.

    Raises:
        MethodError: The file is gone, or holds another network than before.
    """
    from skyline_viz.methods.sky_network import SkyNetwork  # noqa: PLC0415

    mean, std = tuple(settings.pop("mean")), tuple(settings.pop("std"))
    network = SkyNetwork(Path(settings.pop("network")), mean=mean, std=std, **settings)
    numbers = (network.sky_class, network.columns or 1, *mean, *std)
    if not all(type(one) in (int, float) and abs(one) <= _LARGEST for one in numbers):
        raise _SettingError("its settings are no numbers, or absurd ones")
    if not (len(mean) == len(std) == 3 and all(std) and (network.columns or 1) > 0):
        raise _SettingError("its settings fit no photo")
    if not network.network.is_file():
        raise MethodError(f"the network {network.network} is gone.")
    if method_digest(network) != digest:
        raise MethodError(f"the network {network.network} is another one than it was.")
    return network


def method_digest(method: Method) -> str:
    """Digest of a method's settings and of what it has learned: another one finds other lines."""
    digest = hashlib.sha256(type(method).__name__.encode())
    for one in fields(method):  # type: ignore[arg-type]  # all methods are dataclasses
        value = getattr(method, one.name)
        if isinstance(value, Mapping):
            for name, array in sorted(value.items()):
                digest.update(name.encode() + array.tobytes())
        elif isinstance(value, Path) and value.is_file():  # what it holds, wherever it lies
            with value.open("rb") as file:
                while piece := file.read(1 << 20):
                    digest.update(piece)
        else:
            digest.update(f"{one.name} {value}".encode())
    return digest.hexdigest()


def model_bytes(method: Method) -> int:
    """Size of what a method has learned, in bytes, as it lies in memory."""
    if isinstance(method, Detector):
        return method.bank.filters.nbytes
    if isinstance(method, LearnedMethod):
        return sum(array.nbytes for array in method.model.values())
    network = getattr(method, "network", None)
    return network.stat().st_size if isinstance(network, Path) else 0
