"""Google Cloud Storage, as far as its stand-in on this machine goes."""

import logging
import socket

import fsspec
import gcsfs
import pytest

from skyline_viz.storage import addresses
from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.copies import CACHE
from skyline_viz.storage.fetching import TRIES, fetch
from skyline_viz.storage.listing import photos_at
from skyline_viz.storage.uploads import uploaded
from testing.programs.gs import gs as started_gs


@pytest.fixture
def asked(monkeypatch):
    with started_gs(monkeypatch) as asked:
        yield asked


@pytest.fixture
def gs(asked):
    return fsspec.filesystem("gs")


def test_a_download_is_one_request(gs, asked):
    gs.pipe("photos/in/a.jpg", b"whole")
    gs.invalidate_cache()
    asked.clear()
    assert fetch("gs://photos/in/a.jpg") == b"whole"
    assert [method for method, _ in asked] == ["GET"]


def test_photos_are_listed_with_size_and_stamp_and_fetched(gs):
    for key in ("b.jpg", "a/z y.png", "a/note.txt", ".hidden.jpg"):
        gs.pipe(f"photos/in/{key}", key.encode())
    found = list(photos_at("gs://photos/in"))
    assert [one.address for one in found] == ["gs://photos/in/b.jpg", "gs://photos/in/a/z y.png"]
    assert [fetch(one.address, one.size) for one in found] == [b"b.jpg", b"a/z y.png"]
    assert all(one.stamp.startswith("etag ") for one in found)
    gs.pipe("photos/in/b.jpg", b"other")
    gs.invalidate_cache()
    assert next(iter(photos_at("gs://photos/in"))).stamp != found[0].stamp


@pytest.mark.parametrize("address", ["gs://photos/gone.jpg", "gs://gone/a.jpg"])
def test_what_is_missing_is_named_at_once(gs, pauses, address):
    with pytest.raises(StorageError, match=f"^{address} does not exist\\.$"):
        fetch(address)
    with pytest.raises(StorageError, match=r"^gs://photos/none does not exist\.$"):
        list(photos_at("gs://photos/none"))
    assert pauses == []


def test_a_table_goes_there_and_another_run_s_stays(gs, monkeypatch, tmp_path):
    monkeypatch.setenv(CACHE, str(tmp_path))
    with uploaded("gs://photos/out/t.parquet") as file:
        file.write_bytes(b"one")
    with (
        pytest.raises(StorageError, match="was written by another run in the meantime"),
        uploaded("gs://photos/out/t.parquet") as file,
    ):
        assert file.read_bytes() == b"one"
        gs.pipe("photos/out/t.parquet", b"two")
    assert gs.cat("photos/out/t.parquet") == b"two"


@pytest.fixture
def nobody(monkeypatch):
    """A storage that does not answer."""
    with socket.socket() as bound:
        bound.bind(("127.0.0.1", 0))
        monkeypatch.setenv("STORAGE_EMULATOR_HOST", f"http://127.0.0.1:{bound.getsockname()[1]}")
        gcsfs.GCSFileSystem.clear_instance_cache()
        yield
        gcsfs.GCSFileSystem.clear_instance_cache()


def test_without_a_network_the_tries_are_ours_and_nothing_is_logged(
    nobody, pauses, monkeypatch, capfd
):
    tries = []
    plain = gcsfs.GCSFileSystem._get_params
    monkeypatch.setattr(
        gcsfs.GCSFileSystem, "_get_params", lambda *one: tries.append(one) or plain(*one)
    )
    monkeypatch.setattr(addresses, "_GOOGLE_TRIES", 1)
    with pytest.raises(StorageError, match=rf"^gs://photos/a\.jpg could not .* {TRIES} tries: "):
        fetch("gs://photos/a.jpg")
    assert (len(tries), len(pauses)) == (TRIES, TRIES - 1)
    assert addresses._UNHEARD in logging.getLogger("gcsfs").handlers
    assert capfd.readouterr().err == ""
