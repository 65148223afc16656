"""Methods as files: what they have learned and their settings, in the one format of such files.

A file never decides what is imported: it names one of our methods, or a class that somebody has
named in this process, or that an installed package offers.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import Any

from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.files import replacing
from skyline_viz.filter_bank import EARLIER_FORMAT as BANK_FORMAT
from skyline_viz.filter_bank import FilterBankError
from skyline_viz.method import Configurable, LearnedMethod, Method, MethodError
from skyline_viz.methods.finding.plugins import PluggedIn, as_method, plugged_from_file
from skyline_viz.methods.names import HOMES
from skyline_viz.methods.sky_network import SkyNetwork
from skyline_viz.system import headed_npz
from skyline_viz.system.fingerprints import packed, unpacked
from skyline_viz.system.headed_npz import HeadedNpz, NpzError, opened
from skyline_viz.system.nearest import meant
from skyline_viz.system.settings import SettingError, plain_number

EARLIER_FORMAT, EARLIER_VERSION = "skyline-method", 1
"""How the header of methods began that were written before detectors were files."""

NETWORK = "network"
"""What a network of somebody's is called as a method in the header of a file."""


@dataclass(frozen=True)
class Trained:
    """What a trained method was learned from."""

    dataset: str = ""
    """Name of the data set."""

    images: int = 0
    """Number of photos."""

    seed: int = 0
    """Seed of what was drawn."""

    seen: tuple[str, ...] = ()
    """Fingerprints of the photos, see `system.fingerprints`."""


def make_method(name: str) -> Configurable:
    """A method by its name; one that learns has learned nothing yet, but for our detector.

    Raises:
        MethodError: There is none of that name.
    """
    if name not in HOMES:
        raise MethodError(f"there is no method {name}; {meant(name, HOMES, 'there are')}")
    if config := DetectorConfig.presets().get(name):
        return Detector(config=config)
    module, _, called = HOMES[name].partition(":")
    kind: Any = getattr(import_module(module), called)
    made: Configurable = kind(**kind.PRESETS[name])
    return made


def save_method(
    method: Method, path: str | os.PathLike[str], trained: Trained | None = None
) -> None:
    """Write a method, with what it has learned, as one ``.npz`` file, whole or not at all.

    Raises:
        MethodError: It keeps what it has learned to itself.
    """
    known = as_method(method)
    header = header_of(known, trained)
    with replacing(path) as temporary, temporary.open("wb") as file:
        headed_npz.write(file, header, known.arrays())


def header_of(method: Configurable, trained: Trained | None = None) -> dict[str, Any]:
    """What the file of a method says of it.

    Raises:
        MethodError: It keeps what it has learned to itself.
    """
    try:
        method.require_told()
    except SettingError as error:
        raise MethodError(str(error)) from error
    if isinstance(method, Detector):
        return method.header()
    trained = trained or Trained(method.learned_from, seen=photos_seen(method))
    told = {**asdict(trained), "seen": packed(trained.seen)}
    return {
        "method": _key(method),
        "label": method.label,
        "settings": {name: _plain(value) for name, value in method.settings().items()},
        "digest": method_digest(method),
        "trained": {name: plain_number(one) for name, one in told.items()},
    }


def _plain(value: object) -> object:
    return str(value.resolve()) if isinstance(value, Path) else value


def _key(method: Configurable) -> str:
    """What detects with the settings, as the header of a file says it."""
    if isinstance(method, PluggedIn):
        return method.place
    if isinstance(method, SkyNetwork):
        return NETWORK
    for kind in type(method).__mro__:
        for name, home in HOMES.items():
            if home == f"{kind.__module__}:{kind.__qualname__}":
                return name
    raise MethodError(f"{method.name} is none of the methods that can be written to a file.")


def load_method(source: str | os.PathLike[str] | bytes) -> Configurable:
    """Read what `save_method` wrote, a detector or a filter bank; nothing is ever unpickled.

    Args:
        source: The file, or its content.

    Raises:
        MethodError: Missing, damaged, another kind of file, or of another version.
    """
    name = "what proposed" if isinstance(source, bytes) else str(source)
    try:
        with opened(source) as file:
            kind, ours = file.header.get("format"), "bank" not in file.header
            if kind == EARLIER_FORMAT or (kind == headed_npz.FORMAT and ours):
                hint = "" if isinstance(source, bytes) else f":model={name}"
                return _loaded(name, file, hint)
    except FileNotFoundError:
        raise MethodError(f"{name} does not exist.") from None
    except NpzError as error:
        raise MethodError(
            f"{name} is damaged, or not a filter bank or a trained method: {error}."
        ) from error
    if kind not in (headed_npz.FORMAT, BANK_FORMAT):
        raise MethodError(f"{name} is neither a trained method nor a filter bank.")
    try:
        return Detector.load(source)
    except FilterBankError as error:
        raise MethodError(str(error).replace("the bank ", f"{name} ", 1)) from error


def _loaded(path: str, file: HeadedNpz, hint: str) -> Configurable:
    """The method in a file whose header is one of ours.

    Raises:
        NpzError: An array is damaged.
        MethodError: Something else is.
    """
    header, earlier = file.header, file.header.get("format") == EARLIER_FORMAT
    version = EARLIER_VERSION if earlier else headed_npz.VERSION
    if header.get("version") != version:
        said = str(header.get("version"))[:20]
        raise MethodError(f"{path} is of version {said}, not {version}.")
    key, settings = header.get("name" if earlier else "method"), header.get("settings")
    label = header.get("label", "")
    if not (isinstance(key, str) and isinstance(settings, dict) and isinstance(label, str)):
        raise MethodError(f"{path} is damaged: its header names no method.")
    try:
        made: Any
        if key == NETWORK:
            made = _network(settings, header.get("digest"), earlier=earlier)
        elif ":" in key:
            made = plugged_from_file(path, key, settings, file, hint)
        else:
            made = _with_model(make_method(key), file).with_settings(settings)
        found: Configurable = replace(
            made, label=label, learned_from=_dataset(header), seen=_seen(header)
        )
        return found
    except (NpzError, MethodError):
        raise
    except ValueError as error:
        raise MethodError(f"{path} is damaged: {error}.") from error


def _dataset(header: Mapping[str, Any]) -> str:
    """Name of the data set that a method was trained on, as the header of its file says."""
    trained = header.get("trained")
    name = trained.get("dataset") if isinstance(trained, dict) else ""
    return name if isinstance(name, str) else ""


def _seen(header: Mapping[str, Any]) -> tuple[str, ...]:
    """Fingerprints of the photos that a method was trained on, as far as its file tells."""
    trained = header.get("trained")
    try:
        return unpacked(trained.get("seen", "")) if isinstance(trained, dict) else ()
    except ValueError:
        return ()


def photos_seen(method: Method) -> tuple[str, ...]:
    """Fingerprints of the photos that a method has learned from, as far as it tells."""
    return method.bank.seen if isinstance(method, Detector) else getattr(method, "seen", ())


def _with_model(made: Configurable, file: HeadedNpz) -> Configurable:
    """A method with what a file says that it has learned; shapes are checked before it is read.

    Raises:
        ValueError: The model is another one.
    """
    if not isinstance(made, LearnedMethod):
        return made
    made.check_announced(file.arrays)
    ready = replace(made, model={part: file.read(part) for part in made.model_shapes()})
    ready.check_model()
    return ready


def _network(settings: Mapping[str, Any], digest: object, *, earlier: bool) -> SkyNetwork:
    """A network from its settings; the file is the user's, and stays where it is.

    Raises:
        ValueError: A setting is absurd.
        MethodError: The file is gone, or holds another network than before.
    """
    network = SkyNetwork(Path()).with_settings(settings)
    if not all(network.std):
        raise SettingError("std is not 0")
    if not network.network.is_file():
        raise MethodError(f"the network {network.network} is gone.")
    if digest != (_earlier_digest(network) if earlier else method_digest(network)):
        raise MethodError(f"the network {network.network} is another one than it was.")
    return network


def _earlier_digest(network: SkyNetwork) -> str:
    """Digest of a network as it was made when methods had a format of their own."""
    digest = hashlib.sha256(b"SkyNetwork")
    digest.update(network.network.read_bytes())
    for name in ("sky_class", "mean", "std", "columns"):
        digest.update(f"{name} {getattr(network, name)}".encode())
    digest.update(b"name network")
    return digest.hexdigest()


def method_digest(method: Method) -> str:
    """Digest of a method's settings and of what it has learned: another one finds other lines."""
    known = as_method(method)
    if isinstance(known, Detector):
        return headed_npz.digest(known.header(), known.arrays())
    about = {
        "method": _key(known),
        "label": known.label,
        "settings": {name: _content(value) for name, value in known.settings().items()},
    }
    if isinstance(known, PluggedIn):
        about["code"] = known.digest_of_code()
    return headed_npz.digest(about, known.arrays())


def _content(value: object) -> object:
    """A setting, of a file what it holds, wherever it lies."""
    if not isinstance(value, Path):
        return value
    if not value.is_file():
        return str(value)
    with value.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def model_bytes(method: Method) -> int:
    """Size of what a method has learned, in bytes, as it lies in memory."""
    return as_method(method).model_bytes()
