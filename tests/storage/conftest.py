"""Storages are asked again at once."""

import pytest


@pytest.fixture(autouse=True)
def pauses(monkeypatch):
    """The pauses between tries, which nobody waits for."""
    waited = []
    monkeypatch.setattr("skyline_viz.storage.fetching.pause", waited.append)
    return waited
