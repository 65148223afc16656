"""How far passes agree, in figures."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from annotate.agreement.figures import Agreement, by_making, kappa, lean, people
from annotate.agreement.pairs import Pair, compared
from testing.examples import examples
from testing.labels import made


def test_photos_count_alike_whatever_their_width():
    narrow = Pair.of(made([0] * 10), made([4] * 10, "bob"))
    wide = Pair.of(made([0] * 1000, digest="bb"), made([0] * 1000, "bob", digest="bb"))
    found = Agreement.of([narrow, wide])
    assert (found.photos, found.columns, found.mean, found.worst) == (2, 1010, 2.0, 4.0)
    assert found.within[1:] == (1000 / 1010, 1.0)
    assert found.interval == (0.0, 4.0)


def test_without_a_column_to_compare_there_are_no_figures():
    hidden = np.zeros(9, bool)
    assert Agreement.of([Pair.of(made([0] * 9, visible=hidden), made([4] * 9, "bob"))]) is None
    assert Agreement.of([]) is None


cells = st.integers(0, 4000)


@examples(200)
@given(st.tuples(cells, cells, cells, cells))
def test_kappa_is_at_most_1_and_does_not_ask_who_is_first(counts):
    seen = np.array(counts, np.int32).reshape(2, 2)
    found = kappa(seen)
    assert found == kappa(seen.T)
    if found is not None:
        assert -1 <= found <= 1
        assert (found == 1) == (seen[0, 1] == seen[1, 0] == 0)


def test_kappa_of_a_textbook():
    assert kappa(np.array([[20, 5], [10, 15]])) == pytest.approx(0.4)


@pytest.mark.parametrize("seen", [[[0, 0], [0, 9]], [[9, 0], [0, 0]], [[0, 0], [0, 0]]])
def test_where_nobody_hides_anything_there_is_no_kappa(seen):
    assert kappa(np.array(seen)) is None


def test_a_person_with_himself_stands_beside_that_person_with_others():
    labels = [made([10] * 9), made([11] * 9, number=2), made([14] * 9, "bob")]
    found = people(compared(labels, [("ann", 1), ("ann", 2), ("bob", 1)]))
    assert [(one.name, one.alone and one.alone.mean, one.others.mean) for one in found] == [
        ("ann", 1.0, 3.5),
        ("bob", None, 3.5),
    ]


def test_blind_labels_are_told_apart_and_the_lean_of_proposals_has_a_sign():
    labels = []
    for digest, rows in (("aa", 12), ("bb", 14)):
        labels.append(made([10] * 9, digest=digest, blind=True))
        labels.append(made([rows] * 9, "bob", digest=digest))
    labels += [made([5] * 9, digest="cc"), made([5] * 9, "bob", digest="cc")]
    found = compared(labels, [("ann", 1), ("bob", 1)])
    made_so = by_making(found)
    assert {kind: one.mean for kind, one in made_so.items()} == {
        "both proposed": 0.0,
        "one blind": 3.0,
    }
    assert lean(found) == (3.0, (2.0, 4.0))  # ann's blind lines lie above
    turned = compared(labels, [("bob", 1), ("ann", 1)])
    assert lean(turned) == (3.0, (2.0, 4.0))
    assert lean(compared(labels[-2:], [("ann", 1), ("bob", 1)])) is None
