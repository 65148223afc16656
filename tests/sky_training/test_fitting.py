"""What a sky model is judged by, and that it learns."""

from contextlib import closing

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.sky_training import example_file
from skyline_viz.sky_training.choosing import Part
from skyline_viz.sky_training.sizes import Size
from skyline_viz.storage.copies import CACHE
from testing.deep import kept, lineless, needs_deep, sky_examples
from testing.examples import examples

pytestmark = needs_deep

SMALL = Size(64, 32, (8, 12, 16, 16, 16), 1)


@pytest.fixture
def fitting():
    pytest.importorskip("torch")
    from skyline_viz.sky_training import fitting  # noqa: PLC0415

    return fitting


def column(sky):
    import torch  # noqa: PLC0415

    return torch.tensor(sky, dtype=torch.float32).view(1, 1, -1, 1)


def test_the_right_row_is_judged_best(fitting):
    sky = column([1, 1, 1, 0, 0, 0])
    losses = [
        float(fitting.judged(column([4.0] * row + [-4.0] * (6 - row)), sky)) for row in range(7)
    ]
    assert int(np.argmin(losses)) == 3
    assert losses[3] < losses[2] < losses[1] < losses[0]


def test_a_second_ridge_costs_more_than_its_regions(fitting):
    """Wrong regions that move the line are worse than as many that do not."""
    sky = column([1.0] * 6 + [0.0] * 6)
    moved = column([4.0] * 3 + [-4.0] * 9)  # three regions of sky called terrain, at the line
    spread = column([4.0, -4.0] * 3 + [-4.0] * 6)
    assert float(fitting.judged(moved, sky)) > float(fitting.judged(spread, sky))


def test_a_photo_without_a_line_is_judged_region_by_region(fitting):
    import torch  # noqa: PLC0415

    sky = column([0, 1, 1, 0, 1, 0])
    logits = column([-2.0, 2.0, 1.0, -1.0, 3.0, 0.5])
    alone = torch.nn.functional.binary_cross_entropy_with_logits(logits, sky)
    assert float(fitting.judged(logits, sky)) == pytest.approx(float(alone))


def test_a_large_data_set_counts_for_more_but_not_for_all(fitting):
    share = fitting.shares(["few"] * 4 + ["many"] * 16, {})
    assert share.sum() == pytest.approx(1)
    assert share[4:].sum() == pytest.approx(2 * share[:4].sum())


def test_a_data_set_is_drawn_as_often_when_a_part_of_it_is_read(fitting):
    sources = ["few"] * 4 + ["many"] * 5
    share = fitting.shares(sources, {"few": Part(4, 4), "many": Part(10, 32)})
    whole = fitting.shares(["few"] * 4 + ["many"] * 16, {})  # half of those that are read fail
    assert share[4:].sum() == pytest.approx(whole[4:].sum())


@examples(20)
@given(st.lists(st.floats(0.01, 1), min_size=1, max_size=300), st.integers(0, 99))
def test_what_is_drawn_is_what_numpy_would_choose(weights, seed):
    fitting = pytest.importorskip("skyline_viz.sky_training.fitting", exc_type=ImportError)
    share = np.array(weights) / np.sum(weights)
    upto = share.cumsum()
    upto /= upto[-1]
    one, same = (np.random.default_rng(seed) for _ in range(2))
    for count in (16, 6, 1):
        assert fitting.drawn(upto, count, one) == same.choice(len(share), count, p=share).tolist()


def test_a_list_and_a_file_give_the_same_network(fitting, monkeypatch, tmp_path):
    monkeypatch.setenv(CACHE, str(tmp_path))
    monkeypatch.setattr(example_file, "IN_MEMORY", 0)
    known = [*sky_examples(5), lineless(), *sky_examples(3, "sea")]
    sources = [one.source for one in known]
    with closing(kept(known)) as file:
        nets = [
            fitting.fit(one, sources, SMALL, steps=2, seed=3).state_dict() for one in (known, file)
        ]
    assert all(bool((nets[0][name] == nets[1][name]).all()) for name in nets[0])


def test_no_example_is_looked_at_before_it_is_drawn(fitting):
    looked = set()

    class Watched(list):
        def __getitem__(self, place):
            looked.add(place)
            return super().__getitem__(0)

        def __iter__(self):
            raise AssertionError("all are looked at")

    many = Watched(sky_examples(1) * 10_000)
    fitting.fit(many, ["hills"] * len(many), SMALL, steps=1)
    assert 0 < len(looked) <= 16 * 7  # photos of a step, each with six to put together
