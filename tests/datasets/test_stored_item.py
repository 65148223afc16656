"""A photo of a storage as an item: one download for its digest and its pixels."""

import pytest

from skyline_viz.datasets.stored_item import StoredItem
from skyline_viz.photo import PhotoError
from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.stored_photo import StoredPhoto
from testing.datasets import NOISE, PHOTO, put


def item_at(where, stamp=""):
    return StoredItem("a", None, stored=StoredPhoto(where, stamp=stamp))


def test_it_is_downloaded_once(tmp_path, memory, monkeypatch):
    memory.pipe_file("/a.png", put(tmp_path / "a.png").read_bytes())
    asked = []
    whole = type(memory).cat_file
    monkeypatch.setattr(
        type(memory), "cat_file", lambda self, path, **more: asked.append(path) or whole(self, path)
    )
    item = item_at("memory://a.png")
    (digest,) = item.contents()
    assert (item.photo() == PHOTO).all()
    assert asked == ["/a.png"]
    memory.pipe_file("/a.png", put(tmp_path / "a.png", NOISE).read_bytes())
    other = item_at("memory://a.png")  # which looks for itself
    assert (other.photo() == NOISE).all()
    assert [*other.contents()] != [digest]
    assert len(asked) == 2


def test_what_the_storage_says_of_its_content_is_enough(memory):
    assert [*item_at("memory://none.png", 'ETag "5"').contents()] == [b'ETag "5"']


def test_what_is_missing_is_said(tmp_path, memory):
    with pytest.raises(StorageError, match=r"memory://none\.png does not exist"):
        item_at("memory://none.png").photo()
    (tmp_path / "empty.png").touch()
    with pytest.raises(PhotoError, match="is empty"):
        item_at(str(tmp_path / "empty.png")).photo()
