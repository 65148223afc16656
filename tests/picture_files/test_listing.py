"""The photo files of a folder, and what looks like one and is not."""

import os

import numpy as np
import pytest

from skyline_viz.photo import find_photos, write_photo
from skyline_viz.picture_files.listing import find_unread


def test_find_photos(tmp_path):
    wanted = ["B.JPG", "a.jpeg", "c.Png", "d.bmp", "e.pgm", "f.tif", "g.TIFF", "h.webp", "i.ppm"]
    others = [".hidden.jpg", "._a.jpeg", ".DS_Store", "Thumbs.db", "a.csv", "readme", "jpg"]
    for name in wanted + others:
        (tmp_path / name).touch()
    (tmp_path / "folder.jpg").mkdir()
    (tmp_path / "dangling.jpg").symlink_to(tmp_path / "nothing.jpg")
    (tmp_path / "link.jpg").symlink_to(tmp_path / "B.JPG")
    assert [file.name for file in find_photos(tmp_path)] == sorted([*wanted, "link.jpg"])


def test_find_photos_in_a_missing_folder(tmp_path):
    with pytest.raises(FileNotFoundError):
        find_photos(tmp_path / "missing")


def test_what_looks_like_a_picture_and_is_not_taken_is_found(tmp_path):
    picture = tmp_path / "a.jpg"
    write_photo(picture, np.zeros((16, 16, 3), np.uint8))
    for name in ("bare", "a.jpg~", "b.jpg.bak"):
        (tmp_path / name).write_bytes(picture.read_bytes())
    (tmp_path / "gone.jpg").symlink_to(tmp_path / "nothing")
    (tmp_path / "words.txt").write_text("no picture")
    (tmp_path / "x.sqlite").write_bytes(picture.read_bytes())
    for name in ("folder", "folder.raw", "folder.psd"):
        (tmp_path / name).mkdir()
    os.mkfifo(tmp_path / "pipe")
    assert [one.name for one in find_unread(tmp_path)] == [
        "a.jpg~",
        "b.jpg.bak",
        "bare",
        "gone.jpg",
    ]
