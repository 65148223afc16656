"""Two labels of a photo, and two passes."""

import numpy as np

from annotate.agreement.pairs import Pair, compared, most_apart
from testing.labels import made


def test_only_columns_that_both_see_are_compared():
    pair = Pair.of(made([10] * 20, visible=np.arange(20) < 7), made([12] * 20, "bob"))
    assert pair.differences.tolist() == [2.0] * 7
    assert pair.seen.tolist() == [[0, 13], [0, 7]]


def test_lines_that_nobody_can_compare_are_a_pair_without_figures():
    hidden = np.arange(20) < 10
    pair = Pair.of(made([10] * 20, visible=hidden), made([12] * 20, "bob", visible=~hidden))
    assert np.isnan(pair.mean)
    assert pair.worst == 0
    assert most_apart(compared([pair.first, pair.second], [("ann", 1), ("bob", 1)])) == []


def test_the_span_with_most_between_the_lines_counts_not_the_widest():
    other = np.full(1000, 10)
    other[100:300] += 3
    other[600:640] += 90
    pair = Pair.of(made([10] * 1000), made(other, "bob"))
    assert pair.span(within=1) == (600, 639)
    assert pair.span(within=100) is None


def test_every_pass_is_compared_with_every_other_one():
    labels = [made([10] * 9), made([12] * 9, "bob"), made([11] * 9, number=2)]
    labels += [made([9] * 9, "bob", digest="bb"), made([9] * 9, digest="bb", status="rejected")]
    found = compared(labels, [("ann", 1), ("ann", 2), ("bob", 1)])
    assert [one.name for one in found] == ["ann and ann:2", "ann and bob", "ann:2 and bob"]
    assert [one.of_one for one in found] == [True, False, False]
    assert [[pair.mean for pair in one.pairs] for one in found] == [[1.0], [2.0], [1.0]]
    assert [one.decided_otherwise for one in found] == [0, 1, 0]
    (worst,) = most_apart(found)
    assert worst[1].name == "ann and bob"


def test_labels_that_are_not_decided_are_not_compared():
    labels = [made([10] * 9), made([12] * 9, "bob", status="needs review")]
    (found,) = compared(labels, [("ann", 1), ("bob", 1)])
    assert (found.pairs, found.decided_otherwise) == ((), 0)


def test_how_labels_were_made_is_told_apart():
    proposed, blind = made([10] * 9), made([10] * 9, "bob", blind=True)
    assert Pair.of(proposed, proposed).made == "both proposed"
    assert Pair.of(proposed, blind).made == Pair.of(blind, proposed).made == "one blind"
    assert Pair.of(blind, blind).made == "both blind"
