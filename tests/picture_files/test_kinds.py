"""What kind of picture a file is: by its first bytes, and by its name where they say nothing."""

from pathlib import Path

import pytest

from skyline_viz.picture_files.kinds import (
    PHOTO_SUFFIXES,
    RAW_SUFFIXES,
    RefusedError,
    kind_of,
    unknown,
    why_unread,
)


@pytest.mark.parametrize(
    ("head", "kind"),
    [
        (b"\xff\xd8\xff\xe0", "jpeg"),
        (b"\x89PNG\r\n\x1a\n", "png"),
        (b"II*\0", "tiff"),
        (b"MM\0*", "tiff"),
        (b"II+\0", "tiff"),
        (b"\0\0\0\x18ftypheic\0\0\0\0", "heif"),
        (b"\0\0\0\x18ftypmif1\0\0\0\0avif", "other"),
        (b"BM", "other"),
        (b"", "other"),
    ],
)
def test_the_first_bytes_decide(head, kind):
    for name in ("a.jpg", "a.xyz"):
        assert kind_of(head.ljust(32, b"\0"), Path(name)) == kind


@pytest.mark.parametrize(
    ("head", "name", "reason"),
    [
        (b"II*\0\x10\0\0\0CR\x02\0", "a.tif", "raw file of a camera"),
        (b"FUJIFILMCCD-RAW", "a.jpg", "raw file of a camera"),
        (b"\0\0\0\x18ftypcrx isom", "a.jpg", "raw file of a camera"),
        (b"II*\0", "a.NEF", "raw file of a camera"),
        (b"\xff\x0a", "a.jpg", "JPEG XL"),
    ],
)
def test_what_is_not_read_is_refused_by_name(head, name, reason):
    with pytest.raises(RefusedError, match=reason):
        kind_of(head.ljust(32, b"\0"), Path(name))


def test_a_name_tells_where_the_bytes_do_not():
    assert "develop it" in unknown(Path("a.CR2"))
    assert "(Photoshop)" in unknown(Path("a.psd"))
    assert unknown(Path("a.txt")) == "is not an image in a format that can be read"
    assert not PHOTO_SUFFIXES & RAW_SUFFIXES


def test_why_a_file_is_not_taken(tmp_path):
    for name, content in (
        ("a.png", b""),
        ("b.dng", b""),
        ("c.svg", b""),
        ("picture", b"\x89PNG\r\n\x1a\n"),
        ("words", b"no picture at all"),
        ("d.sqlite", b"\xff\xd8\xff"),
    ):
        (tmp_path / name).write_bytes(content)
    (tmp_path / "e.jpg").symlink_to(tmp_path / "nothing")
    told = {one.name: why_unread(one) for one in tmp_path.iterdir()}
    assert [name for name, reason in told.items() if reason is None] == [
        name for name in told if name in ("a.png", "words", "d.sqlite")
    ]
    assert "raw files" in told["b.dng"]
    assert "SVG" in told["c.svg"]
    assert told["picture"] == "not named as a photo is"
    assert "a link to nothing" in told["e.jpg"]
