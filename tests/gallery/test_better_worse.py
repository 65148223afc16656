"""Which photos a second detector makes better, and which worse."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.gallery.better_worse import better_worse, outcome, tables
from skyline_viz.gallery.entry import Entry
from testing.examples import examples


def entry(number, first, second, turned_by="sky", height=500):
    verdict = Verdict(first, 0, first, False, (), 1.0, 0)
    compared = {"compared": "paper", "other_a_err": second, "turned_by": turned_by}
    return Entry(f"p{number}", "", "", height, 9, verdict, parts_at="edges, column 3", **compared)


errors = st.floats(0, 200)


@examples(30)
@given(st.lists(st.tuples(errors, errors, st.sampled_from(["sky", "score", ""])), min_size=1))
def test_sums_are_those_of_the_photos(photos):
    entries = [entry(number, *one) for number, one in enumerate(photos)]
    found = better_worse(entries)
    assert found.better + found.worse + found.level == len(entries)
    changes = [second - first for first, second, _ in photos]
    assert found.change == pytest.approx(sum(changes) / len(changes), abs=1e-9)
    assert found.interval.low - 1e-9 <= found.change <= found.interval.high + 1e-9
    assert sum(one.change for one in found.groups) == pytest.approx(sum(changes), abs=1e-6)
    for name in ("better", "worse", "level"):
        assert sum(getattr(one, name) for one in found.groups) == getattr(found, name)
    assert found.better == sum(change < -0.5 for change in changes)


def test_half_a_pixel_is_level_and_more_on_larger_photos():
    assert outcome(entry(0, 1.0, 1.5)) == "level"
    assert outcome(entry(0, 1.0, 1.6)) == "worse"
    assert outcome(entry(0, 1.6, 1.0)) == "better"
    assert outcome(entry(0, 1.0, 1.9, height=1038)) == "level"
    assert outcome(Entry("a", "", "", 9, 9, Verdict(1.0, 0, 1.0, False, (), 1.0, 0))) is None


def test_the_tables_say_who_won_and_name_the_photos():
    entries = [entry(0, 9.0, 1.0), entry(1, 1.0, 30.0, "score"), entry(2, 1.0, 1.0, "")]
    text = tables(entries)
    lines = text.splitlines()
    assert lines[0].startswith("paper against default: won 1, lost 1, level 1; A_err +7.00 px")
    assert any(line.split() == ["sky", "1", "0", "0", "-8.00"] for line in lines)
    assert any(line.split() == ["score", "0", "1", "0", "+29.00"] for line in lines)
    better = next(at for at, line in enumerate(lines) if line.startswith("p0"))
    worse = next(at for at, line in enumerate(lines) if line.startswith("p1"))
    assert better < worse
    assert "edges, column 3" in lines[worse]
    assert not any(line.startswith("p2") for line in lines)


def test_long_lists_are_cut_and_say_so():
    text = tables([entry(number, 1.0, 2.0 + number) for number in range(14)])
    assert text.splitlines()[-1] == "4 more between these."


def test_without_a_truth_there_is_nothing_to_say():
    verdict = Verdict(None, None, None, None, None, 1.0, 0)
    entries = [Entry("a", "", "", 9, 9, verdict, compared="paper", difference=3.0)]
    assert better_worse(entries) is None
    assert tables(entries) == ""
