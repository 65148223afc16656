"""Masks of every kind: read rightly, or refused with what is in them, and never silently wrong."""

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from skyline_viz.sky_region import line_of
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.truths import read_truth, truth_with_notes
from tests import label_files as made

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
