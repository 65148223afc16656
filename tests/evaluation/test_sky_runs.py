"""Sky models from whole data sets."""

import numpy as np
import pytest

from skyline_viz.datasets.item import LoadedItem
from skyline_viz.evaluation.sky_runs import learn_sky
from skyline_viz.photo import PhotoError
from skyline_viz.skyline import Skyline
from testing.deep import needs_deep
from testing.networks import bright_model

pytestmark = needs_deep


class Broken(LoadedItem):
    """A photo that cannot be read."""

    def photo(self):
        raise PhotoError("it is torn.")


def item(name, row=30, kind=LoadedItem):
    photo = np.full((60, 90, 3), 200, np.uint8)
    photo[30:] = 60
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
