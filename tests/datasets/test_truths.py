"""Masks of every kind: read rightly, or refused with what is in them, and never silently wrong."""

import os
import shutil

import numpy as np
import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st
from PIL import Image

import skyline_viz as sv
from skyline_viz.datasets.truths import read_truth
from skyline_viz.skyline import Skyline, SkylineError
from testing import label_files as made
from testing.datasets import HEIGHT, MASK, NOISE, ROWS, SKYLINE, WIDTH, only, put
from testing.examples import examples
from testing.label_files import said_about

FEW = examples(40, suppress_health_check=[HealthCheck.function_scoped_fixture])


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


def truth_of(folder, pixels, name="a.png", **options):
    """The truth that a picture is read as."""
    shutil.rmtree(folder / "masks", ignore_errors=True)
    put(folder / "a.png")
    put(folder / "masks" / name, pixels, **options)
    return only(sv.open_dataset(folder)).truth()


@pytest.mark.parametrize("ending", ["png", "bmp", "pgm", "tif"])
def test_masks_come_back_exactly(tmp_path, ending):
    assert truth_of(tmp_path, MASK, f"a.{ending}") == SKYLINE


@pytest.mark.parametrize(
    "pixels",
    [
        MASK.repeat(3).reshape(HEIGHT, WIDTH, 3),  # RGB
        np.dstack([MASK, MASK, MASK, np.full_like(MASK, 255)]),  # RGBA
        np.dstack([MASK // 255 * 250, MASK // 255 * 235, MASK]),  # tinted
        MASK > 0,  # one bit
        (MASK.astype(np.uint16) << 8) | MASK,  # 16 bits
        np.where(MASK > 0, 128, 127).astype(np.uint8),  # pale
    ],
)
def test_masks_of_every_kind(tmp_path, pixels):
    assert truth_of(tmp_path, pixels) == SKYLINE


@pytest.mark.parametrize("mode", ["L", "RGB"])
def test_jpeg_masks_are_cut_at_128(tmp_path, mode):
    pixels = np.array(Image.fromarray(MASK).convert(mode))
    rows = truth_of(tmp_path, pixels, "a.jpg", quality=92).rows
    assert np.abs(rows - ROWS).max() <= 1


def test_soft_edges_are_cut_at_128(tmp_path):
    soft = MASK.copy()
    soft[ROWS - 1, np.arange(WIDTH)] = 127
    assert truth_of(tmp_path, soft) == SKYLINE
    soft[ROWS - 1, np.arange(WIDTH)] = 128
    assert truth_of(tmp_path, soft) == sv.Skyline(ROWS - 1)


@pytest.mark.parametrize("row", [0, HEIGHT])
def test_masks_all_sky_or_all_terrain(tmp_path, row):
    skyline = sv.Skyline(np.full(WIDTH, row))
    mask = np.where(skyline.to_mask(HEIGHT), 0, 255).astype(np.uint8)
    assert truth_of(tmp_path, mask) == skyline


def test_a_lake_or_a_gap_in_the_rock_does_not_count(tmp_path):
    mask = MASK.copy()
    mask[12:14, 3:9] = 0
    assert truth_of(tmp_path, mask) == SKYLINE


@pytest.mark.parametrize(
    ("pixels", "reason"),
    [
        (NOISE, "no pixel is painted"),
        (NOISE[:, :, :1].repeat(3, axis=2) // 4 * 2, "brightest value is 126"),
        (NOISE[:, :, :1].repeat(3, axis=2), "neither painted nor a mask"),
        (np.repeat(np.uint8([255, 0]), [15, 1])[:, None].repeat(WIDTH, axis=1), "neither painted"),
    ],
)
def test_a_picture_that_is_no_truth_is_refused(tmp_path, pixels, reason):
    with pytest.raises(sv.SkylineError, match=reason) as caught:
        truth_of(tmp_path, pixels)
    assert str(caught.value).startswith(f"{tmp_path / 'masks' / 'a.png'} is no truth: ")
    assert str(caught.value).endswith(".")
