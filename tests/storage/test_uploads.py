"""Files that go to an address when they are whole."""

import pytest

from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.copies import CACHE
from skyline_viz.storage.uploads import uploaded


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
    said = "memory://out/t.parquet cannot be written: slow down; what was found is in "
    assert str(caught.value) == f"{said}{file}."
    assert pauses == [0.5, 1.0, 2.0, 4.0]
    with uploaded("memory://out/t.parquet") as again:
        assert again.read_bytes() == b"one"
    assert memory.cat("/out/t.parquet") == b"one"
