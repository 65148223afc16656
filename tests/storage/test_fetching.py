"""Downloads: what passes is tried again, what lasts is said at once."""

import errno

import fsspec
import pytest

from skyline_viz.storage import fetching
from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.fetching import FIRST_PAUSE, TRIES, fetch

ADDRESS, DATA = "s3://photos/a/x.jpg", b"0123456789"


@pytest.fixture
def stored(s3):
    fsspec.filesystem("s3").pipe(ADDRESS.removeprefix("s3://"), DATA)
    return s3


@pytest.mark.parametrize("size", [len(DATA), None])
def test_a_download_is_one_request(stored, pauses, size):
    stored.questions.clear()
    assert fetch(ADDRESS, size) == DATA
    assert (stored.downloads, stored.questions, pauses) == (["a/x.jpg"], [], [])


def test_a_storage_that_throttles_is_asked_again_after_longer_and_longer_pauses(stored, pauses):
    stored.busy = 3
    assert fetch(ADDRESS, len(DATA)) == DATA
    assert len(stored.downloads) == 4
    for number, waited in enumerate(pauses):
        assert FIRST_PAUSE * 2**number / 2 <= waited <= FIRST_PAUSE * 2**number


def test_a_storage_that_goes_on_throttling_is_given_up_with_a_sentence(stored):
    stored.busy = 1000
    with pytest.raises(StorageError) as raised:
        fetch(ADDRESS, len(DATA))
    said = str(raised.value)
    assert said.startswith(f"{ADDRESS} could not be downloaded in {TRIES} tries: ")
    assert "Reduce your rate" in said
    assert len(stored.downloads) == TRIES


def test_a_download_that_breaks_off_is_begun_again(stored):
    stored.torn = 2
    assert fetch(ADDRESS, len(DATA)) == DATA
    assert len(stored.downloads) == 3


def test_a_download_that_always_breaks_off_is_said_to(stored):
    stored.torn = 1000
    with pytest.raises(StorageError, match=r"it broke off after 5 of 10 bytes\.$"):
        fetch(ADDRESS, len(DATA))


def test_what_is_missing_is_not_asked_for_again(stored, pauses):
    with pytest.raises(StorageError, match=r"^s3://photos/a/gone.jpg does not exist\.$"):
        fetch("s3://photos/a/gone.jpg")
    assert pauses == []


def test_a_file_that_is_too_large_is_not_downloaded(stored, monkeypatch):
    monkeypatch.setattr(fetching, "MOST_BYTES", 5)
    with pytest.raises(StorageError, match=r"has 10 bytes, and the limit is 5\.$"):
        fetch(ADDRESS, len(DATA))
    assert stored.downloads == []


def test_a_full_disk_of_this_machine_is_no_fault_of_the_storage(pauses):
    tries = []

    def full():
        tries.append(1)
        raise OSError(errno.ENOSPC, "No space left on device")

    with pytest.raises(OSError, match="No space left"):
        fetching.persistent(full, ADDRESS, "downloaded")
    assert (len(tries), pauses) == (1, [])
