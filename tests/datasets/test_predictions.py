"""Lines that somebody else has found: which file is for which photo, and what does not fit."""

import numpy as np
import pytest

import skyline_viz as sv
from testing.datasets import (
    HEIGHT,
    MASK,
    PHOTO,
    ROWS,
    SKYLINE,
    WIDTH,
    ch1,
    put,
    row_of,
    web,
    write_labels,
)


def plain(root, *names):
    for name in names:
        put(root / "images" / f"{name}.jpg")
    return sv.open_dataset(root)


def test_each_kind_of_file_gives_the_line(tmp_path):
    items = plain(tmp_path / "set", "a", "b", "c", "d")
    lines = tmp_path / "lines"
    put(lines / "b_mask.png", MASK)
    put(lines / "deep" / "C.png", 255 - MASK)
    SKYLINE.write_csv(lines / "a.csv")
    SKYLINE.write_json(lines / "d.json")
    found = sv.open_predictions(lines, items)
    assert (found.name, set(found.lines), found.extra) == ("lines", {"a", "b", "c", "d"}, ())
    for item in items:
        assert (found.line(item).rows == SKYLINE.rows).all()


def test_files_of_no_photo_and_second_files_are_named(tmp_path):
    items = plain(tmp_path / "set", "a")
    lines = tmp_path / "lines"
    SKYLINE.write_csv(lines / "a.csv")
    put(lines / "a-mask.png", MASK)
    put(lines / "a-overlay.jpg", PHOTO)
    put(lines / "zebra.png", MASK)
    (lines / "other.json").write_text("{}")
    found = sv.open_predictions(lines, items)
    assert found.extra == ("zebra.png",)
    assert found.notes == (
        "not used, because they hold no skyline: other.json.",
        "not used, because another file of the same photo is: a-mask.png.",
    )


def test_names_of_published_layouts_and_of_our_outputs_are_known(tmp_path):
    web(tmp_path / "web")
    lines = tmp_path / "lines"
    SKYLINE.write_csv(lines / "R_GImag0001.csv")
    put(lines / "GT_GoogleImage002_Edge.png", MASK)
    items = sv.open_dataset(tmp_path / "web")
    found = sv.open_predictions(lines, items)
    assert {*found.lines} == {"R_GImag0001", "R_GImag0002"}
    ch1(tmp_path / "ch1")
    items = sv.open_dataset(tmp_path / "ch1")
    for name in ("cvg-IMG_1", "panoramio__IMG_1", "b"):
        SKYLINE.write_csv(tmp_path / "more" / f"{name}.csv")
    found = sv.open_predictions(tmp_path / "more", items)
    assert {*found.lines} == {"cvg/IMG_1", "panoramio/IMG_1", "cvg/b"}


def test_an_export_of_a_data_set_names_the_folders_of_its_photos(tmp_path):
    items = plain(tmp_path / "set", "a", "day/b")
    for name in ("images__a", "set__images__day__b"):
        SKYLINE.write_csv(tmp_path / "lines" / f"{name}.csv")
    found = sv.open_predictions(tmp_path / "lines", items)
    assert (set(found.lines), found.extra) == ({"a", "day/b"}, ())


def test_a_name_that_several_photos_share_is_not_guessed(tmp_path):
    ch1(tmp_path / "ch1")
    items = sv.open_dataset(tmp_path / "ch1")
    SKYLINE.write_csv(tmp_path / "lines" / "IMG_1.csv")
    with pytest.raises(sv.DatasetError, match=r"could be for several photos: IMG_1\.csv\.$"):
        sv.open_predictions(tmp_path / "lines", items)


def test_what_does_not_fit_is_refused(tmp_path):
    items = plain(tmp_path / "set", "a", "b")
    put(tmp_path / "lines" / "a.png", MASK[:, :-1])
    sv.Skyline([3.0] * (WIDTH + 1)).write_csv(tmp_path / "lines" / "b.csv")
    found = sv.open_predictions(tmp_path / "lines", items)
    a, b = items
    with pytest.raises(sv.SkylineError, match=f"{WIDTH - 1}x{HEIGHT} pixels, and the photo"):
        found.line(a)
    with pytest.raises(sv.SkylineError, match=f"{WIDTH + 1} columns, and the photo {WIDTH}"):
        found.line(b)


def test_a_mask_that_leaves_a_choice_is_read_as_asked(tmp_path):
    items = plain(tmp_path / "set", "a")
    classes = np.where(MASK == 0, 9, 3).astype(np.uint8)
    classes[-2:] = 5
    put(tmp_path / "lines" / "a.png", classes)
    (item,) = items
    with pytest.raises(sv.SkylineError, match="say which is sky"):
        sv.open_predictions(tmp_path / "lines", items).line(item)
    found = sv.open_predictions(tmp_path / "lines", items, name="net", sky="9")
    assert (found.line(item).rows == SKYLINE.rows).all()
    assert repr(found) == "Predictions(net, 1 line)"


def test_a_folder_without_a_line_is_refused(tmp_path):
    items = plain(tmp_path / "set", "a")
    with pytest.raises(sv.DatasetError, match="does not exist"):
        sv.open_predictions(tmp_path / "gone", items)
    SKYLINE.write_csv(tmp_path / "lines" / "zebra.csv")
    with pytest.raises(sv.DatasetError, match=r"such as zebra\.csv, are called otherwise"):
        sv.open_predictions(tmp_path / "lines", items)


def test_lines_of_a_table_count(tmp_path):
    items = plain(tmp_path / "set", "a", "b", "c", "d")
    other = sv.Skyline(ROWS + 1)
    rows = [
        row_of("s3://alps/a.jpg", SKYLINE, height=HEIGHT, width=WIDTH),
        row_of("b.png", other, height=HEIGHT + 1, width=WIDTH),
        row_of("c.png", None, height=HEIGHT, width=WIDTH),
        row_of("zebra.png", other, height=HEIGHT, width=WIDTH),
    ]
    for lines in (tmp_path / "lines", tmp_path / "lines.parquet"):
        write_labels(lines / "t.parquet", rows)
        found = sv.open_predictions(lines, items)
        assert {*found.lines} == {"a", "b"}
        assert found.line(items.items[0]) == SKYLINE
        with pytest.raises(sv.SkylineError, match="its line is for 24x17 pixels"):
            found.line(items.items[1])
        file = "lines.parquet" if lines.suffix else "t.parquet"
        assert found.notes == (f"without a line in {file}: c.",)
        assert [one.partition(" in ")[0] for one in found.extra] == ["zebra"]
