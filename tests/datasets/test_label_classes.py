"""What a label picture tells apart, and what people say that it means."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st
from PIL import Image, ImageFilter

from skyline_viz.datasets.truths import read_truth
from skyline_viz.skyline import SkylineError
from testing import label_files as made
from testing.examples import examples
from testing.label_files import said_about

FEW = examples(40, suppress_health_check=[HealthCheck.function_scoped_fixture])


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


def test_sky_and_terrain_exclude_each_other(tmp_path):
    with pytest.raises(SkylineError, match="not both"):
        read_truth(made.SAME["0 and 1"](tmp_path), sky="0", terrain="1")


@pytest.mark.parametrize("kind", ["transparent", "opaque"])
def test_transparency_is_a_value(tmp_path, kind):
    path = made.SAME["terrain in alpha"](tmp_path)
    assert read_truth(path, **{"sky" if kind == "transparent" else "terrain": kind}) == made.SKYLINE


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
