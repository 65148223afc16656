"""What proposed a label, as the store keeps it, so that the label can be continued with it."""

from __future__ import annotations

import json
import sqlite3
from dataclasses import dataclass

from skyline_viz import __version__
from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.method import Method
from skyline_viz.methods.finding.method_files import header_of
from skyline_viz.methods.finding.plugins import as_method
from skyline_viz.methods.registry import load_method, method_digest
from skyline_viz.system import headed_npz


@dataclass(frozen=True)
class KeptDetector:
    """A detector, or another method, as text and bytes."""

    digest: str
    """SHA-256 of its settings and of what it has learned."""

    about: str
    """What it is, in words."""

    config: str
    """Its name under ``method``, as JSON; earlier versions kept settings of our detector."""

    bank: bytes
    """The content of its file, see `Detector.save` and `save_method`."""


def pack(method: Method) -> KeptDetector:
    """Turn a detector or another method into text and bytes."""
    known = as_method(method)
    digest = method_digest(known)
    what = f"method {known.name}"
    if isinstance(known, Detector):
        learned = known.bank.provenance.dataset or "photos without a name"
        what = f"{known.name}, filters learned from {learned}"
    return KeptDetector(
        digest,
        f"skyline-viz {__version__}, {what}, {digest[:12]}",
        json.dumps({"method": known.name}),
        headed_npz.packed(header_of(known), known.arrays()),
    )


def unpack(config: str, bank: bytes) -> Method:
    """Make the detector or the method again.

    >>> same = unpack(*(lambda kept: (kept.config, kept.bank))(pack(Detector())))
    >>> same.config == DetectorConfig()
    True
    """
    settings = json.loads(config)
    if "method" in settings:
        return load_method(bank)
    before_sky_models = {"sky_weight": 0.0, **settings}
    config_of_then = DetectorConfig.from_file(before_sky_models, "a kept detector")
    return Detector(Detector.load(bank).bank, config_of_then)


def keep_detector(database: sqlite3.Connection, detector: Method) -> int:
    """Id of a detector, which is added where it is new."""
    kept = pack(detector)
    database.execute(
        "INSERT OR IGNORE INTO detectors (digest, about, config, bank) VALUES (?, ?, ?, ?)",
        (kept.digest, kept.about, kept.config, kept.bank),
    )
    row = database.execute("SELECT id FROM detectors WHERE digest = ?", (kept.digest,)).fetchone()
    return int(row[0])
