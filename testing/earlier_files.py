"""Files as earlier versions wrote them: banks and methods had a header each."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from skyline_viz.filter_bank import FilterBank


def write_bank(bank: FilterBank, path: Path) -> Path:
    """A filter bank, which knew of the settings it was trained for only what Canny saw."""
    provenance = asdict(bank.provenance)
    del provenance["detector"]
    header = {
        "format": "skyline-viz filter bank",
        "version": 1,
        "bins": asdict(bank.bins),
        "provenance": provenance,
    }
    return _write(path, header, bank.arrays())


def write_method(
    path: Path,
    name: str,
    settings: Mapping[str, Any],
    model: Mapping[str, Any] | None = None,
    digest: str = "",
) -> Path:
    """A method, which was called after what it does."""
    header = {
        "format": "skyline-method",
        "version": 1,
        "name": name,
        "settings": dict(settings),
        "digest": digest,
        "trained": {"dataset": "hills", "images": 4, "seed": 0},
    }
    return _write(path, header, model or {})


def _write(path: Path, header: Mapping[str, Any], arrays: Mapping[str, Any]) -> Path:
    said = np.frombuffer(json.dumps(header, default=str).encode(), np.uint8)
    np.savez_compressed(path, header=said, **arrays)
    return path
