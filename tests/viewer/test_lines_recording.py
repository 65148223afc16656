"""The best other lines in a recording."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.certainty.other_lines import other_lines
from skyline_viz.viewer import entities
from skyline_viz.viewer.lines_recording import log_lines
from testing.labelling import hills
from testing.recordings import Read, drawn_rows

PHOTO = hills(3, 120, 160)
TRUTH = sv.Skyline(np.full(160, 50.0))


@pytest.fixture(scope="module")
def logged(tmp_path_factory):
    detection = sv.Detector().detect(PHOTO)
    rows = detection.skyline.rows.astype(np.int32)
    lines = other_lines(detection.cost, detection.delta, detection.link_weight, rows)
    file = tmp_path_factory.mktemp("lines") / "a.rrd"
    with sv.new_recording(file, "a") as recording:
        log_lines(recording, detection, lines, TRUTH)
    return detection, lines, Read(file)


def test_each_line_is_drawn_and_numbered_where_it_is(logged):
    _, lines, read = logged
    assert lines
    for number, line in enumerate(lines, 1):
        entity = f"{entities.OTHER_LINES}/{number}"
        drawn = drawn_rows(read.last(entity, "strips").as_py(), 160)
        np.testing.assert_array_equal(drawn, line.rows)
        ((x, y),) = read.last(f"{entity}/number", "positions").as_py()
        assert line.rows[int(x)] == y
        assert read.last(f"{entity}/number", "labels").as_py() == [f"{number}"]


def test_the_table_has_what_each_pays_and_its_error(logged):
    detection, lines, read = logged
    (text,) = read.last(entities.OTHER_LINES_TABLE, "text").as_py()
    rows = [line.split(" | ") for line in text.splitlines() if line.startswith("| ")]
    head = [cell.strip("| ") for cell in rows[0]]
    assert head[:4] == ["line", "A_err (px)", "dearer by", "elsewhere"]
    assert len(rows) == 3 + len(lines)
    for line, row in zip(lines, rows[3:], strict=True):
        told = dict(zip(head, (cell.strip("| ") for cell in row), strict=True))
        assert float(told["dearer by"]) == pytest.approx(line.detour, abs=0.06)
        assert float(told["A_err (px)"]) == pytest.approx(np.abs(line.rows - 50).mean(), abs=0.01)
        paid = line.paid(detection.cost_model)
        for term in head[4:]:
            assert float(told[term]) == pytest.approx(paid[term], abs=0.06)


def test_without_another_line_that_is_said(tmp_path):
    detection = sv.Detector().detect(PHOTO)
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        log_lines(recording, detection, [], None)
    (text,) = Read(tmp_path / "a.rrd").last(entities.OTHER_LINES_TABLE, "text").as_py()
    assert text.startswith("There is no other line")
