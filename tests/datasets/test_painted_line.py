"""The line that is painted on a photograph, and strips that are none."""

import shutil

import numpy as np
import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from PIL import Image

import skyline_viz as sv
from skyline_viz.datasets import painted_line
from skyline_viz.datasets.sky_region import spans_of
from skyline_viz.datasets.truths import read_truth, truth_with_notes
from skyline_viz.skyline import Skyline, SkylineError
from testing import label_files as made
from testing.datasets import PHOTO, ROWS, WIDTH, only, put
from testing.examples import examples
from testing.label_files import said_about
from testing.scenes import noise

FEW = examples(40, suppress_health_check=[HealthCheck.function_scoped_fixture])


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


def truth_of(folder, pixels, name="a.png", **options):
    """The truth that a picture is read as."""
    shutil.rmtree(folder / "masks", ignore_errors=True)
    put(folder / "a.png")
    put(folder / "masks" / name, pixels, **options)
    return only(sv.open_dataset(folder)).truth()


@pytest.mark.parametrize("paint", ["red", "blue"])
@pytest.mark.parametrize("colour", [True, False])
def test_painted_photos_come_back_exactly(tmp_path, paint, colour):
    visible = np.arange(WIDTH) % 7 > 0
    under = PHOTO if colour else PHOTO[:, :, :1].repeat(3, axis=2)
    found = truth_of(tmp_path, sv.Skyline(ROWS, visible).to_painted(under, paint))
    assert np.array_equal(found.visible, visible)
    assert np.array_equal(found.rows[visible], ROWS[visible])


COLOURS = arrays(
    np.uint8,
    st.tuples(st.integers(8, 40), st.integers(8, 12), st.just(3)),
    elements=st.integers(0, 5),
)


@given(COLOURS, st.integers(0, 3), st.randoms(use_true_random=False))
def test_what_may_not_be_bare_is_not(colours, few, random):
    hits = np.zeros(colours.shape[:2], np.bool_)
    hits[random.randrange(len(hits))] = True
    if few:
        colours = colours // 3 * 3
    bare = painted_line._is_bare(painted_line._keys(colours), hits)
    assert painted_line._may_be_bare(colours, hits) or not bare


def test_a_photo_is_told_from_a_map_by_the_bound_alone():
    noise = np.random.default_rng(1).integers(0, 256, (64, 200, 3), np.uint8)
    hits = np.zeros(noise.shape[:2], np.bool_)
    hits[30] = True
    assert not painted_line._may_be_bare(noise, hits)
    assert painted_line._may_be_bare(noise // 128 * 128, hits)


@FEW
@given(st.lists(st.integers(0, 199), min_size=130, max_size=130))
def test_paint_is_far_that_is_far_from_the_median_around_it(rows):
    skyline = Skyline(rows)
    hits = np.zeros((200, 130), np.bool_)
    hits[rows, np.arange(130)] = True
    around = np.lib.stride_tricks.sliding_window_view(np.pad(skyline.rows, 6, mode="edge"), 13)
    far = np.flatnonzero(np.abs(skyline.rows - np.median(around, axis=1)) > 20)
    notes = painted_line._notes(skyline, hits)
    where = f"paint far from the rest of the line, in {spans_of(far)}" if len(far) else ""
    assert "".join(notes).startswith(where)
    assert bool(notes) == bool(len(far))


def test_paint_that_is_transparent_is_none(tmp_path):
    pixels = np.dstack([noise(60, 48), np.full((60, 48), 255, np.uint8)])
    pixels[40, :] = (255, 0, 0, 255)
    pixels[10, ::2] = (255, 0, 0, 0)
    Image.fromarray(pixels, "RGBA").save(tmp_path / "line.png")
    assert read_truth(tmp_path / "line.png") == Skyline([40] * 48)
