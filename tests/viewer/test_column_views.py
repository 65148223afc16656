"""What runs along the columns: lines with gaps, plots, and the strip below the photo."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.viewer import entities
from skyline_viz.viewer.column_views import (
    STRIP_ERRORS,
    line_strips,
    log_columns,
    log_line,
    log_series,
    path_costs,
)
from testing.recordings import Read, scene


@pytest.fixture(scope="module")
def found():
    photo, truth = scene()
    return sv.Detector().detect(photo), truth


@given(st.lists(st.booleans(), min_size=1, max_size=30))
def test_strips_are_the_visible_runs_through_the_centres_of_pixels(visible):
    rows = np.arange(len(visible), dtype=np.float32)
    strips = line_strips(sv.Skyline(rows, np.array(visible)))
    points = np.concatenate([*strips, np.zeros((0, 2))])
    np.testing.assert_array_equal(points[:, 0], np.flatnonzero(visible) + 0.5)
    np.testing.assert_array_equal(points[:, 1], rows[visible])
    ends = np.array([(strip[0, 0], strip[-1, 0]) for strip in strips]).reshape(-1, 2)
    assert (ends[1:, 0] - ends[:-1, 1] > 1).all()


def test_a_halo_is_wider_than_its_line_and_lies_below_it(tmp_path):
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        log_line(recording, "line", sv.Skyline([3, 4, 5]), (1, 2, 3))
    read = Read(tmp_path / "a.rrd")
    radius, halo = (abs(read.last(one, "radii").as_py()[0]) for one in ("line", "line/halo"))
    order, below = (read.last(one, "draw_order").as_py()[0] for one in ("line", "line/halo"))
    assert halo > radius
    assert below < order


def test_a_path_costs_its_pixels_and_its_steps(found):
    detection, _ = found
    node, link = path_costs(detection)
    assert link[0] == 0
    assert node.sum() + link.sum() == pytest.approx(detection.path_cost, rel=1e-5)


def test_series_add_up_to_what_the_truth_pays_more_than_the_path(found, tmp_path):
    detection, truth = found
    wrong = sv.Skyline(truth.rows + 20, truth.visible)
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        log_series(recording, detection, detection.margins(), wrong)
    read = Read(tmp_path / "a.rrd")

    def series(name):
        return read.on(entities.COLUMN, f"{entities.SERIES}/{name}", "scalars")

    parent = f"{entities.SERIES}/apart/"
    terms = [one.removeprefix(parent) for one in read.entities() if one.startswith(parent)]
    assert {"no_edge", "all"} <= set(terms)
    for column in (0, 30, 119):
        parts = [series(f"apart/{name}")[column][0] for name in terms if name != "all"]
        assert sum(parts) == pytest.approx(series("apart/all")[column][0], abs=1e-5)
        off = abs(wrong.rows[column] - detection.skyline.rows[column])
        assert series("error")[column][0] == pytest.approx(off)
    assert 60 not in series("error")
    assert 60 not in series("apart/all")
    assert sorted(series("path/node")) == list(range(120))


@pytest.mark.parametrize("known", [True, False])
def test_errors_are_plotted_and_striped_where_there_is_a_truth(found, known, tmp_path):
    detection, truth = found
    rows = truth.rows.copy()
    rows[20:40] += 20
    wrong = sv.Skyline(rows, truth.visible)
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        log_columns(
            recording, lambda one: one, detection, detection.margins(), wrong if known else None
        )
    read = Read(tmp_path / "a.rrd")
    strip = read.classes(entities.STRIP)[-1]
    labels = read.labels(entities.STRIP)
    assert (read.classes(entities.STRIP)[: len(detection.photo) // 2] == 0).all()
    if not known:
        assert "margin" in labels[1]
        assert strip.min() >= 1
        return
    assert labels[int(strip[25])] == f"error over {STRIP_ERRORS[-1]:g} px"
    assert labels[int(strip[90])] == f"error up to {STRIP_ERRORS[0]:g} px"
    assert strip[60] == 0  # where the truth cannot be seen
