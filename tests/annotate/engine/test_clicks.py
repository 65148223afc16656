"""What a click leaves behind: the line follows another ridge instead of making a tent."""

from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from annotate.engine.edits import Edits
from annotate.engine.live_wire import LiveWire
from annotate.engine.steering import Left
from skyline_viz.constraints import PathError
from testing.examples import examples
from testing.labelling import DETECTOR, hills


def lefts(wire):
    return [one for one in wire.edits.strokes if isinstance(one, Left)]


@pytest.fixture
def wire():
    return LiveWire(hills(1, 90, 240), DETECTOR)


@pytest.fixture
def lower(wire):
    """Rows of the other ridge."""
    other = LiveWire(hills(1, 90, 240), DETECTOR)
    rows = other.skyline.rows.astype(int)
    other.forbid([(at, int(row)) for at, row in enumerate(rows)], 4)
    assert (np.abs(other.skyline.rows - rows) > 8).mean() > 0.9
    return other.skyline.rows.astype(int)


def test_a_click_on_another_ridge_follows_it(wire, lower):
    upper = wire.skyline
    tent = LiveWire(hills(1, 90, 240), DETECTOR)
    tent.edits = tent.edits.anchor(120, int(lower[120]))
    line = wire.anchor(120, int(lower[120]))
    followed = np.abs(line.rows - lower) <= 2
    assert followed[120]
    assert followed.sum() >= 40
    assert (np.abs(tent.skyline.rows - lower) <= 2).sum() < followed.sum()
    assert (line.rows[:30] == upper.rows[:30]).all()  # a quarter of the photo away, nothing changes


def test_what_was_left_goes_with_its_anchor(wire, lower):
    before = wire.skyline
    wire.anchor(120, int(lower[120]))
    assert [one.of for one in lefts(wire)] == [120]
    row, left = wire.clicked(121, int(lower[121]), lifted=120)
    shown = wire.preview(121, int(lower[121]), lifted=120)
    wire.edits = wire.edits.move(120, 121, row, left)
    assert [one.of for one in lefts(wire)] == [121]
    assert wire.skyline == shown
    assert (np.abs(shown.rows - lower) <= 2).sum() >= 40
    wire.edits = wire.edits.remove(121)
    assert wire.edits == Edits(90, 240)
    assert wire.skyline == before


def test_a_guide_over_the_click_takes_its_place(wire, lower):
    wire.anchor(120, int(lower[120]))
    wire.guide([(100, 30), (140, 30)], 6)
    assert wire.edits.anchors == {}
    assert lefts(wire) == []


def test_a_click_beside_the_line_leaves_nothing(wire):
    row = int(wire.skyline.rows[60])
    wire.anchor(60, row + 4)
    assert lefts(wire) == []
    assert wire.clicked(-5, row) == (row, None)
    assert LiveWire(hills(1), None).clicked(5, 6, 9) == (6, None)


@examples(40)
@given(st.data())
def test_a_click_is_its_preview_passes_its_pixel_and_is_undone_exactly(data):
    wire = LiveWire(hills(data.draw(st.integers(0, 3))), DETECTOR)
    for _ in range(data.draw(st.integers(1, 5))):
        before, edits = wire.skyline, wire.edits
        column = data.draw(st.integers(0, wire.width - 1))
        row = data.draw(st.integers(0, wire.height - 1))
        if data.draw(st.booleans()):
            with suppress(PathError):
                wire.forbid([(column, row), (column + 9, row)], 4)
            before, edits = wire.skyline, wire.edits
        within = data.draw(st.sampled_from([0, 0, 3]))
        shown = wire.preview(column, row, within=within)
        assert wire.skyline == before
        line = wire.anchor(column, row, within)
        assert line == shown
        assert abs(int(line.rows[column]) - row) <= within
        after = wire.edits
        wire.edits = edits
        assert wire.skyline == before
        wire.edits = after
        assert wire.skyline == line


@pytest.mark.parametrize("off", [-4, -2, 0, 3])
def test_an_anchor_snaps_to_the_ridge(wire, lower, off):
    aim = int(lower[120]) + off
    assert abs(wire.clicked(120, aim, within=6)[0] - lower[120]) <= 1
    assert wire.clicked(120, aim)[0] == aim
