"""What methods that learn have in common: models that are checked, and what they are shown."""

from dataclasses import dataclass

import numpy as np
import pytest

from skyline_viz.method import LearnedMethod, MethodError, near_truth, shown_to_learners
from skyline_viz.skyline import Skyline


@dataclass(frozen=True)
class Line(LearnedMethod):
    """Learns a line of some length and an offset."""

    def learn(self, items, seed):
        return {"line": np.full(len(items), seed, float), "offset": np.zeros(1)}

    def model_shapes(self):
        return {"line": (None,), "offset": (1,)}


def with_model(**arrays):
    return Line({"line": np.ones(3), "offset": np.zeros(1)} | arrays)


@dataclass(frozen=True)
class Item:
    line: Skyline | None

    def photo(self):
        return "the photo"

    def truth(self):
        return self.line


def test_fitting_makes_another_method_and_sharing_hands_it_on():
    plain = Line(label="line")
    fitted = plain.fit([1, 2], seed=7)
    assert plain.model == {}
    np.testing.assert_array_equal(fitted.part("line"), [7, 7])
    other = Line(label="other").sharing(fitted)
    assert (other.name, other.model) == ("other", fitted.model)
    assert plain.family == Line(label="other").family


def test_without_training_it_says_how_to_train():
    with pytest.raises(MethodError, match="line has learned nothing yet; train it with: skyline"):
        Line(label="line").part("line")
    with pytest.raises(MethodError, match="its slope is missing"):
        with_model().part("slope")


@pytest.mark.parametrize(
    ("arrays", "says"),
    [
        ({"line": np.ones((2, 2))}, r"its line has the shape \(2, 2\)"),
        ({"offset": np.ones(2)}, r"its offset has the shape \(2,\)"),
        ({"line": np.array([1, np.inf])}, "its line holds what is no finite number"),
        ({"line": np.array(["a"])}, "its line holds what is no finite number"),
        ({"offset": None}, "its offset is missing"),
    ],
)
def test_a_model_that_does_not_fit_is_refused(arrays, says):
    model = {name: one for name, one in with_model(**arrays).model.items() if one is not None}
    method = Line(model)
    with pytest.raises(ValueError, match=says):
        method.check_model()
    if "inf" not in str(arrays):  # what it holds is known only when it has been read
        with pytest.raises(ValueError, match=says):
            method.check_announced(model)
    with_model(line=np.ones(9)).check_model()


def test_learners_are_shown_what_has_a_truth():
    line = Skyline([1, 2])
    shown = list(shown_to_learners([Item(line), Item(None), Item(line)]))
    assert shown == [("the photo", line)] * 2
    with pytest.raises(ValueError, match="at least one photo with a true skyline"):
        shown_to_learners([Item(None)])


def test_pixels_near_the_truth_and_in_hidden_columns():
    near = near_truth((8, 3), Skyline([4, 0, 2], np.array([True, False, True])), 1)
    assert np.flatnonzero(near[:, 0]).tolist() == [3, 4, 5]
    assert near[:, 1].all()
    assert np.flatnonzero(near[:, 2]).tolist() == [1, 2, 3]
