"""Published figures: that no digit of them is impossible, and every method has its title."""

import pytest

from skyline_viz.evaluation.paper_tables import published
from skyline_viz.methods.names import NAMES

TABLES = {
    "1": [one for rows in published.TABLE_1.values() for one in rows.values()],
    "2": list(published.TABLE_2.values()),
    "3": [one for rows in published.TABLE_3.values() for one in rows.values()],
    "4": list(published.TABLE_4.values()),
    "5": [errors for _, errors in published.TABLE_5.values()],
}


@pytest.mark.parametrize("table", TABLES)
def test_figures_are_possible(table):
    for one in TABLES[table]:
        assert one.mean > 0
        assert one.standard_deviation > 0
        if one.minimum is not None:
            assert one.minimum <= one.mean <= one.maximum
            assert one.standard_deviation <= one.maximum - one.minimum


def test_every_method_has_a_title():
    assert set(published.TITLES) == set(NAMES)
    assert len(set(published.TITLES.values())) == len(published.TITLES)
    for rows in published.TABLE_1.values():
        assert set(rows) <= set(published.TITLES)


def test_the_tables_agree_where_they_tell_the_same():
    errors = published.TABLE_2["Basalt Hills (45)"]
    crossed = published.TABLE_4["CH1", "Basalt Hills (45)"]
    smallest = published.TABLE_3["Basalt Hills (45)"][7]
    assert (errors.mean, errors.standard_deviation) == (crossed.mean, crossed.standard_deviation)
    assert round(smallest.mean, 2) == errors.mean
    assert (smallest.minimum, smallest.maximum) == (errors.minimum, errors.maximum)
    for share, _ in published.TABLE_5.values():
        assert 0.8 < share < 1
