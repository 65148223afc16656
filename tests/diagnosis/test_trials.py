"""Taking the difference in a term away: how much, and from which lines."""

import numpy as np
import pytest

from skyline_viz.diagnosis.counterfactual import REPAIRED, Case
from skyline_viz.diagnosis.trials import Trials
from testing.detections import WITHOUT_SKY, lines_in_the_sky


@pytest.fixture(scope="module")
def case():
    photo, truth = lines_in_the_sky(1)
    return Case(WITHOUT_SKY.detect(photo), truth, 4.0)


@pytest.fixture
def trials(case):
    wrong = np.flatnonzero(case.errors > 4)
    return Trials(case, (int(wrong[0]), int(wrong[-1])))


def test_the_truth_is_the_dearer_line_by_the_sum_of_its_terms(case, trials):
    first, last = trials.reach
    paid, due = case.paid(case.path_rows), case.due
    for term, costs in trials.dearer.items():
        outside = np.r_[costs[:first], costs[last + 2 :]]
        assert not outside.any()
        off = np.flatnonzero(case.away(case.path_rows))
        np.testing.assert_allclose(costs[off], (due.terms[term] - paid.terms[term])[off])


def test_a_line_pays_what_the_detection_says(case):
    rows = case.path_rows
    assert sum(case.paid(rows).totals(0, len(rows) - 1).values()) == pytest.approx(
        case.detection.path_cost, rel=1e-5
    )


def test_the_truth_is_spared_the_difference_and_no_more(case, trials):
    spared = np.zeros(case.truth.width)
    more = trials._more(case.path_rows, ("strength",), spared)
    assert more.min() >= 0
    assert more.sum() == pytest.approx(trials.dearer["strength"].sum(), abs=0.01)
    assert trials._more(case.path_rows, ("strength",), spared + more) is None


def test_terms_that_do_not_prefer_the_path_are_not_tried_further(case, trials):
    cheaper = next(term for term, costs in trials.dearer.items() if costs.sum() < 0)
    assert trials._equal((cheaper,), ()) == 0
    assert trials.made[-1].lines == 0


def test_the_terms_named_are_all_needed(trials):
    terms = trials.preferring(())
    proof = trials.proof(terms, ())
    assert proof.repaired >= REPAIRED
    for term in terms:
        rest = tuple(other for other in terms if other != term)
        assert not rest or trials._equal(rest, ()) < REPAIRED
    assert trials.proof((), ()) is None
