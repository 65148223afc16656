"""What tests of methods share: configurations, files of earlier versions, methods of one's own."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import strategies as st

from skyline_viz.config import DetectorConfig
from skyline_viz.filter_bank import FilterBank
from skyline_viz.methods.finding import plugins

configurations = st.builds(
    DetectorConfig,
    edge_source=st.sampled_from(["grey", "colour"]),
    low_threshold=st.floats(0, 100),
    high_threshold=st.floats(100, 1e5),
    fit_thresholds=st.booleans(),
    frame=st.integers(0, 10_000),
    v=st.floats(0, 1),
    strength_percentile=st.floats(1, 100),
    non_edge_cost=st.floats(0, 1e6),
    clear_sky=st.floats(0, 1e3),
    sky_weight=st.floats(0, 1e3),
    sky_cap=st.floats(0, 1e6),
    sky_edges=st.floats(0, 1),
    delta=st.integers(0, 100_000),
    link_weight=st.floats(0, 1e6),
)
"""Within the range of each setting."""


def write_bank(bank: FilterBank, path: Path) -> Path:
    """A filter bank as an earlier version wrote it: of its settings it knew what Canny saw."""
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
    """A method as an earlier version wrote it, called after what it does."""
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


@contextmanager
def own_folder(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A current folder, whose modules and classes are forgotten afterwards."""
    monkeypatch.chdir(folder)
    monkeypatch.setenv("CI", "1")
    monkeypatch.setattr(sys, "path", [*sys.path])
    monkeypatch.setattr(plugins, "_named", set())
    before = set(sys.modules)
    yield folder
    for name in set(sys.modules) - before:
        if str(folder) in str(getattr(sys.modules[name], "__file__", "")):
            del sys.modules[name]


def write_module(folder: Path, code: str, name: str = "mine") -> str:
    """Write a module, and say where its class ``Mine`` is."""
    (folder / f"{name}.py").write_text(code)
    return f"{name}:Mine"
