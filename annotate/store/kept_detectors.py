"""What proposed a label, as the store keeps it, so that the label can be continued with it."""

from __future__ import annotations

import hashlib
import json
import sqlite3
from dataclasses import asdict, dataclass

from skyline_viz import __version__
from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.filter_bank import FilterBank
from skyline_viz.method import Method
from skyline_viz.methods.registry import Trained, load_method, method_digest, save_method
from skyline_viz.system.aftermath import passing_folder


@dataclass(frozen=True)
class KeptDetector:
    """A detector, or another method, as text and bytes."""

    digest: str
    """SHA-256 of settings and filter bank."""

    about: str
    """What it is, in words."""

    config: str
    """Its settings, as JSON; of another method its name, under ``method``."""

    bank: bytes
    """Its filter bank, as `FilterBank.save` writes it, or the method, as `save_method` does."""


def pack(method: Method) -> KeptDetector:
    """Turn a detector or another method into text and bytes."""
    return _pack_detector(method) if isinstance(method, Detector) else _pack_method(method)


def _pack_method(method: Method) -> KeptDetector:
    with passing_folder() as folder:
        file = folder / "method.npz"
        save_method(method, file, Trained())
        kept = file.read_bytes()
    config = json.dumps({"method": method.name})
    digest = method_digest(method)
    about = f"skyline-viz {__version__}, method {method.name}, {digest[:12]}"
    return KeptDetector(digest, about, config, kept)


def _pack_detector(detector: Detector) -> KeptDetector:
    with passing_folder() as folder:
        file = folder / "bank.npz"
        detector.bank.save(file)
        bank = file.read_bytes()
    config = json.dumps(asdict(detector.config), sort_keys=True)
    digest = hashlib.sha256(config.encode() + bank).hexdigest()
    learned = detector.bank.provenance.dataset or "photos without a name"
    about = f"skyline-viz {__version__}, filters learned from {learned}, {digest[:12]}"
    return KeptDetector(digest, about, config, bank)


def unpack(config: str, bank: bytes) -> Method:
    """Make the detector or the method again.

    >>> same = unpack(*(lambda kept: (kept.config, kept.bank))(pack(Detector())))
    >>> same.config == DetectorConfig()
    True
    """
    with passing_folder() as folder:
        file = folder / "bank.npz"
        file.write_bytes(bank)
        settings = json.loads(config)
        if "method" in settings:
            return load_method(file)
        return Detector(FilterBank.load(file), DetectorConfig(**settings))


def keep_detector(database: sqlite3.Connection, detector: Method) -> int:
    """Id of a detector, which is added where it is new."""
    kept = pack(detector)
    database.execute(
        "INSERT OR IGNORE INTO detectors (digest, about, config, bank) VALUES (?, ?, ?, ?)",
        (kept.digest, kept.about, kept.config, kept.bank),
    )
    row = database.execute("SELECT id FROM detectors WHERE digest = ?", (kept.digest,)).fetchone()
    return int(row[0])
