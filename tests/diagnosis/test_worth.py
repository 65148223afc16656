"""Other settings by what they are worth."""

from skyline_viz.diagnosis.diagnosing import Diagnosis
from skyline_viz.diagnosis.record import Diagnosed
from skyline_viz.diagnosis.remedies import Remedy
from skyline_viz.diagnosis.worth import waits, worth_trying, worths


def photo(name, gross, *tried):
    remedies = tuple(Remedy(words, "", 1, 2, 0.0, change, now) for words, change, now in tried)
    return Diagnosed(name, 9.0, gross, 10, Diagnosis((), 4.0), remedies)


def test_the_mean_over_all_photos_ranks_and_gross_misses_are_counted():
    found = [
        photo("a", True, ("more", -8.0, False), ("less", -1.0, True), ("none", 1.0, True)),
        photo("b", False, ("more", 2.0, True), ("less", -4.0, False), ("none", -1.0, False)),
    ]
    told = [(one.name, one.change, one.saved, one.lost) for one in worths(found)]
    assert told == [("more", -3.0, 1, 1), ("less", -2.5, 0, 0), ("none", 0.0, 0, 0)]
    assert (worths(found)[0].repaired, worths(found)[0].broken) == (2, 4)


def test_of_equal_errors_that_with_fewer_gross_misses_comes_first():
    found = [photo("a", True, ("a", -2.0, True), ("b", -2.0, False))]
    assert [one.name for one in worths(found)] == ["b", "a"]


def test_nothing_tried_is_nothing_worth():
    assert worths([photo("a", True)]) == []


def test_photos_wait_that_are_right_but_for_blips():
    right = Diagnosis((), 4.0)
    assert waits(1.0, right)
    assert not waits(1.1, right)


def test_worth_trying_is_what_helps_all_wrong_photos_or_mends_a_gross_miss():
    found = [
        photo("a", True, ("more", -0.2, True), ("less", 9.0, False), ("none", -0.001, True)),
        photo("b", False, ("more", 0.1, False), ("less", 4.0, False), ("none", 0.0, False)),
    ]
    assert worth_trying(found) == {"more", "less"}
    assert worth_trying([]) == frozenset()
