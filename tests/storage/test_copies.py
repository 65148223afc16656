"""Data sets of a storage on this machine: whole, up to date, and no larger than the disk."""

import os
from concurrent.futures import ThreadPoolExecutor
from threading import Event
from types import SimpleNamespace

import boto3
import fsspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.storage import copies
from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.copies import CACHE, copied, lost_in
from skyline_viz.storage.fetching import OutageError
from skyline_viz.storage.listing import Listed


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


@pytest.mark.parametrize("name", ["in/lines.csv", "in/lines.txt", "in/lines"])
def test_one_file_of_another_kind_is_a_file_too(memory, name):
    memory.pipe(f"/{name}", b"x")
    file = copied(f"memory://{name}")
    assert (f"in/{file.name}", file.read_bytes()) == (name, b"x")


def test_one_file_of_a_bucket_is_told_from_a_folder_with_a_mark(s3):
    files = fsspec.filesystem("s3")
    files.pipe("photos/lines.csv", b"x")
    files.pipe("photos/hills/", b"")
    files.pipe("photos/hills/a.jpg", b"x")
    files.pipe("photos/empty/", b"")
    assert copied("s3://photos/lines.csv").read_bytes() == b"x"
    assert held(copied("s3://photos/hills")) == {"a.jpg": b"x"}
    with pytest.raises(StorageError, match=r"^s3://photos/empty holds no file\.$"):
        copied("s3://photos/empty")


def test_a_file_that_cannot_be_had_does_not_cost_the_others(s3):
    files = fsspec.filesystem("s3")
    for key in ("a.jpg", "b.jpg", "masks/a.csv"):
        files.pipe(f"photos/hills/{key}", key.encode())
    s3.forbidden = {"hills/a.jpg"}
    folder = copied("s3://photos/hills")
    assert held(folder) == {"a.jpg": b"", "b.jpg": b"b.jpg", "masks/a.csv": b"masks/a.csv"}
    reason = "s3://photos/hills/a.jpg may not be downloaded."
    assert lost_in(folder) == {folder / "a.jpg": reason}
    s3.forbidden = {"hills/masks/a.csv"}
    s3.downloads.clear()
    copied("s3://photos/hills")
    assert s3.downloads == ["hills/a.jpg"]
    assert lost_in(folder) == {}
    assert held(folder)["a.jpg"] == b"a.jpg"


def test_where_most_is_lost_the_copy_is_refused(s3):
    files = fsspec.filesystem("s3")
    for number in range(5):
        files.pipe(f"photos/hills/{number}.jpg", b"x")
    s3.forbidden = {f"hills/{number}.jpg" for number in range(3)}
    with pytest.raises(StorageError, match=r"cannot be copied: 3 of its 5 files could not be had"):
        copied("s3://photos/hills")
    s3.forbidden = set(list(s3.forbidden)[:2])
    assert len(lost_in(copied("s3://photos/hills"))) == 2


def test_an_outage_half_way_is_refused_and_the_next_copy_goes_on(memory, monkeypatch):
    names = [f"{number:02}.jpg" for number in range(60)]
    for name in names:
        memory.pipe(f"/in/{name}", b"x")
    monkeypatch.setattr(copies, "_THREADS", 1)
    fetch = copies.fetch

    def broken(address, size):
        if int(address[-6:-4]) >= 40:
            raise OutageError(f"{address} could not be downloaded in 5 tries: too late.")
        return fetch(address, size)

    monkeypatch.setattr(copies, "fetch", broken)
    with pytest.raises(StorageError, match=r"16 of its 60 files .* in 5 tries: too late\.$"):
        copied("memory://in")
    monkeypatch.setattr(copies, "fetch", fetch)
    assert len(held(copied("memory://in"))) == 60


def test_a_bar_counts_what_is_downloaded(memory):
    shown = []

    class Bar:
        def __init__(self, total, title):
            shown.append((total, title))

        def __enter__(self):
            return self

        def __exit__(self, *_):
            shown.append("end")

        def advance(self, what=""):
            shown.append(what)

    memory.pipe("/in/a.jpg", b"x" * 2_000_000)
    memory.pipe("/in/b.jpg", b"x" * 1_000_000)
    copied("memory://in", Bar)
    assert shown[0] == (2, "copying 3 MB")
    assert sorted(shown[1:-1]) == ["a.jpg", "b.jpg"]
    assert shown[-1] == "end"


def test_ctrl_c_leaves_downloads_that_have_not_begun(memory, monkeypatch):
    for number in range(40):
        memory.pipe(f"/in/{number}.jpg", b"x")
    monkeypatch.setattr(copies, "_THREADS", 1)
    fetch, fetched = copies.fetch, []
    interrupted = Event()

    def slow(address, size):
        if fetched:
            assert interrupted.wait(60)
        fetched.append(address)
        return fetch(address, size)

    class Threads(ThreadPoolExecutor):
        def shutdown(self, wait=True, *, cancel_futures=False):
            super().shutdown(wait=False, cancel_futures=cancel_futures)
            interrupted.set()
            super().shutdown()

    class Bar(copies._Silent):
        def advance(self, what=""):
            raise KeyboardInterrupt

    monkeypatch.setattr(copies, "ThreadPoolExecutor", Threads)
    monkeypatch.setattr(copies, "fetch", slow)
    with pytest.raises(KeyboardInterrupt):
        copied("memory://in", Bar)
    assert len(fetched) <= 2


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


ODD = {
    "::x.jpg": "%3A%3Ax.jpg",
    "d//dbl.jpg": "d/%2F/dbl.jpg",
    "dots/../up.jpg": "dots/%2E%2E/up.jpg",
    "a:b.jpg": "a%3Ab.jpg",
    "c\\d.jpg": "c%5Cd.jpg",
    "both": "%both",
}


def test_a_file_without_a_name_here_is_lost_alone(s3, tmp_path):
    client = boto3.client("s3")
    good = [f"{number}.jpg" for number in range(6)] + ["both/a.jpg"]
    for key in (*ODD, *good):
        client.put_object(Bucket="photos", Key=f"hills/{key}", Body=b"x")
    folder = copied("s3://photos/hills")
    assert set(held(folder)) == {*good, *ODD.values()}
    no_name, no_address = "has a name that no file can have here.", "cannot be downloaded: a name"
    for key, here in ODD.items():
        reason = lost_in(folder)[folder / here]
        assert reason.startswith(
            f"s3://photos/hills/{key} {no_address if '::' in key else no_name}"
        )
    assert not (tmp_path / "up.jpg").exists()


@given(st.lists(st.text("a./:\\%é", min_size=1, max_size=300), min_size=1, max_size=6, unique=True))
def test_names_here_lie_within_and_none_is_dropped(names):
    found = copies._by_names_here({own: Listed(f"s3://b/{own}") for own in names})
    assert sorted(one.address for one in found.values()) == sorted(f"s3://b/{one}" for one in names)
    for here, one in found.items():
        parts = here.split("/")
        assert not {"", ".", ".."} & {*parts}
        assert all(len(part.encode()) < 256 for part in parts)
        assert one.fault or one.address == f"s3://b/{here}"


def test_copies_that_nobody_uses_go(memory, cache):
    memory.pipe("/in/a.jpg", b"x")
    memory.pipe("/on/a.jpg", b"x")
    old = copied("memory://in")
    os.utime(old / ".copied.json", (0, 0))
    new = copied("memory://on")
    assert not old.exists()
    assert held(new) == {"a.jpg": b"x"}
