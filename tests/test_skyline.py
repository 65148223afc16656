"""Skyline: what it refuses, and round trips through every form in which it is stored."""

import json
import pickle

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from skyline_viz.photo import read_photo, write_photo
from skyline_viz.skyline import Skyline, SkylineError, fill

HEIGHT = 20
FINITE = st.floats(width=32, allow_nan=False, allow_infinity=False)


@st.composite
def skylines(draw, rows=FINITE, some_visible=False):
    width = draw(st.integers(1, 10))
    visible = draw(st.lists(st.booleans(), min_size=width, max_size=width))
    if some_visible:
        visible[draw(st.integers(0, width - 1))] = True
    return Skyline(draw(st.lists(rows, min_size=width, max_size=width)), np.array(visible))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("skylines")


# Construction


def test_visible_everywhere_unless_said():
    skyline = Skyline(rows=[1, 2.5])
    assert skyline.rows.dtype == np.float32
    assert skyline.visible.dtype == np.bool_
    assert skyline.visible.tolist() == [True, True]
    assert skyline.width == 2


def test_nothing_can_be_changed_afterwards():
    rows, visible = np.array([1, 2], np.float32), np.array([True, False])
    skyline = Skyline(rows, visible)
    rows[0], visible[0] = 9, False
    assert skyline.rows[0] == 1
    assert skyline.visible[0]
    with pytest.raises(ValueError, match="read-only"):
        skyline.rows[0] = 3
    with pytest.raises(ValueError, match="read-only"):
        skyline.visible[0] = False
    with pytest.raises(AttributeError):
        skyline.rows = rows


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([], "shape"),
        (3.0, "shape"),
        ([[1, 2]], "shape"),
        (None, "shape"),
        ([1, float("nan")], "row of column 1 is nan"),
        ([float("inf"), 1], "row of column 0 is inf"),
        ([1e300], "row of column 0 is inf"),
        (np.array([1e300]), "row of column 0 is inf"),
        ([10**400], "numbers"),
        (["high"], "numbers"),
        ([[1], [2, 3]], "numbers"),
        ([{}], "numbers"),
    ],
)
def test_rows_that_are_refused(rows, message):
    with pytest.raises(SkylineError, match=message):
        Skyline(rows=rows)


@pytest.mark.parametrize(
    ("visible", "message"),
    [
        ([True], "2 rows, but visible has the shape"),
        (np.ones((2, 1), bool), "2 rows, but visible has the shape"),
        ([1, 0], "visible is a bool array, not int64"),
        ([0.5, 1], "visible is a bool array"),
        (["True", "False"], "visible is a bool array"),
        ([[True], [True, False]], "numbers|bool"),
    ],
)
def test_visibility_that_is_refused(visible, message):
    with pytest.raises(SkylineError, match=message):
        Skyline(rows=[1, 2], visible=visible)


def test_equality():
    one = Skyline([1, 2], np.array([True, False]))
    assert one == Skyline([1, 2], np.array([True, False]))
    assert one != Skyline([1, 2])
    assert one != Skyline([1, 3], np.array([True, False]))
    assert one != Skyline([1])
    assert one != "skyline"
    with pytest.raises(TypeError):
        hash(one)


def test_pickling():
    skyline = Skyline([1, 2.25], np.array([True, False]))
    assert pickle.loads(pickle.dumps(skyline)) == skyline


# Masks


@given(skylines(rows=st.integers(0, HEIGHT)))
def test_mask_round_trip(skyline):
    mask = skyline.to_mask(HEIGHT)
    assert mask.shape == (HEIGHT, skyline.width)
    assert mask.dtype == np.bool_
    assert np.array_equal(mask.sum(axis=0), skyline.rows)
    assert Skyline.from_mask(mask) == Skyline(skyline.rows)


@given(st.integers(1, 9), st.integers(1, 9), st.data())
def test_the_first_terrain_pixel_counts(height, width, data):
    bits = data.draw(st.lists(st.booleans(), min_size=height * width, max_size=height * width))
    mask = np.array(bits).reshape(height, width)
    for column, row in enumerate(Skyline.from_mask(mask).rows.astype(int)):
        assert mask[:row, column].all()
        assert row == height or not mask[row, column]


@pytest.mark.parametrize(
    "mask",
    [np.ones((2, 2)), np.ones((2, 2), np.uint8), np.ones(3, bool), np.ones((0, 3), bool)],
)
def test_what_is_no_mask_is_refused(mask):
    with pytest.raises(SkylineError, match="sky mask"):
        Skyline.from_mask(mask)


def test_fractions_are_rounded_half_down_the_image():
    assert Skyline([1.49, 1.5, 2.5, -0.5]).pixel_rows(5).tolist() == [1, 2, 3, 0]


@pytest.mark.parametrize("row", [-0.51, -1, 5.5, 6, 1e30, -1e30])
def test_a_visible_row_outside_is_refused(row):
    skyline = Skyline([1, row])
    with pytest.raises(SkylineError, match="of column 1 lies outside a height of 5"):
        skyline.pixel_rows(5)
    with pytest.raises(SkylineError, match="of column 1 lies outside a height of 5"):
        skyline.to_mask(5)


def test_an_invisible_row_outside_moves_inside():
    skyline = Skyline([-1e30, 2, 1e30], np.array([False, True, False]))
    assert skyline.pixel_rows(5).tolist() == [0, 2, 5]


# Painted photos


@st.composite
def painting(draw):
    """A skyline that can be painted, and a photo in which both paints occur already."""
    skyline = draw(skylines(rows=st.integers(0, HEIGHT - 1), some_visible=True))
    width = max(2, skyline.width)
    skyline = Skyline(np.resize(skyline.rows, width), np.resize(skyline.visible, width))
    palette = [(255, 0, 0), (0, 0, 255), (254, 0, 0), (0, 0, 254), (9, 9, 9), (255, 255, 255)]
    seed = draw(st.integers(0, 2**32 - 1))
    photo = np.array(palette, np.uint8)[
        np.random.default_rng(seed).integers(0, len(palette), (HEIGHT, width))
    ]
    return skyline, photo


@pytest.mark.parametrize("paint", ["red", "blue"])
@given(case=painting())
def test_painted_round_trip(paint, case):
    skyline, photo = case
    before = photo.copy()
    painted = skyline.to_painted(photo, paint)
    assert np.array_equal(photo, before)
    off_line = np.ones(photo.shape[:2], bool)
    columns = np.flatnonzero(skyline.visible)
    off_line[skyline.rows[columns].astype(int), columns] = False
    change = np.abs(painted.astype(int) - photo)[off_line]
    assert change.max(initial=0) <= 1
    for found in (Skyline.from_painted(painted), Skyline.from_painted(painted, paint)):
        assert np.array_equal(found.visible, skyline.visible)
        assert np.array_equal(found.rows[columns], skyline.rows[columns])
        assert np.array_equal(found.rows, fill(skyline.rows, skyline.visible))


@pytest.mark.parametrize("paint", ["red", "blue"])
def test_painted_photos_survive_a_file(tmp_path, paint):
    skyline = Skyline(np.arange(12) % 7 + 1, np.arange(12) % 5 != 0)
    photo = np.full((12, 12, 3), 130, np.uint8)
    write_photo(tmp_path / "a.bmp", skyline.to_painted(photo, paint))
    found = Skyline.from_painted(read_photo(tmp_path / "a.bmp"))
    assert np.array_equal(found.visible, skyline.visible)
    assert np.array_equal(found.rows[found.visible], skyline.rows[skyline.visible])


def test_the_topmost_painted_pixel_counts():
    painted = np.zeros((6, 3, 3), np.uint8)
    painted[[4, 2, 5], [0, 0, 2]] = (255, 0, 0)
    found = Skyline.from_painted(painted)
    assert found.rows.tolist() == [2, 3.5, 5]
    assert found.visible.tolist() == [True, False, True]


def test_the_paint_in_more_columns_counts():
    painted = np.zeros((6, 4, 3), np.uint8)
    painted[:3, 0] = (255, 0, 0)
    painted[4, 1:3] = (0, 0, 255)
    assert Skyline.from_painted(painted).visible.tolist() == [False, True, True, False]
    assert Skyline.from_painted(painted, "red").visible.tolist() == [True, False, False, False]


@pytest.mark.parametrize("paint", [None, "red", "blue"])
def test_an_unpainted_photo_is_refused(paint):
    almost = np.full((4, 4, 3), (254, 0, 0), np.uint8)
    with pytest.raises(SkylineError, match="painted"):
        Skyline.from_painted(almost, paint)


@pytest.mark.parametrize("array", [np.zeros((4, 4), np.uint8), np.zeros((4, 4, 4), np.uint8)])
def test_only_photos_are_painted_on(array):
    with pytest.raises(ValueError, match=r"\(H, W, 3\)"):
        Skyline([1, 1, 1, 1]).to_painted(array)
    with pytest.raises(ValueError, match=r"\(H, W, 3\)"):
        Skyline.from_painted(array)


def test_a_photo_of_another_width_is_refused():
    with pytest.raises(SkylineError, match="photo is 5 columns wide, the skyline 3"):
        Skyline([1, 1, 1]).to_painted(np.zeros((4, 5, 3), np.uint8))


def test_all_sky_cannot_be_painted():
    photo = np.zeros((4, 2, 3), np.uint8)
    with pytest.raises(SkylineError, match="column 1 is all sky"):
        Skyline([1, 4]).to_painted(photo)
    hidden = Skyline([1, 4], np.array([True, False]))
    assert Skyline.from_painted(hidden.to_painted(photo)).visible.tolist() == [True, False]


# CSV
@given(skyline=skylines())
def test_csv_round_trip(folder, skyline):
    skyline.write_csv(folder / "a.csv")
    assert Skyline.read_csv(folder / "a.csv") == skyline


@example(skyline=Skyline([0.0, -0.0, 2.0**24, 2.0**24 - 1, -7, 1e20, 1.5, 3e-42]))
@given(skyline=skylines())
def test_csv_holds_the_shortest_digits_without_an_exponent(folder, skyline):
    skyline.write_csv(folder / "digits.csv")
    lines = [line.split(",") for line in (folder / "digits.csv").read_text().splitlines()[1:]]
    told = [np.format_float_positional(row, trim="-") for row in skyline.rows]
    assert [row for _, row, _ in lines] == told
    assert [column for column, _, _ in lines] == [str(one) for one in range(skyline.width)]
    assert [one == "1" for _, _, one in lines] == skyline.visible.tolist()


@given(arrays(np.bool_, st.tuples(st.integers(1, 8), st.integers(1, 5))))
def test_the_skyline_of_a_mask_is_its_first_terrain(mask):
    rows = [next((row for row, sky in enumerate(one) if not sky), len(mask)) for one in mask.T]
    assert Skyline.from_mask(mask).rows.tolist() == rows


def test_csv_is_what_the_docs_say(tmp_path):
    Skyline([3, 2.25], np.array([True, False])).write_csv(tmp_path / "a.csv")
    assert (tmp_path / "a.csv").read_bytes() == b"column,row,visible\n0,3,1\n1,2.25,0\n"


@pytest.mark.parametrize(
    "content",
    [
        b"column,row,visible\r\n0,3,1\r\n1,2.5,0\r\n",
        b"\xef\xbb\xbfcolumn,row,visible\r\n0,3,1\r\n1,2.5,0\r\n",
        b"column,row,visible\n0,3,1\n1,2.5,0",
        b"column,row,visible\n0,3.0,1\n1,2.50,0\n\n\n",
        b'"column","row","visible"\r\n"0","3","1"\r\n"1","2.5","0"\r\n',
    ],
)
def test_csv_from_other_programs(tmp_path, content):
    (tmp_path / "a.csv").write_bytes(content)
    assert Skyline.read_csv(tmp_path / "a.csv") == Skyline([3, 2.5], np.array([True, False]))


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"column,row\n0,3\n",
        b"0,3,1\n",
        b"column,row,visible\n",
        b"column,row,visible\n0,3\n",
        b"column,row,visible\n0,3,1,9\n",
        b"column,row,visible,margin\n0,3,1\n",
        b"column,row,visible\n0,high,1\n",
        b"column,row,visible\n0,nan,1\n",
        b"column,row,visible\n0,inf,1\n",
        b"column,row,visible\n0,1e300,1\n",
        b"column,row,visible\n0,,1\n",
        b"column,row,visible\n1,3,1\n",
        b"column,row,visible\n0,3,1\n2,3,1\n",
        b"column,row,visible\n0,3,2\n",
        b"column,row,visible\n0,3,True\n",
        b"\xff\xfe\0c\0o",
        b"column,row,visible\n0,\0,1\n",
        b"column,row,visible\n0," + b"1" * 200_000 + b",1\n",
    ],
)
def test_csv_that_is_refused(tmp_path, content):
    (tmp_path / "a.csv").write_bytes(content)
    with pytest.raises(SkylineError, match=r"a\.csv does not hold a skyline: "):
        Skyline.read_csv(tmp_path / "a.csv")


# JSON
@given(skyline=skylines())
def test_json_round_trip(folder, skyline):
    skyline.write_json(folder / "a.json")
    assert Skyline.read_json(folder / "a.json") == skyline


def document(**changes):
    good = {"format": "skyline", "version": 1, "rows": [3, 2.5], "visible": [True, False]}
    return good | changes


def test_json_is_what_the_docs_say(tmp_path):
    Skyline([3, 2.5], np.array([True, False])).write_json(tmp_path / "a.json")
    assert json.loads((tmp_path / "a.json").read_text()) == document()


def test_json_with_a_byte_order_mark(tmp_path):
    (tmp_path / "a.json").write_text(json.dumps(document()), encoding="utf-8-sig")
    assert Skyline.read_json(tmp_path / "a.json").rows.tolist() == [3, 2.5]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"format": "labelme"}, "format"),
        ({"version": 2}, "version 2"),
        ({"version": None}, "version None"),
        ({"rows": None}, '"rows"'),
        ({"rows": "3"}, '"rows"'),
        ({"rows": ["3", "2"]}, '"rows"'),
        ({"rows": [True, False]}, '"rows"'),
        ({"rows": [None, 1]}, '"rows"'),
        ({"rows": [[1], [2]]}, '"rows"'),
        ({"rows": []}, "shape"),
        ({"rows": [1, float("nan")]}, "column 1 is nan"),
        ({"rows": [10**400, 1]}, "numbers"),
        ({"visible": None}, '"visible"'),
        ({"visible": [1, 0]}, '"visible"'),
        ({"visible": ["true", "false"]}, '"visible"'),
        ({"visible": [None, True]}, '"visible"'),
        ({"visible": [True]}, "2 rows"),
    ],
)
def test_json_that_is_refused(tmp_path, changes, message):
    (tmp_path / "a.json").write_text(json.dumps(document(**changes)))
    with pytest.raises(SkylineError, match=r"a\.json does not hold a skyline: ") as caught:
        Skyline.read_json(tmp_path / "a.json")
    assert message in str(caught.value)


@pytest.mark.parametrize("content", [b"", b"{", b"[1, 2]", b"null", b"\xff\xfe", b"[" * 100_000])
def test_what_is_no_json_is_refused(tmp_path, content):
    (tmp_path / "a.json").write_bytes(content)
    with pytest.raises(SkylineError, match=r"a\.json does not hold a skyline: "):
        Skyline.read_json(tmp_path / "a.json")


@pytest.mark.parametrize("read", [Skyline.read_csv, Skyline.read_json])
def test_a_missing_file_is_the_systems_error(tmp_path, read):
    with pytest.raises(FileNotFoundError):
        read(tmp_path / "missing")


# Filling


def test_fill_interpolates_and_repeats_the_ends():
    rows = np.array([9, 2, 9, 9, 5, 9])
    visible = np.array([False, True, False, False, True, False])
    assert fill(rows, visible).tolist() == [2, 2, 3, 4, 5, 5]
    assert fill(rows, visible).dtype == np.float32


def test_fill_needs_a_visible_column():
    with pytest.raises(SkylineError, match="no column is visible"):
        fill(np.array([1, 2]), np.array([False, False]))
