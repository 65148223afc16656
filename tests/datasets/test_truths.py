"""Masks of every kind: read rightly, or refused with what is in them, and never silently wrong."""

import os

import numpy as np
import pytest
import tifffile
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image, ImageFilter

from skyline_viz.datasets.sky_region import line_of
from skyline_viz.datasets.truths import read_truth, truth_with_notes
from skyline_viz.photo import read_photo
from skyline_viz.picture_files.orientation import upright, upright_image
from skyline_viz.skyline import Skyline, SkylineError
from testing import label_files as made

FEW = settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def said_about(path, **options):
    with pytest.raises(SkylineError) as caught:
        read_truth(path, **options)
    said = str(caught.value)
    assert said.startswith(str(path))
    assert said.endswith(".")
    assert len(said.splitlines()) == 1
    return said


@pytest.mark.parametrize("kind", made.SAME)
def test_what_can_be_read_in_one_way_only_is_read_so(tmp_path, kind):
    found = read_truth(made.SAME[kind](tmp_path))
    shown = found.visible
    assert shown.sum() >= made.WIDTH - 4
    np.testing.assert_array_equal(found.rows[shown], made.ROWS[shown])


@pytest.mark.parametrize("kind", made.NEAR)
def test_soft_and_lossy_masks_are_cut_in_the_middle(tmp_path, kind):
    found = read_truth(made.NEAR[kind](tmp_path))
    assert found.visible.all()
    assert np.abs(found.rows - made.ROWS).max() <= 2
    assert np.abs(found.rows - made.ROWS).mean() < 0.5


@pytest.mark.parametrize("kind", made.ASK)
def test_what_can_be_read_in_two_ways_is_asked_about(tmp_path, kind):
    said = said_about(made.ASK[kind](tmp_path))
    assert "--sky" in said
    assert "--terrain" in said
    assert "%" in said


@pytest.mark.parametrize("kind", made.REFUSED)
def test_what_is_no_truth_is_refused(tmp_path, kind):
    said_about(made.REFUSED[kind](tmp_path))


@pytest.mark.parametrize(
    ("kind", "values"),
    [
        ("palette of three", {"sky": "#4682b4"}),
        ("palette of three", {"sky": "SteelBlue"}),
        ("palette of three", {"sky": "0"}),
        ("palette of three", {"terrain": "1,2"}),
        ("three colours", {"sky": "#4682B4"}),
        ("three colours in JPEG", {"sky": "blue"}),
        ("three greys", {"sky": "2"}),
        ("three greys", {"terrain": "100, 200"}),
        ("three greys around 128", {"sky": "black"}),
        ("ids with 255 for nothing", {"sky": "1"}),
        ("ids in 16 bits", {"sky": "7"}),
        ("the same above and below", {"sky": "0"}),
    ],
)
def test_an_answer_decides(tmp_path, kind, values):
    found = read_truth(made.ASK[kind](tmp_path), **values)
    assert np.abs(found.rows - made.ROWS).max() <= (1 if "JPEG" in kind else 0)


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ({"sky": "9"}, "there is no 9 in it; it holds the palette colours #4682b4"),
        ({"sky": "mauve-ish"}, "there is no mauve-ish in it"),
        ({"sky": "1"}, "1 is not sky in it"),
        ({"terrain": "0"}, "0 is not terrain in it"),
        ({"sky": "2"}, "2 is not sky in it"),
    ],
)
def test_an_answer_that_cannot_be_is_refused(tmp_path, values, reason):
    assert reason in said_about(made.ASK["palette of three"](tmp_path), **values)


@pytest.mark.parametrize("kind", ["as we write it", "white sky"])
def test_an_answer_never_turns_a_mask_upside_down(tmp_path, kind):
    path = made.SAME[kind](tmp_path)
    right, wrong = ("0", "255") if kind == "as we write it" else ("255", "0")
    assert read_truth(path, sky=right) == made.SKYLINE
    assert read_truth(path, terrain=wrong) == made.SKYLINE
    said_about(path, sky=wrong)
    said_about(path, terrain=right)


@FEW
@given(rows=st.lists(st.integers(0, 4), min_size=24, max_size=24).filter(any))
def test_a_thin_sky_in_blue_is_no_painted_line(tmp_path, rows):
    sky = Skyline(rows).to_mask(40)
    for below in ((0, 0, 0), (0, 255, 0)):
        pixels = np.where(sky[:, :, None], (0, 0, 255), below).astype(np.uint8)
        pixels[30:, 3:9] = (90, 90, 90) if any(below) else pixels[30:, 3:9]
        path = made.picture(tmp_path / "m.png", pixels)
        try:
            assert read_truth(path) == Skyline(rows)
        except SkylineError as error:
            assert "--sky" in str(error)
        assert read_truth(path, sky="blue") == Skyline(rows)


def test_sky_and_terrain_exclude_each_other(tmp_path):
    with pytest.raises(SkylineError, match="not both"):
        read_truth(made.SAME["0 and 1"](tmp_path), sky="0", terrain="1")


@pytest.mark.parametrize("kind", ["transparent", "opaque"])
def test_transparency_is_a_value(tmp_path, kind):
    path = made.SAME["terrain in alpha"](tmp_path)
    assert read_truth(path, **{"sky" if kind == "transparent" else "terrain": kind}) == made.SKYLINE


@pytest.mark.parametrize(
    ("kind", "note"),
    [
        ("a frame of 2", "a frame of 2 pixels was left out"),
        ("a bird", "specks above the line were left out in columns 50 to 55"),
    ],
)
def test_what_was_left_out_is_said(tmp_path, kind, note):
    assert truth_with_notes(made.SAME[kind](tmp_path)).notes == (note,)


def test_a_large_piece_in_the_sky_is_terrain_and_is_said(tmp_path):
    path = made.picture(tmp_path / "m.png", made.spotted(made.MASK, 5, 25, 50, 80, 255))
    line = truth_with_notes(path)
    assert (line.skyline.rows[50:80] == 5).all()
    assert "columns 50 to 79" in line.notes[0]


@FEW
@given(data=st.data())
def test_any_mask_of_ours_comes_back_and_its_inverse_means_the_same_or_is_asked_about(
    tmp_path, data
):
    heights = st.integers(0, 40)
    rows = np.array(data.draw(st.lists(heights, min_size=24, max_size=24)))
    mask = np.where(Skyline(rows).to_mask(40), 0, 255).astype(np.uint8)
    straight = made.picture(tmp_path / "m.png", mask)
    inverse = made.picture(tmp_path / "i.png", 255 - mask)
    wanted = [Skyline(rows)]
    if (rows == 0).all() or (rows == 40).all():  # of one value: the convention says which
        assert read_truth(straight) == wanted[0]
        return
    for path in (straight, inverse):
        try:
            assert read_truth(path) in wanted
        except SkylineError as error:
            assert "--sky" in str(error)
            if path == straight:  # no column holds both
                assert set(rows.tolist()) <= {0, 40}


@FEW
@given(seed=st.integers(0, 10**6))
def test_damaged_pictures_raise_nothing_but_sentences(tmp_path, seed):
    random = np.random.default_rng(seed)
    kinds = {**made.SAME, **made.NEAR, **made.ASK}
    path = kinds[random.choice(list(kinds))](tmp_path)
    whole = bytearray(path.read_bytes())
    for _ in range(random.integers(1, 8)):
        whole[random.integers(len(whole))] = random.integers(256)
    path.write_bytes(bytes(whole[: random.integers(1, len(whole) + 1)]))
    try:
        read_truth(path)
    except SkylineError as error:
        assert len(str(error).splitlines()) == 1


def test_pipes_and_huge_tables_are_no_truths(tmp_path):
    os.mkfifo(tmp_path / "a.csv")
    said_about(tmp_path / "a.csv")
    with (tmp_path / "b.json").open("wb") as file:
        file.truncate(10**9)
    assert "larger than any skyline" in said_about(tmp_path / "b.json")


def test_a_region_of_nothing_has_no_line():
    with pytest.raises(SkylineError):
        line_of(np.random.default_rng(0).random((40, 40)) > 0.5)


def test_an_image_that_is_turned_is_read_upright(tmp_path):
    exif = Image.Exif()
    exif[0x0112] = 6
    turned = np.rot90(made.MASK)
    path = made.picture(tmp_path / "m.png", turned, exif=exif)
    assert read_truth(path) == made.SKYLINE


TURNS = {
    2: lambda a: a[:, ::-1],
    3: lambda a: a[::-1, ::-1],
    4: lambda a: a[::-1],
    5: lambda a: a.swapaxes(0, 1),
    6: np.rot90,
    7: lambda a: np.rot90(a, -1)[::-1],
    8: lambda a: np.rot90(a, -1),
}
"""How pixels are stored that come upright by an orientation."""


@pytest.mark.parametrize("orientation", TURNS)
@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.float32, "palette", "colours"])
def test_a_turned_tiff_is_read_as_photos_are(tmp_path, orientation, kind):
    turned = np.ascontiguousarray(TURNS[orientation](made.MASK))
    path = tmp_path / "m.tif"
    if kind == "palette":
        image = Image.fromarray(turned).convert("P")
        image.save(path, tiffinfo={274: orientation})
    else:
        values = turned if kind == "colours" else (turned // 255).astype(kind)
        values = np.repeat(values[:, :, None], 3, axis=2) if kind == "colours" else values
        tag = (274, "H", 1, orientation, True)
        tifffile.imwrite(path, values, extratags=[tag], metadata=None)
    assert read_truth(path) == made.SKYLINE
    if kind == "colours":
        np.testing.assert_array_equal(read_photo(path)[:, :, 0], made.MASK)


def test_turned_tiff_colours_of_16_bits_are_refused(tmp_path):
    pixels = np.repeat(made.MASK[::-1, :, None].astype(np.uint16) * 257, 3, axis=2)
    tag = (274, "H", 1, 4, True)
    tifffile.imwrite(tmp_path / "m.tif", pixels, photometric="rgb", extratags=[tag])
    with pytest.raises(SkylineError, match="stored turned"):
        read_truth(tmp_path / "m.tif")


@pytest.mark.parametrize("kind", [np.uint8, np.float32])
def test_the_full_page_of_a_tiff_is_its_mask(tmp_path, kind):
    mask = (made.MASK // 255).astype(kind)
    small = np.ascontiguousarray(mask[::-4, ::4])
    for name, mark, notes in (
        ("marked.tif", 1, ()),
        ("plain.tif", 0, ("of its 2 pages the largest was read",)),
    ):
        with tifffile.TiffWriter(tmp_path / name) as file:
            file.write(small, subfiletype=mark, metadata=None)
            file.write(mask, metadata=None)
        found = truth_with_notes(tmp_path / name)
        assert (found.skyline, found.notes) == (made.SKYLINE, notes)


def test_of_two_masks_in_a_tiff_none_is_guessed(tmp_path):
    with tifffile.TiffWriter(tmp_path / "m.tif") as file:
        for mask in (made.MASK[::-1], made.MASK):
            file.write(np.ascontiguousarray(mask), metadata=None)
    said = said_about(tmp_path / "m.tif")
    assert "2 pages of the same size" in said
    assert "which of them is the mask" in said


@pytest.mark.parametrize("orientation", range(1, 9))
def test_pixels_are_turned_as_pictures_are(orientation):
    pixels = np.arange(12, dtype=np.uint8).reshape(3, 4)
    wanted = np.asarray(upright_image(Image.fromarray(pixels), orientation))
    np.testing.assert_array_equal(upright(pixels, orientation), wanted)


RIVER = [(70, 130, 180), (90, 90, 90), (0, 0, 255), (255, 0, 0)]


def with_strip(value, thick=3, top=110, columns=slice(0, 130), indices=None):
    indices = np.where(made.SKY, 0, 1) if indices is None else indices.copy()
    indices[top : top + thick, columns] = value
    return indices


@pytest.mark.parametrize("value", [2, 3])
@pytest.mark.parametrize("thick", [1, 2, 3, 4])
@pytest.mark.parametrize("whole", [True, False])
@pytest.mark.parametrize("form", ["palette", "colours", "scaled", "fields"])
def test_a_river_or_a_road_in_a_map_is_no_painted_line(tmp_path, value, thick, whole, form):
    columns = slice(None) if whole else slice(0, 130)
    indices = with_strip(value, thick, columns=columns)
    if form == "fields":  # the strip parts what lies above it from what lies below
        indices = with_strip(value, thick, columns=columns, indices=THREE_FIELDS)
    table = np.array([*RIVER, (20, 90, 20)], np.uint8)
    path = tmp_path / "m.png"
    if form == "palette":
        made.palette(path, indices, table.tolist())
    elif form == "scaled":  # with blends at every border
        image = Image.fromarray(np.repeat(np.repeat(table[indices], 2, axis=0), 2, axis=1))
        image.resize((made.WIDTH, made.HEIGHT), Image.Resampling.BICUBIC).save(path)
    else:
        made.picture(path, table[indices])
    assert "--sky" in said_about(path)
    found = read_truth(path, sky="#4682b4")
    assert np.abs(found.rows - made.ROWS).max() <= (1 if form == "scaled" else 0)


THREE_FIELDS = np.where(made.SKY, 0, np.where(np.arange(made.HEIGHT)[:, None] < 112, 1, 4))


@pytest.mark.parametrize("paint", ["red", "blue"])
def test_a_line_along_the_border_of_a_flat_picture_is_painted(tmp_path, paint):
    flat = np.array(RIVER, np.uint8)[np.where(made.SKY, 0, 1)]
    for under in (flat, flat * 0):
        path = made.picture(tmp_path / "m.png", made.SKYLINE.to_painted(under, paint))
        assert read_truth(path) == made.SKYLINE


def test_of_two_painted_lines_none_is_guessed(tmp_path):
    painted = made.SKYLINE.to_painted(made.photo())
    painted[:, :5][made.SKYLINE.to_painted(made.photo())[:, :5, 0] == 255] = (9, 9, 9)
    painted[110] = made.BLUE
    said = said_about(made.picture(tmp_path / "m.png", painted))
    assert "red, in 155 columns" in said
    assert "another in blue, in 160" in said


def test_two_painted_lines_that_agree_are_one(tmp_path):
    painted = made.SKYLINE.to_painted(made.photo())
    painted[made.ROWS + 1, np.arange(made.WIDTH)] = made.BLUE
    assert read_truth(made.picture(tmp_path / "m.png", painted)) == made.SKYLINE


@pytest.mark.parametrize("alone", [True, False])
def test_paint_far_from_the_line_is_said(tmp_path, alone):
    painted = made.SKYLINE.to_painted(made.photo())
    if alone:
        painted[:, 50:56] = made.photo()[:, 50:56]
    painted[5, 50:56] = made.RED
    line = truth_with_notes(made.picture(tmp_path / "m.png", painted))
    assert (line.skyline.rows[50:56] == 5).all()
    note = "paint far from the rest of the line, in columns 50 to 55, counts as skyline"
    assert line.notes == (note,)


def third_value(kind):
    levels = {"sky": 0, "terrain": 255, "third": 100}
    mask = made.MASK.copy()
    if kind == "a mast":
        mask[20 : made.ROWS[100], 100:106] = levels["third"]
    elif kind == "a rim":
        mask = 255 - mask
        mask[(np.arange(made.HEIGHT)[:, None] >= made.ROWS - 6) & made.SKY] = 160
    elif kind == "a balloon":
        mask[30:37, 40:47] = 90
    return mask


@pytest.mark.parametrize("kind", ["a mast", "a rim", "a balloon"])
@pytest.mark.parametrize("form", ["grey", "16 bits", "rgb", "colours", "jpeg", "blurred"])
def test_a_small_third_value_is_asked_about(tmp_path, kind, form):
    mask, path = third_value(kind), tmp_path / "m.png"
    sky = "255" if kind == "a rim" else "0"
    if form == "16 bits":
        made.picture(path, mask.astype(np.uint16) * 257)
        sky = str(int(sky) * 257)
    elif form == "rgb":
        made.picture(path, np.repeat(mask[:, :, None], 3, axis=2))
    elif form == "colours":
        made.picture(path, np.dstack([mask * 0, mask * 0, mask]))
        sky = "#0000ff" if kind == "a rim" else "#000000"
    elif form == "jpeg":
        path = made.picture(tmp_path / "m.jpg", mask, quality=90)
    elif form == "blurred":
        made.picture(path, Image.fromarray(mask).filter(ImageFilter.GaussianBlur(0.5)))
    else:
        made.picture(path, mask)
    said = said_about(path)
    if form in ("jpeg", "blurred"):
        return
    assert "--sky" in said
    wanted = np.where(mask == mask[0, 0], 0, 255).argmax(axis=0)
    if kind == "a balloon":  # a speck that floats, of which a note is made
        wanted = made.ROWS
    np.testing.assert_array_equal(read_truth(path, sky=sky).rows, wanted)


@FEW
@given(blur=st.floats(0, 12), scale=st.sampled_from([0.3, 0.7, 1, 2, 3.7]), upper=st.booleans())
def test_soft_edges_are_no_third_value(tmp_path, blur, scale, upper):
    image = Image.fromarray(255 - made.MASK if upper else made.MASK)
    size = (int(made.WIDTH * scale), int(made.HEIGHT * scale))
    soft = image.resize(size).filter(ImageFilter.GaussianBlur(blur * scale / 4))
    half = (np.asarray(soft) < 128) != upper
    found = read_truth(made.picture(tmp_path / "m.png", np.asarray(soft)))
    assert np.abs(found.rows - half.argmin(axis=0)).max() <= 1


@pytest.mark.parametrize("ids", [(0, 1, 2), (2, 3, 9), (10, 20, 30), (100, 101, 127)])
@pytest.mark.parametrize("form", [np.uint8, np.uint16, "rgb"])
def test_small_ids_are_asked_about_and_answered(tmp_path, ids, form):
    values = np.array([ids[2], ids[0], ids[1]], np.uint8)[made.THREE]
    values = np.repeat(values[:, :, None], 3, axis=2) if form == "rgb" else values.astype(form)
    path = made.picture(tmp_path / "m.png", values)
    said = said_about(path)
    assert "--sky" in said
    for one in ids:
        assert f"{one} (" in said
    assert read_truth(path, sky=str(ids[2])) == made.SKYLINE
    assert read_truth(path, terrain=f"{ids[0]},{ids[1]}") == made.SKYLINE
