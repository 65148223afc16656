"""Detectors as the store keeps them, so that a label can be continued with what proposed it."""

from __future__ import annotations

import hashlib
import json
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

from skyline_viz import __version__
from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.filter_bank import FilterBank


@dataclass(frozen=True)
class KeptDetector:
    """A detector as text and bytes."""

    digest: str
    """SHA-256 of settings and filter bank."""

    about: str
    """What it is, in words."""

    config: str
    """Its settings, as JSON."""

    bank: bytes
    """Its filter bank, as `FilterBank.save` writes it."""


def pack(detector: Detector) -> KeptDetector:
    """Turn a detector into text and bytes."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "bank.npz"
        detector.bank.save(file)
        bank = file.read_bytes()
    config = json.dumps(asdict(detector.config), sort_keys=True)
    digest = hashlib.sha256(config.encode() + bank).hexdigest()
    learned = detector.bank.provenance.dataset or "photos without a name"
    about = f"skyline-viz {__version__}, filters learned from {learned}, {digest[:12]}"
    return KeptDetector(digest, about, config, bank)


def unpack(config: str, bank: bytes) -> Detector:
    """Make the detector again.

    >>> same = unpack(*(lambda kept: (kept.config, kept.bank))(pack(Detector())))
    >>> same.config == DetectorConfig()
    True
    """
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "bank.npz"
        file.write_bytes(bank)
        return Detector(FilterBank.load(file), DetectorConfig(**json.loads(config)))
