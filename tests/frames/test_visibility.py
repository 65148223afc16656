"""Where a line is a skyline: kinds of photos by their maps, and what always holds."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.arrays import runs
from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.frames.visibility import (
    COLUMN_THRESHOLD,
    PHOTO_THRESHOLD,
    SHORTEST,
    Visibility,
    visibility,
)
from skyline_viz.path import shortest_path
from testing.detections import Halves, half_a_line, mountains, unseen
from testing.networks import bright_model

HEIGHT, WIDTH = 96, 64


def sky_above(rows, height=HEIGHT):
    """A map that is right, a region a pixel."""
    return (np.arange(height)[:, None] < np.asarray(rows)[None, :]).astype(np.float32)


def edges_of(rows, on_edge, below=0, above=0):
    """Edge pixels: on the line where it is one, and so many a column well below and above it."""
    mine = np.flatnonzero(on_edge)
    found = [np.column_stack([rows[mine], mine])]
    for count, step in ((below, 1), (above, -1)):
        every = np.arange(len(rows))
        found += [np.column_stack([rows + step * (5 + place), every]) for place in range(count)]
    both = np.concatenate(found).astype(np.int32)
    return np.ascontiguousarray(both[:, 0]), np.ascontiguousarray(both[:, 1])


def looked_at(sky, rows, *, on_edge=True, below=20, above=0, height=HEIGHT):
    rows = np.ascontiguousarray(np.broadcast_to(np.asarray(rows, np.float32), WIDTH))
    edges = edges_of(rows, np.broadcast_to(np.asarray(on_edge, np.bool_), WIDTH), below, above)
    return visibility(sky, rows, *edges, height)


@st.composite
def cases(draw):
    """A map of any size, a line in a photo of any height, and where that is an edge."""
    height, width = draw(st.integers(2, 300)), draw(st.integers(2, 90))
    random = np.random.default_rng(draw(st.integers(0, 999)))
    sky = random.random((draw(st.integers(1, 12)), draw(st.integers(1, 12)))).astype(np.float32)
    if draw(st.booleans()):
        sky = sky.round()
    rows = random.integers(0, height, width).astype(np.float32)
    edges = random.random((height, width)) < draw(st.sampled_from([0.0, 0.1, 1.0]))
    if draw(st.booleans()):
        edges[rows.astype(int), np.arange(width)] = True
    edge_rows, edge_columns = (one.astype(np.int32) for one in np.nonzero(edges))
    return sky, rows, edge_rows, edge_columns, height


def direct(sky, rows, height):
    """What the map says of each column, pixel by pixel at the centres of regions."""
    found = []
    for column, row in enumerate(rows.astype(int)):
        above, below = sky[:row, column], sky[row:, column]
        found.append((above.mean() if row else 0.0) * (1 - below.mean() if row < height else 0.0))
    return np.array(found)


# Kinds of photos


def test_a_skyline_is_visible_from_side_to_side():
    rows = np.linspace(30, 60, WIDTH).round()
    found = looked_at(sky_above(rows), rows)
    assert (found.case, found.doubt) == ("skyline", "")
    assert found.visible.all()
    assert found.surest == pytest.approx(1)


@pytest.mark.parametrize(("value", "case"), [(0.0, "no sky"), (1.0, "no terrain")])
def test_a_photo_of_one_thing_only_has_no_skyline(value, case):
    found = looked_at(np.full((HEIGHT, WIDTH), value, np.float32), 40)
    assert found.case == case
    assert not found.visible.any()
    assert found.surest < 0.1
    assert case in found.doubt


@pytest.mark.parametrize("rim", [0, HEIGHT])
def test_a_line_that_leaves_through_a_rim_does_not_cross(rim):
    rows = np.full(WIDTH, 40.0)
    rows[WIDTH // 2 :] = rim
    found = looked_at(sky_above(rows), rows)
    assert found.case == "does not cross"
    assert found.visible[: WIDTH // 2 - 2].all()
    assert not found.visible[WIDTH // 2 + 2 :].any()
    assert f"{int(100 * found.visible.mean())} % of its columns" in found.doubt


def test_a_line_in_the_wrong_place_is_no_skyline():
    assert looked_at(sky_above(np.full(WIDTH, 10)), 80).case == "no sky"


def test_a_line_on_no_edge_is_not_visible():
    rows = np.full(WIDTH, 40)
    on_edge = np.arange(WIDTH) < WIDTH // 2
    found = looked_at(sky_above(rows), rows, on_edge=on_edge)
    assert found.case == "does not cross"
    assert not found.visible[-WIDTH // 3 :].any()


def test_the_only_edge_of_a_photo_is_believed_whatever_the_map_says():
    wrong = np.ones((HEIGHT, WIDTH), np.float32)
    assert looked_at(wrong, 40, below=0).case == "skyline"
    assert looked_at(wrong, 40, below=2).case == "no terrain"


def test_a_sky_as_full_of_edges_as_the_terrain_is_doubted():
    rows = np.full(WIDTH, 48)
    sky = sky_above(rows) * np.float32(0.7)
    assert looked_at(sky, rows, below=40).case == "skyline"
    assert looked_at(sky, rows, below=40, above=40).surest < 0.5
    few = looked_at(sky, rows, below=2, above=2)  # grain
    assert few.surest > 0.7 * looked_at(sky, rows, below=2).surest


def test_a_photo_without_an_edge_has_no_skyline():
    found = looked_at(sky_above(np.full(WIDTH, 40)), 40, on_edge=False, below=0)
    assert not found.visible.any()


@pytest.mark.parametrize("height", [24, 96, 500])
def test_the_height_of_the_photo_does_not_matter(height):
    rows = np.full(WIDTH, height / 2)
    one = looked_at(sky_above(np.full(WIDTH, 48)), rows, below=3, height=height)
    assert one.surest == pytest.approx(1, abs=0.05)


def test_arrays_are_frozen():
    found = looked_at(sky_above(np.full(WIDTH, 40)), 40)
    for array in (found.evidence, found.visible):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


# What always holds


@given(cases())
def test_evidence_is_shares_and_decide(case):
    found = visibility(*case)
    assert isinstance(found, Visibility)
    assert found.evidence.shape == found.visible.shape == case[1].shape
    assert ((found.evidence >= 0) & (found.evidence <= 1)).all()
    assert found.evidence.min() <= found.surest <= found.evidence.max()
    if found.surest < PHOTO_THRESHOLD:
        assert found.case in ("no sky", "no terrain")
        assert not found.visible.any()
    else:
        doubted = found.evidence < COLUMN_THRESHOLD
        np.testing.assert_array_equal(found.visible[~doubted], True)
        for first, last in runs(doubted):
            assert (not found.visible[first]) == (last + 1 - first >= SHORTEST * len(doubted))
            assert len(set(found.visible[first : last + 1])) == 1
        assert (found.case == "skyline") == bool(found.visible.all())
    assert (found.doubt == "") == (found.case == "skyline")


@given(cases())
def test_a_mirrored_photo_is_seen_the_same(case):
    sky, rows, edge_rows, edge_columns, height = case
    found = visibility(*case)
    flipped = (np.ascontiguousarray(one) for one in (sky[:, ::-1], rows[::-1]))
    mirrored = visibility(*flipped, edge_rows, np.int32(len(rows) - 1) - edge_columns, height)
    np.testing.assert_allclose(mirrored.evidence[::-1], found.evidence, atol=1e-5)


@given(st.integers(0, 999))
def test_evidence_is_the_mean_of_what_the_map_says_of_the_columns_around(seed):
    random = np.random.default_rng(seed)
    sky = random.random((HEIGHT, WIDTH)).astype(np.float32)
    rows = random.integers(1, HEIGHT, WIDTH).astype(np.float32)
    found = looked_at(sky, rows)
    said = direct(sky, rows, HEIGHT)
    for column in range(WIDTH):
        around = said[max(column - 2, 0) : column + 3]
        assert found.evidence[column] == pytest.approx(around.mean(), abs=1e-5)


@given(cases(), st.floats(0, 1))
def test_more_sky_above_and_less_below_never_lowers_the_evidence(case, share):
    sky, line, edge_rows, edge_columns, height = case
    count = len(sky)
    border = count // 2
    rows = np.full(len(line), border * height / count, np.float32)
    surer = sky.copy()
    surer[:border] += np.float32(share) * (1 - surer[:border])
    surer[border:] *= np.float32(1 - share)
    before = visibility(sky, rows, edge_rows, edge_columns, height)
    after = visibility(surer, rows, edge_rows, edge_columns, height)
    assert (after.evidence >= before.evidence - 1e-5).all()


# In detections


def test_what_is_no_skyline_is_marked_and_said():
    detection = unseen().detect(mountains()[0])
    assert detection.visibility.case == "no sky"
    assert detection.visibility.surest < 0.1
    assert not detection.skyline.visible.any()
    assert "visible" in repr(detection.skyline)


def test_columns_that_do_not_show_the_line_are_marked():
    photo = half_a_line()
    detection = unseen(Halves).detect(photo)
    assert detection.visibility.case == "does not cross"
    half = photo.shape[1] // 2
    assert detection.skyline.visible[: half - 8].all()
    assert not detection.skyline.visible[half + 8 :].any()


@pytest.mark.parametrize("config", [DetectorConfig.paper(), DetectorConfig(sky_weight=0)])
def test_without_a_sky_model_every_column_is_visible(config):
    detection = replace(unseen(), config=config).detect(mountains()[0])
    assert detection.visibility is None
    assert detection.skyline.visible.all()


def test_what_is_visible_moves_no_line():
    photo = mountains()[0]
    detection = unseen().detect(photo)
    path = shortest_path(detection.cost, detection.delta, detection.link_weight)
    assert np.array_equal(detection.skyline.rows, path.rows.astype(np.float32))
    again = detection.again(replace(detection.config, link_weight=0.2))
    assert again.visibility.case == "no sky"


# In a frame


@pytest.mark.parametrize("side", [50, 150, 240])
def test_bars_at_the_sides_say_nothing_of_the_picture(side):
    """A line that is right in all of the picture crosses it, however narrow that is."""
    photo = np.zeros((300, 600, 3), np.uint8)
    rows = 150 + 20 * np.sin(np.arange(600) / 40)
    below = np.arange(300)[:, None] >= rows
    photo[:] = np.where(below[..., None], (60, 70, 50), (170, 200, 240))
    photo[:, :side] = photo[:, 600 - side :] = 0
    found = Detector(sky=bright_model()).detect(photo)
    assert (found.frame.left, found.frame.right) == (side, side)
    shown = found.frame.shows(600)
    np.testing.assert_array_equal(found.skyline.visible, shown)
    np.testing.assert_array_equal(found.visibility.visible, shown)
    assert (found.visibility.case, found.visibility.share) == ("skyline", 1.0)
