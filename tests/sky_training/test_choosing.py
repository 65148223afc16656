"""Which photos a sky model learns from: no more than it can see, and some of each data set."""

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.sky_training.choosing import Part, chosen, most_photos, parts
from testing.examples import examples

COUNTS = st.dictionaries(st.text(max_size=3), st.integers(0, 10**7), min_size=1, max_size=6)


@examples(60)
@given(COUNTS, st.integers(1, 10**6))
def test_as_many_photos_are_read_as_can_be_and_some_of_each_data_set(counts, most):
    read = parts(counts, most)
    assert [*read] == [*counts]
    assert all(min(1, part.of) <= part.read <= part.of == counts[n] for n, part in read.items())
    total = sum(part.read for part in read.values())
    if sum(counts.values()) <= most:
        assert all(part.weight == 1 for part in read.values() if part.of)
    elif most >= 100 * len(counts):  # else the one of each may be more than its share
        assert total == most
    assert total <= most + len(counts)
    by_size = sorted(read.values(), key=lambda part: part.of)
    assert all(one.read <= more.read for one, more in pairwise(by_size))


def test_data_sets_share_by_the_square_root_and_what_one_lacks_the_others_have():
    assert parts({"a": 100, "b": 10_000}, 110) == {"a": Part(10, 100), "b": Part(100, 10_000)}
    found = parts({"large": 40_000, "small": 5, "more": 10_000}, 3005)
    assert {name: part.read for name, part in found.items()} == {
        "large": 2000,
        "small": 5,
        "more": 1000,
    }


def test_a_photo_of_many_stands_for_those_that_are_not_read():
    assert Part(10, 25).weight == 2.5


def test_the_seed_chooses_and_the_order_stays():
    datasets = {"few": range(7), "many": range(1000)}
    assert chosen(datasets, 63) == datasets  # all 1007 of at most 1008
    first, same, other = (chosen(datasets, 2, seed) for seed in (1, 1, 2))
    assert first == same != other
    for name, photos in first.items():
        assert [*photos] == sorted({*photos})
        assert {*photos} <= {*datasets[name]}
    assert sum(map(len, first.values())) == most_photos(2)


def test_every_photo_may_be_chosen():
    seen = {photo for seed in range(40) for photo in chosen({"a": range(40)}, 1, seed)["a"]}
    assert seen == {*range(40)}
    assert {type(one) for one in chosen({"a": np.arange(40).tolist()}, 1)["a"]} == {int}
