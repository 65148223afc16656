"""The live wire against a whole search under the same constraints."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from annotate.engine.edits import ORIGINS, EditError, Edits
from annotate.engine.live_wire import LiveWire
from skyline_viz.config import DetectorConfig
from skyline_viz.constraints import Anchor, Constraints, PathError
from skyline_viz.detector import Detector
from skyline_viz.path import path_tables, shortest_path
from testing.detections import unseen
from testing.examples import examples

DETECTOR = Detector()
CONFIG = DETECTOR.config


def hills(seed, height=48, width=70):
    random = np.random.default_rng(seed)
    photo = np.full((height, width, 3), 210, np.uint8)
    for top, grey in ((14, 150), (30, 70)):
        line = top + 6 * np.sin(np.arange(width) / random.uniform(5, 15) + random.uniform(0, 6))
        photo[np.arange(height)[:, None] >= line] = grey
    noise = random.normal(0, 6, photo.shape)
    return np.clip(photo + noise, 0, 255).astype(np.uint8)


def costs_of(wire):
    """``(H, W)`` nodal costs as they are after what was done."""
    return wire._tables.costs_for(wire._plan)


def searched(wire):
    """The path by one whole search."""
    cost = costs_of(wire)
    anchors = tuple(Anchor(column, row) for column, row in wire.edits.anchors.items())
    return shortest_path(cost, CONFIG.delta, CONFIG.link_weight, Constraints(anchors))


def cost_of(rows, cost):
    link = CONFIG.link_weight * np.abs(np.diff(rows.astype(int))).sum()
    return cost[rows.astype(int), np.arange(len(rows))].sum(dtype=np.float64) + link


@pytest.fixture
def photo():
    return hills(3)


def test_the_proposal_is_the_detection(photo):
    detection = DETECTOR.detect(photo)
    wire = LiveWire(photo, DETECTOR)
    assert np.array_equal(wire.skyline.rows, detection.skyline.rows)
    np.testing.assert_allclose(wire.margin, detection.margins(), atol=1e-6)
    assert set(wire.origin) == {ORIGINS.index("proposal")}


@examples(60)
@given(st.data())
def test_every_line_is_the_cheapest_under_its_anchors(data):
    photo = hills(data.draw(st.integers(0, 4)))
    height, width = photo.shape[:2]
    wire = LiveWire(photo, DETECTOR)
    history = [wire.edits]
    for _ in range(data.draw(st.integers(1, 8))):
        column = data.draw(st.integers(0, width - 1))
        what = data.draw(st.sampled_from(["anchor", "preview", "remove", "undo"]))
        if what == "undo":
            wire.edits = history[-1]
            continue
        if what == "remove" and wire.edits.anchors:
            history.append(wire.edits)
            wire.edits = wire.edits.remove(data.draw(st.sampled_from(list(wire.edits.anchors))))
            continue
        near = [row for at, row in wire.edits.anchors.items() if abs(at - column) * 4 < height]
        low = max([0, *(row - 8 for row in near)])
        high = min([height - 1, *(row + 8 for row in near)])
        if low > high:
            continue
        row = data.draw(st.integers(low, high))
        before = wire.skyline
        shown = wire.preview(column, row)
        assert wire.skyline == before
        if what == "anchor":
            history.append(wire.edits)
            assert wire.anchor(column, row) == shown
            assert wire.skyline.rows[column] == row
    anchors = sorted(wire.edits.anchors.items())
    steep = [abs(b[1] - a[1]) > CONFIG.delta * (b[0] - a[0]) for a, b in pairwise(anchors)]
    if not any(steep):
        path = searched(wire)
        assert cost_of(wire.skyline.rows, costs_of(wire)) == pytest.approx(path.cost, abs=1e-4)


def test_an_anchor_is_local(photo):
    wire = LiveWire(photo, DETECTOR)
    for column in (10, 35, 60):
        wire.anchor(column, int(wire.skyline.rows[column]))
    before = wire.skyline.rows.copy()
    wire.anchor(47, int(before[47]) + 5)
    changed = np.flatnonzero(wire.skyline.rows != before)
    assert 47 in changed
    assert 35 < changed.min() <= changed.max() < 60


def test_margins_follow_the_anchors(photo):
    wire = LiveWire(photo, DETECTOR)
    wire.anchor(20, 31)
    wire.anchor(50, int(wire.skyline.rows[50]))
    anchors = Constraints((Anchor(20, 31), Anchor(50, wire.edits.anchors[50])))
    tables = path_tables(costs_of(wire), CONFIG.delta, CONFIG.link_weight, anchors)
    through = tables.min_marginals
    best = through.argmin(axis=0)
    far = np.abs(np.arange(len(through))[:, None] - best) > 5
    expected = np.where(far, through, np.inf).min(axis=0) - through.min(axis=0)
    np.testing.assert_allclose(wire.margin, expected, atol=1e-5)
    assert np.isinf(wire.margin[[20, 50]]).all()


def test_a_cliff_is_straight(photo):
    wire = LiveWire(photo, DETECTOR)
    wire.anchor(30, 5)
    wire.anchor(32, 45)
    rows = wire.skyline.rows
    assert rows[[30, 31, 32]].tolist() == [5, 25, 45]
    assert ORIGINS[wire.origin[31]] == "straight"
    assert wire.preview(31, 40).rows[31] == 40


def test_the_brush_keeps_the_line_out(photo):
    wire = LiveWire(photo, DETECTOR)
    row = int(wire.skyline.rows[35])
    wire.forbid([(30, row), (40, row)], 3)
    assert (np.abs(wire.skyline.rows[30:41] - row) > 3).all()
    assert all((np.abs(one.rows[30:41] - row) > 3).all() for one in wire.alternatives())
    wire.forbid([(30, row), (40, row)], 6, allow=True)
    assert wire.skyline == LiveWire(photo, DETECTOR).skyline


def test_a_wall_is_refused_and_changes_nothing(photo):
    wire = LiveWire(photo, DETECTOR)
    before = wire.skyline
    with pytest.raises(PathError, match="past what is forbidden"):
        wire.forbid([(35, 0), (35, 47)], 4)
    assert wire.skyline == before
    assert wire.edits.strokes == ()
    assert wire.anchor(35, 10).rows[35] == 10


def test_spans_are_what_was_asked_for(photo):
    wire = LiveWire(photo, DETECTOR)
    wire.anchor(14, 20)
    wire.straight(20, 40, 10, 20)
    assert wire.skyline.rows[10:21].tolist() == list(range(20, 41, 2))
    assert 14 not in wire.edits.anchors
    wire.draw(40, [5, 25, 5])
    assert wire.skyline.rows[40:43].tolist() == [5, 25, 5]
    assert [ORIGINS[wire.origin[column]] for column in (15, 41)] == ["straight", "drawn"]
    assert np.abs(np.diff(wire.skyline.rows[20:41])).max() <= CONFIG.delta
    wire.anchor(15, 21)  # takes the place of the straight span
    assert wire.skyline.rows[15] == 21
    assert [span.kind for span in wire.edits.spans] == ["drawn"]


def test_hidden_columns_are_not_visible(photo):
    wire = LiveWire(photo, DETECTOR)
    wire.hide(5, 20)
    wire.hide(10, 12, hidden=False)
    visible = wire.skyline.visible
    assert np.flatnonzero(~visible).tolist() == [*range(5, 10), *range(13, 21)]
    assert wire.skyline.rows.tolist() == LiveWire(photo, DETECTOR).skyline.rows.tolist()


def test_releasing_columns_brings_the_proposal_back(photo):
    wire = LiveWire(photo, DETECTOR)
    proposal = wire.skyline
    wire.anchor(12, 44)
    wire.draw(30, [3] * 10)
    wire.forbid([(50, 30)], 4)
    wire.hide(0, 3)
    wire.edits = wire.edits.release(0, 69)
    assert wire.skyline == proposal


def test_dragging_lifts_the_anchor(photo):
    wire = LiveWire(photo, DETECTOR)
    proposal = wire.skyline.rows
    wire.anchor(35, 44)
    row = int(proposal[50])
    lifted = wire.preview(50, row, lifted=35)
    np.testing.assert_array_equal(lifted.rows, proposal)
    assert wire.skyline.rows[35] == 44
    wire.edits = wire.edits.move(35, 50, row)
    np.testing.assert_array_equal(wire.skyline.rows, proposal)


def test_blind_labels_are_straight_lines(photo):
    wire = LiveWire(photo, None)
    assert wire.empty
    with pytest.raises(PathError, match="nothing has been drawn"):
        _ = wire.skyline
    assert wire.alternatives() == []
    wire.anchor(10, 20)
    assert set(wire.skyline.rows) == {20}
    wire.anchor(20, 40)
    assert wire.skyline.rows[[0, 15, 60]].tolist() == [20, 30, 40]
    wire.edits = wire.edits.remove(10).remove(20)
    assert wire.empty


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda wire: wire.anchor(70, 3), "lies outside the photo of 70x48"),
        (lambda wire: wire.anchor(3, -1), "lies outside"),
        (lambda wire: wire.straight(3, 3, 3, 9), "different columns"),
        (lambda wire: wire.draw(3, []), "at least one column"),
        (lambda wire: wire.draw(65, [4] * 6), "lies outside"),
        (lambda wire: wire.forbid([], 3), "at least one point"),
        (lambda wire: wire.forbid([(200, 3)], 3), "outside the photo"),
        (lambda wire: wire.hide(80, 90), "outside the photo"),
        (lambda wire: wire.guide([(200, 3), (300, 3)]), "outside the photo"),
        (lambda wire: wire.guide([]), "at least one point"),
        (lambda wire: wire.guide([(3, 3)], 0), "a radius of 1 or more"),
        (lambda wire: wire.guide([(3, 3)], 2, [1, 2]), "a time for each of its points"),
        (lambda wire: wire.preview(3, 3, lifted=9), "no anchor in column 9"),
    ],
)
def test_edits_that_make_no_sense_are_one_sentence(photo, ask, sentence):
    wire = LiveWire(photo, DETECTOR)
    with pytest.raises(EditError, match=sentence) as refused:
        ask(wire)
    assert str(refused.value).endswith(".")
    assert wire.edits == Edits(48, 70)


def test_alternatives_keep_to_what_was_asked_for(photo):
    wire = LiveWire(photo, DETECTOR)
    wire.draw(10, [3, 40, 3])
    wire.anchor(60, int(wire.skyline.rows[60]))
    found = wire.alternatives()
    assert found
    for one in found:
        assert one.rows[10:13].tolist() == [3, 40, 3]
        assert one.rows[60] == wire.skyline.rows[60]
        cost = DETECTOR.detect(photo).cost
        dearer = cost_of(one.rows, cost) - cost_of(wire.skyline.rows, cost)
        assert one.detour == pytest.approx(dearer, abs=1e-3)


def test_what_the_detector_doubts_is_a_word_and_hides_nothing(photo):
    wire = LiveWire(photo, unseen())
    assert wire.doubt == unseen().detect(photo).visibility.doubt
    assert wire.skyline.visible.all()
    assert wire.anchor(30, 20).visible.all()
    assert LiveWire(photo, None).doubt == ""
    assert LiveWire(photo, Detector(config=DetectorConfig.paper())).doubt == ""


def test_a_guide_leads_the_line_to_another_ridge(photo):
    wire = LiveWire(photo, DETECTOR)
    upper = wire.skyline
    lower = upper.rows.max() + 14
    rough = [(5, lower + 3), (35, lower - 3), (60, lower + 2)]
    shown = wire.preview_guide(rough, 6)
    assert wire.skyline == upper
    assert wire.guide(rough, 6) == shown
    inside = slice(5, 61)
    stroke = np.interp(np.arange(5, 61), *zip(*rough, strict=True))
    assert (np.abs(shown.rows[inside] - stroke) <= 7).all()
    again = LiveWire(photo, DETECTOR)
    again.edits = wire.edits
    assert again.skyline == shown
    wire.edits = wire.edits.release(0, 69)
    assert wire.skyline == upper


@examples(60)
@given(st.data())
def test_a_guided_line_is_the_cheapest_in_its_corridor(data):
    photo = hills(data.draw(st.integers(0, 4)))
    height, width = photo.shape[:2]
    cost = DETECTOR.detect(photo).cost
    wire = LiveWire(photo, DETECTOR)
    forbidden = np.zeros(cost.shape, np.bool_)
    for _ in range(data.draw(st.integers(1, 3))):
        ends = st.tuples(st.integers(0, width - 1), st.integers(8, height - 9))
        points = data.draw(st.lists(ends, min_size=2, max_size=4))
        try:
            wire.guide(points, data.draw(st.integers(3, 9)))
        except PathError:
            assert wire.edits.strokes  # of a guide before it: the two cannot be joined
            continue
        guide = wire.edits.strokes[-1]
        tops, bottoms = guide.bounds(CONFIG.delta)
        rows = np.arange(height)[:, None]
        forbidden[:, guide.first : guide.last + 1] = (rows < tops) | (rows > bottoms)
    path = shortest_path(cost, CONFIG.delta, CONFIG.link_weight, Constraints(forbidden=forbidden))
    assert cost_of(wire.skyline.rows, cost) == pytest.approx(path.cost, abs=1e-4)


def test_a_guide_takes_the_place_of_what_was_asked_for_before(photo):
    wire = LiveWire(photo, DETECTOR)
    wire.anchor(30, 5)
    wire.anchor(69, 20)
    wire.draw(38, [44] * 20)
    wire.forbid([(24, 30), (34, 30)], 8)
    wire.guide([(20, 30), (45, 30)], 4)
    assert dict(wire.edits.anchors) == {69: 20}
    assert [(one.first, one.last) for one in wire.edits.spans] == [(54, 57)]
    assert (np.abs(wire.skyline.rows[20:46] - 30) <= 4).all()
    assert wire.skyline.rows[69] == 20


@pytest.mark.parametrize("row", [3, 44])
def test_a_click_wins_over_a_guide_and_over_the_brush(photo, row):
    wire = LiveWire(photo, DETECTOR)
    wire.forbid([(0, row), (69, row)], 5)
    painted = wire.skyline
    shown = wire.preview(35, row)
    assert wire.anchor(35, row) == shown
    assert shown.rows[35] == row
    assert abs(shown.rows[2] - row) > 5
    wire.edits = wire.edits.remove(35)
    assert wire.skyline == painted
    wire.guide([(10, 24), (60, 24)], 4)
    guided = wire.skyline
    for off in (33, row):
        assert wire.anchor(35, off).rows[35] == off
        assert off == row or np.abs(wire.skyline.rows[10] - 24) <= 4  # far from what is cleared
    wire.edits = wire.edits.remove(35)
    assert wire.skyline == guided


def test_a_guide_that_cannot_be_joined_is_refused(photo):
    wire = LiveWire(photo, DETECTOR)
    before = wire.anchor(30, 5)
    with pytest.raises(PathError, match="from the guide to what is fixed beside it"):
        wire.guide([(31, 44), (50, 44)], 3)
    assert wire.skyline == before
    blind = LiveWire(photo, None)
    for ask in (blind.guide, blind.preview_guide):
        with pytest.raises(PathError, match="labelled blind"):
            ask([(3, 4), (9, 4)])
    assert blind.edits == Edits(48, 70)
