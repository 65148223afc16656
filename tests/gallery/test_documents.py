"""The JSON files of a gallery."""

import json

import pytest

from skyline_viz.gallery.documents import GalleryError, made, read_list, write_list
from skyline_viz.gallery.flags import Flag


def test_what_is_written_is_read_again(tmp_path):
    file = tmp_path / "new" / "list.json"
    assert read_list(file, "things", 2) == []
    write_list(file, "things", [{"name": "Zürich"}], 2)
    assert read_list(file, "things", 2) == [{"name": "Zürich"}]
    assert "Zürich" in file.read_text(encoding="utf-8")
    assert read_list(file, "things", 3) == []  # of an earlier version


@pytest.mark.parametrize(
    "content",
    [
        "",
        "[]",
        "null",
        "{}",
        '{"version": 9, "things": []}',
        '{"version": 2, "things": [1]}',
        "\ud800",
    ],
)
def test_a_damaged_file_is_one_sentence(tmp_path, content):
    file = tmp_path / "list.json"
    file.write_bytes(content.encode("utf-8", "surrogatepass"))
    with pytest.raises(GalleryError, match=r"list\.json is damaged or of another version; move"):
        read_list(file, "things", 2)


def test_unknown_fields_are_damage(tmp_path):
    assert made(Flag, tmp_path, {"reviewed": True}) == Flag(True)
    with pytest.raises(GalleryError, match="damaged"):
        made(Flag, tmp_path, {"colour": "red"})


def test_a_file_that_cannot_be_written_stays_as_it_was(tmp_path, monkeypatch):
    file = tmp_path / "list.json"
    write_list(file, "things", [], 1)
    with pytest.raises(TypeError):
        write_list(file, "things", [{"name": object()}], 1)
    assert json.loads(file.read_text()) == {"version": 1, "things": []}
    assert [one.name for one in tmp_path.iterdir()] == ["list.json"]
