"""Files that go to an address when they are whole."""

import zipfile

import fsspec
import pytest

from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.copies import CACHE
from skyline_viz.storage.uploads import uploaded
from skyline_viz.system.notes import heard_by


@pytest.fixture(autouse=True)
def cache(monkeypatch, tmp_path):
    monkeypatch.setenv(CACHE, str(tmp_path))


def test_what_is_written_goes_there_and_comes_back_the_next_time(memory):
    with uploaded("memory://out/t.parquet") as file:
        assert not file.exists()
        file.write_bytes(b"one")
    assert memory.cat("/out/t.parquet") == b"one"
    assert not file.exists()
    with uploaded("memory://out/t.parquet") as again:
        assert (again, again.read_bytes()) == (file, b"one")
        again.write_bytes(b"two")
    assert memory.cat("/out/t.parquet") == b"two"


def test_a_block_that_fails_uploads_nothing(memory):
    with pytest.raises(KeyboardInterrupt), uploaded("memory://out/t.parquet") as file:
        file.write_bytes(b"half")
        raise KeyboardInterrupt
    assert not memory.exists("/out/t.parquet")


def test_a_failed_upload_is_tried_again_and_loses_nothing(memory, monkeypatch, pauses):
    def busy(*_):
        raise OSError("slow down")

    with monkeypatch.context() as patch, pytest.raises(StorageError) as caught:
        patch.setattr(type(memory), "put_file", busy)
        with uploaded("memory://out/t.parquet") as file:
            file.write_bytes(b"one")
    said = (
        "memory://out/t.parquet could not be written in 5 tries: slow down; what was found is in "
    )
    assert str(caught.value) == f"{said}{file}."
    assert len(pauses) == 4
    with uploaded("memory://out/t.parquet") as again:
        assert again.read_bytes() == b"one"
    assert memory.cat("/out/t.parquet") == b"one"


ADDRESS = "s3://photos/out/t.parquet"
STAYS = (
    "^s3://photos/out/t.parquet was written by another run in the meantime and stays; what this "
)


@pytest.mark.parametrize("before", [None, b"old"])
def test_what_another_run_wrote_in_the_meantime_stays(s3, before):
    files = fsspec.filesystem("s3")
    if before:
        files.pipe(ADDRESS, before)
    with pytest.raises(StorageError, match=STAYS) as caught, uploaded(ADDRESS) as file:
        files.pipe(ADDRESS, b"its")  # as many bytes as there were
        file.write_bytes(b"own")
    assert str(file) in str(caught.value)
    assert (files.cat(ADDRESS), file.read_bytes()) == (b"its", b"own")


def test_it_stays_the_next_time_as_well_until_one_of_the_two_has_moved(s3):
    files = fsspec.filesystem("s3")
    with pytest.raises(StorageError, match=STAYS), uploaded(ADDRESS) as file:
        files.pipe(ADDRESS, b"its")
        file.write_bytes(b"own")
    with pytest.raises(StorageError, match=STAYS), uploaded(ADDRESS):
        raise AssertionError("nothing is begun")
    files.mv(ADDRESS, ADDRESS + ".theirs")
    with uploaded(ADDRESS) as again:
        assert again.read_bytes() == b"own"
    assert files.cat(ADDRESS) == b"own"


def test_a_run_that_was_stopped_uploads_over_what_it_began_with(s3):
    files = fsspec.filesystem("s3")
    files.pipe(ADDRESS, b"old")
    with pytest.raises(KeyboardInterrupt), uploaded(ADDRESS):
        raise KeyboardInterrupt
    with uploaded(ADDRESS) as file:
        file.write_bytes(b"new")
    assert files.cat(ADDRESS) == b"new"
    assert [*file.parent.iterdir()] == []


def test_where_nothing_may_be_written_it_is_said_at_once(memory, monkeypatch, pauses):
    def forbidden(*_):
        raise PermissionError(1, "no")

    monkeypatch.setattr(type(memory), "put_file", forbidden)
    with (
        pytest.raises(StorageError, match=r"may not be written; what was found is in "),
        uploaded("memory://out/t.parquet") as file,
    ):
        file.write_bytes(b"one")
    assert pauses == []


@pytest.mark.parametrize(
    ("address", "said"),
    [
        ("s3://gone/t.parquet", "there is no such bucket or folder."),
        ("s3://no!name/t.parquet", "there is no such bucket or folder."),
        ("s3://t.parquet", "it names a bucket, and no file in it."),
        ("https://host.invalid/t.parquet", "web servers give files, and take none."),
        ("zip://t.parquet::file://{here}/a.zip", "archives are read alone."),
    ],
)
def test_what_cannot_be_written_is_said_before_anything_is_begun(s3, tmp_path, address, said):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("a", "a")
    address = address.format(here=tmp_path)
    with pytest.raises(StorageError) as caught, uploaded(address):
        raise AssertionError("nothing is begun")
    assert str(caught.value) == f"{address} cannot be written: {said}"


def test_a_trial_leaves_nothing_or_is_named(memory, monkeypatch):
    with heard_by(print), pytest.raises(KeyboardInterrupt), uploaded("memory://out/t.parquet"):
        raise KeyboardInterrupt
    assert memory.find("/") == []

    def forbidden(*_):
        raise PermissionError(1, "no")

    monkeypatch.setattr(type(memory), "rm_file", forbidden)
    said = []
    with heard_by(said.append), uploaded("memory://out/t.parquet") as file:
        file.write_bytes(b"one")
    (trial,) = (one for one in memory.find("/") if one.endswith(".trial"))
    assert said == [f"memory://{trial} was written for a trial, and cannot be removed."]
