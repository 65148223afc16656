"""What helps to read maps: lines that last when shrunk, scales, and a fade."""

import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from PIL import Image

import skyline_viz as sv
from skyline_viz.stage import COST, SCORE
from skyline_viz.viewer.maps.map_aids import (
    DRAWN,
    FADED_UNDER,
    SCALE,
    broadened,
    log_fade,
    reach_of,
)
from skyline_viz.viewer.maps.value_maps import COARSE, FINE, dense_map, sparse_map
from testing.recordings import Read

CLASSES = st.sampled_from([np.uint8, np.uint16]).flatmap(
    lambda kind: arrays(kind, (6, 9), elements=st.sampled_from([0, 0, 0, 1, 7, 255]))
)


@given(classes=CLASSES, lowest=st.booleans(), reach=st.integers(0, 2))
def test_each_pixel_takes_the_first_of_its_neighbours(classes, lowest, reach):
    wide = broadened(classes, reach, lowest)
    assert wide.dtype == classes.dtype
    for row, column in np.ndindex(*classes.shape):
        around = classes[
            max(row - reach, 0) : row + reach + 1, max(column - reach, 0) : column + reach + 1
        ]
        known = around[around > 0]
        wanted = 0 if not len(known) else known.min() if lowest else known.max()
        assert wide[row, column] == wanted


@pytest.mark.parametrize("shape", [(1024, 1024), (519, 1388), (3024, 4032)])
@pytest.mark.parametrize("view", [(427, 240), (640, 346)])
def test_a_line_stays_whole_in_a_small_view(shape, view):
    height, width = shape
    lit = broadened(np.eye(height, width, dtype=np.uint8), reach_of(shape), False)
    step = max(width / view[0], height / view[1])
    rows = np.arange(step / 2, height, step).astype(int)
    columns = np.arange(step / 2, min(height, width), step).astype(int)
    assert lit[np.ix_(rows, columns)].any(axis=0).all()  # of the pixels that the view draws


def logged(tmp_path, *maps):
    with sv.new_recording(tmp_path / "m.rrd", "m") as recording:
        for at, (entity, one) in enumerate(maps):
            recording.set_time("image", sequence=at)
            one.log(recording, entity)
    return Read(tmp_path / "m.rrd")


def line_of(quantity, levels):
    columns = np.arange(1000, dtype=np.int32)
    rows = np.full(1000, 300, np.int32)
    return sparse_map(quantity, (600, 1000), rows, columns, np.linspace(0, 1, 1000), levels)


@pytest.mark.parametrize("levels", [COARSE, FINE])
@pytest.mark.parametrize("quantity", [SCORE, COST])
def test_a_sparse_map_is_broad_below_and_itself_above(tmp_path, quantity, levels):
    one = line_of(quantity, levels)
    read = logged(tmp_path, ("map", one))
    np.testing.assert_array_equal(read.classes("map"), one.classes)
    blob = np.array(read.last(f"map/{DRAWN}/broad", "blob").as_py()[0], np.uint8)
    broad = np.asarray(Image.open(io.BytesIO(blob.tobytes())).convert("RGBA"))
    reach = reach_of(broad.shape)
    assert np.flatnonzero(broad[..., 3].any(axis=1)).tolist() == list(
        range(300 - reach, 301 + reach)
    )
    assert read.array(f"map/{DRAWN}/broad", "draw_order") < 0


def test_what_an_earlier_photo_had_broad_goes_with_it(tmp_path):
    dense = dense_map(SCORE, np.where(np.eye(600, 1000), np.nan, 0.5), COARSE)
    read = logged(tmp_path, ("map", line_of(SCORE, COARSE)), ("map", dense))
    assert list(read.on("image", f"map/{DRAWN}/broad", "is_recursive")) == [1]


def test_a_scale_has_the_values_of_its_ends_outside_of_the_map(tmp_path):
    one = dense_map(SCORE, np.full((40, 60), 0.5), COARSE)
    read = logged(tmp_path, ("map", one))
    assert read.last(f"map/{SCALE}", "labels").as_py() == ["0", "1"]
    strips = np.array(read.last(f"map/{SCALE}", "strips").as_py())
    assert strips[..., 0].min() > 60
    assert (strips[..., 1] >= 0).all()
    assert (strips[..., 1] <= 40).all()


def test_orientations_fade_where_the_gradient_is_weak(tmp_path):
    classes = np.array([[0, 1, 2, 3]], np.uint8)
    strengths = np.array([FADED_UNDER, 0.0, FADED_UNDER / 2, 3 * FADED_UNDER])
    with sv.new_recording(tmp_path / "m.rrd", "m") as recording:
        log_fade(recording, "map", classes, strengths)
    read = Read(tmp_path / "m.rrd")
    context = read.last(f"map/{DRAWN}/fade", "context").as_py()[0]
    infos = [one["class_description"]["info"] for one in context]
    veil = {one["id"]: one["color"] & 0xFF for one in infos}
    seen = [veil[one] for one in read.classes(f"map/{DRAWN}/fade")[0].tolist()]
    assert seen[0] == seen[3] == 0
    assert seen[1] == 255 > seen[2] > 0
