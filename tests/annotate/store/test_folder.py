"""The photos of a folder, and of the folders in it."""

from annotate.store.folder import photos_below, unread_below
from testing.exports import put


def test_photos_are_found_below_without_truths_and_hidden_ones(tmp_path):
    for name in (
        "b.png",
        "a/c.png",
        ".hidden/d.png",
        "masks/b.png",
        "a/c_mask.png",
        "z/masks/e.png",
    ):
        put(tmp_path, name)
    (tmp_path / "words.txt").touch()
    found = [path.relative_to(tmp_path).as_posix() for path in photos_below(tmp_path)]
    assert found == ["b.png", "a/c.png", "z/masks/e.png"]  # z has no photos of its own


def test_pictures_that_cannot_be_read_are_one_sentence(tmp_path):
    assert unread_below(tmp_path) is None
    for name in ("a.nef", "x/b.jxl", ".git/c.psd"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    said = unread_below(tmp_path)
    assert said.startswith("2 files are no photos that can be read: a.nef (raw files of cameras")
    assert "x/b.jxl (JPEG XL)" in said
