"""Lines that cannot all be the skyline of one photo."""

import numpy as np
import pytest

from skyline_viz.photo import write_photo
from skyline_viz.skyline import Skyline
from testing import label_files as made
from testing.imports import imported, level, said_about
from testing.label_files import NAME, WIDTH, labelme, shape


@pytest.mark.parametrize("apart", [0, 2, 3, 60])
@pytest.mark.parametrize("kind", ["two files", "one file", "cvat"])
def test_two_lines_of_a_photo_agree_or_none_is_imported(tmp_path, photos, kind, apart):
    write_photo(photos / "b.png", made.photo())
    other = level(30 + apart, 40)
    if kind == "two files":
        made.written(tmp_path / "in" / "anna" / "p.json", labelme(shape(level(30))))
        made.written(tmp_path / "in" / "ben" / "p.json", labelme(shape(other)))
        made.written(tmp_path / "in" / "b.json", labelme(shape(level(9)), name="b.png"))
    elif kind == "one file":
        made.written(tmp_path / "in" / "a.json", labelme(shape(level(30)), shape(other)))
        made.written(tmp_path / "in" / "b.json", labelme(shape(level(9)), name="b.png"))
    else:
        lines = [
            f'<polyline label="skyline" points="{made.cvat_points(one)}"/>'
            for one in (level(30), other)
        ]
        document = made.cvat("".join(lines))
        start, end = document.index("<image"), document.index("</image>") + len("</image>")
        good = made.cvat(lines[0], name="b.png")
        good = good[good.index("<image") : good.index("</image>") + len("</image>")]
        document = document[:start] + good + document[start:end] + document[end:]
        made.written(tmp_path / "in" / "a.xml", document)
    found = imported(tmp_path / "in", photos, (NAME, "b.png"))
    if apart > 2:
        assert [one.name for one in found] == ["b.png"]
        assert found.problems == (
            f"{NAME} has two lines that differ by up to {apart} px in columns 40 to {WIDTH - 1}; "
            f"none is imported.",
        )
    else:
        assert sorted(one.name for one in found) == ["b.png", NAME]
        assert found.problems == ()


def test_lines_that_meet_at_a_cliff_are_one(tmp_path, photos):
    document = labelme(shape(level(30, 0, 80.7)), shape(level(70, 80.2, WIDTH)))
    (found,) = imported(made.written(tmp_path / "a.json", document), photos)
    np.testing.assert_array_equal(found.skyline.rows, [30] * 81 + [70] * (WIDTH - 81))


@pytest.mark.parametrize("apart", [0, 40])
def test_two_tables_of_a_photo_agree_or_none_is_imported(tmp_path, photos, apart):
    for folder, row in (("anna", 30), ("ben", 30 + apart)):
        Skyline(np.full(WIDTH, row)).write_csv(tmp_path / "in" / folder / "ridge.csv")
    if apart:
        said = said_about(tmp_path / "in", photos)
        assert said == (
            f"{NAME} has two files that differ by up to 40 px in columns 0 to {WIDTH - 1}; "
            f"none is imported."
        )
    else:
        found = imported(tmp_path / "in", photos)
        assert len(found) == 1
        assert "another file for the same photo" in found.notes[0]
