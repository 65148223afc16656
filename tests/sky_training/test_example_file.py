"""Examples on the disk: what was put in comes out, and no more is there than fits."""

import errno
import os
from contextlib import closing
from types import SimpleNamespace

import numpy as np
import pytest

from skyline_viz.sky_training import example_file as module
from skyline_viz.sky_training.example_file import RECORD, ExampleFile
from skyline_viz.storage import copies
from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.copies import CACHE
from testing.deep import kept, lineless, sky_examples


@pytest.fixture
def cache(monkeypatch, tmp_path):
    monkeypatch.setenv(CACHE, str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture(params=["in memory", "on the disk"])
def place(request, monkeypatch, cache):
    """Where few examples are kept, whatever the usual limit is."""
    if request.param == "on the disk":
        monkeypatch.setattr(module, "IN_MEMORY", 0)
    return cache


def test_examples_are_read_as_they_were_written(place):
    examples = [*sky_examples(3), lineless("sea")]
    with closing(kept(examples)) as file:
        assert len(file) == 4
        assert file.sources == ["hills"] * 3 + ["sea"]
        assert file.seen == [one.seen for one in examples]
        for number in (2, 0, 3, 1, 2):
            found, wanted = file[number], examples[number]
            np.testing.assert_array_equal(found.photo, wanted.photo)
            np.testing.assert_array_equal(found.sky, wanted.sky)
            np.testing.assert_array_equal(found.line, wanted.line)
            assert (found.source, found.seen) == (wanted.source, wanted.seen)
        assert file[3].line is None
        file.append(examples[0])  # after one was read
        np.testing.assert_array_equal(file[4].photo, examples[0].photo)
        with pytest.raises(IndexError):
            file[5]
    assert not place.exists() or not any(place.iterdir())


def test_few_examples_need_no_folder(cache):
    with closing(kept(sky_examples(2))):
        assert not cache.exists()


@pytest.mark.skipif(os.name != "posix", reason="elsewhere the file has a name while it is open")
def test_the_file_has_no_name_that_a_kill_could_leave(monkeypatch, cache):
    monkeypatch.setattr(module, "IN_MEMORY", 0)
    with closing(kept(sky_examples(1))):
        assert [*cache.iterdir()] == []


def test_what_the_disk_would_not_hold_is_refused_at_once(monkeypatch, cache):
    monkeypatch.setattr(copies.shutil, "disk_usage", lambda _: SimpleNamespace(free=9e8))
    with pytest.raises(StorageError) as refused:
        ExampleFile(10_000)
    assert str(refused.value) == (
        f"a sky model of 10,000 photos needs {10_000 * RECORD / 1e9:.1f} GB in {cache}, "
        "where 0.9 GB are free; SKYLINE_VIZ_CACHE names another folder."
    )


def test_a_disk_that_is_full_all_the_same_is_named(monkeypatch, cache):
    class Full(module.BytesIO):
        def write(self, data):
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(module, "TemporaryFile", lambda **_: Full())
    monkeypatch.setattr(module, "IN_MEMORY", 0)
    with closing(ExampleFile(1)) as file, pytest.raises(OSError, match="No space left") as told:
        file.append(lineless())
    assert told.value.filename == str(cache)
    assert len(file) == 0
