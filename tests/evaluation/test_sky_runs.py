"""Sky models from whole data sets."""

from typing import ClassVar

import numpy as np
import pytest

from skyline_viz.datasets.item import LoadedItem
from skyline_viz.evaluation.sky_runs import learn_sky
from skyline_viz.photo import PhotoError
from skyline_viz.running.batch import working_on
from skyline_viz.running.clusters.connecting import cluster_at
from skyline_viz.skyline import Skyline
from testing.deep import needs_deep
from testing.networks import bright_model

pytestmark = needs_deep


@pytest.fixture(scope="module")
def two():
    with cluster_at("local:2") as cluster:
        yield cluster


class Broken(LoadedItem):
    """A photo that cannot be read."""

    def photo(self):
        raise PhotoError("it is torn.")


def item(name, row=30, kind=LoadedItem, rows=30):
    photo = np.full((60, 90, 3), 200, np.uint8)
    photo[rows:] = 60
    return kind(name, photo, None if row is None else Skyline(np.full(90, row, np.float32)))


def test_a_model_names_its_data_sets_and_the_photos_that_failed():
    datasets = {"hills": [item("a"), item("b", kind=Broken)], "sea": [item("c")]}
    model, failures = learn_sky(datasets, steps=1)
    assert (model.name, model.learned_from) == ("small.onnx", "hills, sea")
    assert [one.name for one in failures] == ["b"]
    assert model.sky(item("a").photo()).shape == (96, 64)


def test_photos_without_a_truth_need_a_teacher():
    with pytest.raises(ValueError, match="at least one photo"):
        learn_sky({"bare": [item("a", None)]}, steps=1)
    model, failures = learn_sky({"bare": [item("a", None)]}, steps=1, teacher=bright_model())
    assert (model.learned_from, failures) == ("bare", [])


def test_the_first_failure_is_said_when_nothing_is_left():
    with pytest.raises(ValueError, match="the first one failed: b: it is torn"):
        learn_sky({"hills": [item("b", kind=Broken)]}, steps=1)


def test_one_process_and_a_cluster_learn_the_same_model(two):
    bare = [item(f"s{row}", None, rows=row) for row in (20, 40)]
    datasets = {"hills": [item("a"), item("b", kind=Broken), item("c", 31)], "sea": bare}
    here = learn_sky(datasets, steps=2, teacher=bright_model())
    there = learn_sky(datasets, steps=2, teacher=bright_model(), reading=working_on(two))
    assert there == here
    assert here[0].photos_learned == {"hills": 2, "sea": 2}


class Watched(LoadedItem):
    """A photo that tells when it is looked at."""

    seen: ClassVar[list[str]] = []

    def truth(self):
        self.seen.append(self.name)
        return super().truth()


def test_photos_that_cannot_all_be_drawn_are_not_read(monkeypatch):
    monkeypatch.setattr(Watched, "seen", [])
    datasets = {
        "few": [item(f"f{number}", kind=Watched) for number in range(4)],
        "many": [item(f"m{number}", kind=Watched) for number in range(36)],
    }
    model, _ = learn_sky(datasets, steps=1)  # which sees 16
    assert model.photos_learned == {"few": 4, "many": 12}
    assert len(Watched.seen) == len({*Watched.seen}) == 16
    first, Watched.seen[:] = [*Watched.seen], []
    learn_sky(datasets, steps=1)
    assert Watched.seen == first
    learn_sky(datasets, steps=1, seed=1)
    assert Watched.seen[16:] != first
