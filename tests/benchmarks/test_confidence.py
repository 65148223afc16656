"""The table of confidence: how gross misses and errors are told, in all sources and in each."""

from types import SimpleNamespace

import numpy as np

from benchmarks.confidence import Seen, _row


def test_each_source_has_its_area_and_its_rank():
    errors = np.arange(12) / 100
    names = ["uav", "web"] * 6
    found = [Seen(name, "place", one, None) for name, one in zip(names, errors, strict=True)]
    known = [SimpleNamespace(name=name) for name in ("web", "uav", "none")]
    told = np.where(errors == 0.11, 1.0, 1 - errors)
    row = _row("ours", known, found, told)
    assert row[:2] == ["ours", "12, 6"]
    assert row[4:] == ["1.000, 1.00", "-, -"]
    assert row[3] < row[4]
