"""Photos by path or address: one reading for digest and pixels."""

import hashlib

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.stored_photo import StoredPhoto
from skyline_viz.system.notes import heard_by
from testing.programs.commands import write_scene


@pytest.fixture
def file(tmp_path):
    return write_scene(tmp_path / "a.png")


def test_a_file_and_a_download_give_the_same(file, memory):
    data = file.read_bytes()
    memory.pipe("/in/a.png", data)
    for photo in (StoredPhoto(str(file)), StoredPhoto("memory://in/a.png", len(data))):
        digest, pixels = photo.read()
        assert digest == hashlib.sha256(data).hexdigest()
        np.testing.assert_array_equal(pixels, sv.read_photo(file))
        assert photo.read(digest) == (digest, None)


def test_what_is_wrong_is_said_with_the_address(memory):
    memory.pipe("/in/torn.jpg", b"\xff\xd8\xff\xe0 and no more")
    memory.pipe("/in/empty.jpg", b"")
    with pytest.raises(sv.PhotoError, match=r"^memory://in/torn\.jpg is "):
        StoredPhoto("memory://in/torn.jpg").read()
    with pytest.raises(sv.PhotoError, match=r"^memory://in/empty\.jpg is empty \(0 bytes\)\.$"):
        StoredPhoto("memory://in/empty.jpg").read()
    with pytest.raises(StorageError, match=r"^memory://in/gone\.jpg does not exist\.$"):
        StoredPhoto("memory://in/gone.jpg").read()
    with pytest.raises(sv.PhotoError, match="no such file"):
        StoredPhoto("gone.jpg").read()


def test_what_is_noted_names_the_address(file, memory):
    photo = sv.read_photo(file)
    sv.write_photo(file.with_suffix(".jpg"), photo)
    memory.pipe("/in/a.jpg", file.with_suffix(".jpg").read_bytes()[:-2])
    heard = []
    with heard_by(heard.append):
        StoredPhoto("memory://in/a.jpg").read()
    assert heard == [
        "memory://in/a.jpg ends without its end marker, but all of its pixels are there."
    ]
