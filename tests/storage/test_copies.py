"""Data sets of a storage on this machine: whole, up to date, and no larger than the disk."""

import os
from types import SimpleNamespace

import fsspec
import pytest

from skyline_viz.storage import copies
from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.copies import CACHE, copied


@pytest.fixture(autouse=True)
def cache(monkeypatch, tmp_path):
    monkeypatch.setenv(CACHE, str(tmp_path / "cache"))
    return tmp_path / "cache"


def held(folder):
    files = (path for path in folder.rglob("*") if path.is_file() and path.name[0] != ".")
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def test_a_copy_holds_what_is_there_and_is_not_made_twice(s3):
    files = fsspec.filesystem("s3")
    for key in ("a.jpg", "masks/a.png", ".hidden"):
        files.pipe(f"photos/hills/{key}", key.encode())
    folder = copied("s3://photos/hills")
    assert folder.name == "hills"
    assert held(folder) == {"a.jpg": b"a.jpg", "masks/a.png": b"masks/a.png"}
    s3.downloads.clear()
    assert copied("s3://photos/hills") == folder
    assert s3.downloads == []
    files.pipe("photos/hills/a.jpg", b"other")
    files.rm("photos/hills/masks/a.png")
    copied("s3://photos/hills")
    assert held(folder) == {"a.jpg": b"other"}


def test_one_photo_is_a_file(memory):
    memory.pipe("/in/eiger.jpg", b"x")
    file = copied("memory://in/eiger.jpg")
    assert (file.name, file.read_bytes()) == ("eiger.jpg", b"x")


def test_what_does_not_fit_is_not_copied(memory, monkeypatch):
    memory.pipe("/in/a.jpg", b"xxxx")
    monkeypatch.setattr(copies.shutil, "disk_usage", lambda _: SimpleNamespace(free=4))
    with pytest.raises(StorageError, match=r"^memory://in needs .* are free; SKYLINE_VIZ_CACHE"):
        copied("memory://in")


@pytest.mark.parametrize("address", ["memory://gone", "memory://in/gone.jpg"])
def test_what_is_not_there_is_named(memory, address):
    memory.pipe("/in/a.jpg", b"x")
    with pytest.raises(StorageError, match=rf"^{address} does not exist"):
        copied(address)


def test_names_that_lead_out_are_refused(memory, monkeypatch):
    monkeypatch.setattr(copies, "files_at", lambda _: iter([("../a.jpg", None)]))
    with pytest.raises(StorageError, match=r"holds \.\./a\.jpg, which is no name"):
        copied("memory://in")


def test_copies_that_nobody_uses_go(memory, cache):
    memory.pipe("/in/a.jpg", b"x")
    memory.pipe("/on/a.jpg", b"x")
    old = copied("memory://in")
    os.utime(old / ".copied.json", (0, 0))
    new = copied("memory://on")
    assert not old.exists()
    assert held(new) == {"a.jpg": b"x"}
