"""The pixels of path and truth along the columns: what is scrubbed is what was computed."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.diagnosis.explanation import explain_pixel
from skyline_viz.viewer import entities
from skyline_viz.viewer.bank_pictures import cell_box
from skyline_viz.viewer.maps.value_maps import FINE, classes_of
from skyline_viz.viewer.pixel_recording import PATCH, ellipse, log_pixels
from testing.recordings import Read, scene


@pytest.fixture(scope="module")
def found():
    return sv.Detector().detect(scene()[0])


@pytest.fixture(scope="module")
def truth():
    """Three rows too low, and not visible in column 60."""
    known = scene()[1]
    return sv.Skyline(known.rows + 3, known.visible)


@pytest.fixture(scope="module")
def read(found, truth, tmp_path_factory):
    path = tmp_path_factory.mktemp("pixels") / "a.rrd"
    with sv.new_recording(path, "a") as recording:
        log_pixels(recording, found, truth, 31, {})
    return Read(path)


def test_it_opens_at_the_column_that_is_asked_for(read, found):
    width = found.skyline.width
    texts = read.on(entities.COLUMN, entities.PIXEL_ABOUT, "text")
    assert sorted(texts) == list(range(width))
    assert texts[entities.OPENING][0].startswith("**Column 31**, the worst one")
    assert texts[90][0].startswith("**Column 90**\n")


def test_points_and_patches_are_those_of_the_pixel(read, found):
    points = read.on(entities.COLUMN, f"{entities.CHOSEN}/path", "positions")
    patches = read.on(entities.COLUMN, f"{entities.pixel_of('path')}/patch", "buffer")
    for column in (1, 31, 119):
        row = int(found.skyline.rows[column])
        assert points[column] == [[column + 0.5, row + 0.5]]
        patch = explain_pixel(found, row, column).filtered.patch.astype(np.float32)
        expected = classes_of(patch, PATCH.low, PATCH.high, FINE)
        assert np.array(patches[column][0], np.uint8).tobytes() == expected.tobytes()


def test_frames_lie_around_the_filters_of_edge_pixels(read, found):
    centres = read.on(entities.COLUMN, f"{entities.BANK_CHOSEN}/path", "centers")
    for column, row in enumerate(found.skyline.rows.astype(int).tolist()):
        if column == entities.OPENING:
            continue
        told = explain_pixel(found, row, column)
        if not told.edge:
            assert centres[column] == []
            continue
        left, top, right, bottom = cell_box(told.filtered.bin, found.bank.bins)
        assert centres[column] == [[(left + right) / 2, (top + bottom) / 2]]


def test_where_the_truth_is_not_visible_nothing_of_it_stays_in_sight(read):
    parent = entities.pixel_of("truth")
    assert read.on(entities.COLUMN, f"{entities.CHOSEN}/truth", "positions")[60] == []
    assert read.on(entities.COLUMN, f"{entities.BANK_CHOSEN}/truth", "centers")[60] == []
    assert read.on(entities.COLUMN, f"{parent}/ellipse", "strips")[60] == []
    buffer = read.on(entities.COLUMN, f"{parent}/patch", "buffer")
    assert not np.any(buffer[60][0])
    assert np.any(buffer[61][0])


def test_an_ellipse_points_along_the_gradient_and_its_axes_are_those_of_the_tensor(found):
    row = int(found.skyline.rows[31])
    told = explain_pixel(found, row, 31).filtered
    outline, axis = ellipse(told, 7)
    np.testing.assert_allclose(outline.mean(axis=0), 3.5, atol=0.3)
    along = axis[1] - axis[0]
    angle = np.degrees(np.arctan2(along[1], along[0])) % 180
    assert angle == pytest.approx(told.orientation, abs=0.1)
    far = np.linalg.norm(outline - 3.5, axis=1)
    first, second = told.axes
    assert far.min() / far.max() == pytest.approx(second / first, abs=0.02)
    assert far.max() <= 3.5 + 1e-5


def test_methods_without_a_bank_show_points_and_words_alone(tmp_path):
    photo, truth = scene()
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        log_pixels(recording, sv.find_method("gradient").detect(photo), truth, 0, {})
    read = Read(tmp_path / "a.rrd")
    assert entities.PIXEL_ABOUT in read.entities()
    assert not any(one.startswith(entities.pixel_of("path")) for one in read.entities())
