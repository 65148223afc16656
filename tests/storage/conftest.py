"""Storages: an S3 on this machine, and one in memory."""

import fsspec
import pytest
import s3fs as library

from testing.programs.s3 import s3 as started_s3


@pytest.fixture
def s3(monkeypatch):
    monkeypatch.setattr(library.S3FileSystem, "retries", 1)  # ours are looked at
    with started_s3(monkeypatch) as moods:
        yield moods


@pytest.fixture
def memory():
    files = fsspec.filesystem("memory")
    yield files
    files.store.clear()
    files.pseudo_dirs[:] = [""]


@pytest.fixture(autouse=True)
def pauses(monkeypatch):
    """The pauses between tries, which nobody waits for."""
    waited = []
    monkeypatch.setattr("skyline_viz.storage.fetching.pause", waited.append)
    return waited
