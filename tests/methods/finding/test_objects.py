"""Objects of somebody's own class: their settings, names, digests and files."""

import sys
from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.datasets.item import LoadedItem
from skyline_viz.method import MethodError
from skyline_viz.methods.finding.method_files import load_method, method_digest, save_method
from skyline_viz.methods.finding.plugins import as_method
from skyline_viz.methods.registry import find_method
from skyline_viz.rendering import render
from skyline_viz.running.batch import BatchError
from skyline_viz.running.resume import Kept
from testing.methods import own_folder, write_module

CODE = """
from dataclasses import dataclass
import numpy as np


class Mine:
    def __init__(self, row: int = 10, model=None):
        self.row, self.model = row, dict(model or {})

    def fit(self, items, seed=0):
        return Mine(self.row, {"count": np.array([len(items)])})

    def detect(self, photo):
        return np.full(photo.shape[1], self.row)


@dataclass
class Field:
    row: int = 10
    name = "field"

    def detect(self, photo):
        return np.full(photo.shape[1], self.row)


class Hidden:
    def __init__(self, row=10):
        self._row = row
        self.name = f"hidden-{row}"

    def detect(self, photo):
        return np.full(photo.shape[1], self._row)


class HiddenLearner(Hidden):
    family = "hidden"
    model = {}

    def fit(self, items, seed=0):
        return self


class Secret:
    def __init__(self, row=10):
        self.row = row
        self.name = "secret"

    def fit(self, items, seed=0):
        made = Secret(self.row)
        made.learned = len(items)
        return made

    def detect(self, photo):
        return np.full(photo.shape[1], self.row)


class Twice:
    def __init__(self, row=10):
        self.row = 2 * row

    def detect(self, photo):
        return np.full(photo.shape[1], self.row)
"""


@pytest.fixture
def mine(tmp_path, monkeypatch):
    with own_folder(tmp_path, monkeypatch) as folder:
        find_method(write_module(folder, CODE))  # its classes are known to files then
        yield sys.modules["mine"]


@pytest.fixture(scope="module")
def items():
    scenes = [render("desert", seed, 80, 60) for seed in (1, 2)]
    return [LoadedItem(one.name, one.photo, one.truth) for one in scenes]


def rows_of(method):
    return set(method.detect(np.zeros((100, 8, 3), np.uint8)).skyline.rows.tolist())


@pytest.mark.parametrize("kind", ["Mine", "HiddenLearner", "Secret"])
def test_each_object_is_cross_validated_as_itself(mine, items, kind):
    make = getattr(mine, kind)
    found = sv.cross_validate(items, [make(10), make(50)])
    first, second = found.methods.values()
    assert (rows_of(first), rows_of(second)) == ({10}, {50})


def test_objects_of_one_class_are_called_after_their_settings(mine, items):
    assert [as_method(mine.Field(row)).name for row in (10, 3)] == ["field", "field:row=3"]
    assert as_method(mine.Mine(3)).name == "Mine:row=3"
    assert as_method(mine.Hidden(3)).name == "hidden-3"  # as the object calls itself
    found = sv.evaluate(items, [mine.Secret(3), mine.Secret(5)])
    assert list(found.results) == ["secret:row=3", "secret:row=5"]


@pytest.mark.parametrize("kind", ["Mine", "Field", "Hidden", "Twice"])
def test_other_settings_are_another_digest_and_keep_other_results(mine, items, kind, tmp_path):
    make = getattr(mine, kind)
    assert method_digest(make(10)) != method_digest(make(50))
    kept = Kept(tmp_path / "kept")
    errors = set()
    for row in (10, 20):
        (results,) = sv.evaluate(items, make(row), kept=kept).results.values()
        errors.add(results[0].a_err)
    assert len(errors) == 2


def test_what_can_be_told_is_kept(mine, items, tmp_path):
    for kind, known in (("Mine", 2), ("Hidden", 0)):
        for _ in range(2):
            kept = Kept(tmp_path / "kept")
            sv.evaluate(items, getattr(mine, kind)(7), kept=kept)
        assert kept.known == known
    assert method_digest(mine.Field(3)) == method_digest(find_method("mine:Field:row=3"))


def test_what_is_learned_in_secret_is_another_digest_each_time(mine, items):
    known = as_method(mine.Secret())
    assert method_digest(known.fit(items)) != method_digest(known.fit(items[:1]))


def test_an_object_comes_back_from_its_file(mine, items, tmp_path):
    save_method(as_method(mine.Mine(60)).fit(items), tmp_path / "m.npz")
    again = load_method(tmp_path / "m.npz")
    assert (again.name, again.inner.row, again.inner.model["count"]) == ("Mine:row=60", 60, 2)


@pytest.mark.parametrize(
    ("kind", "says"),
    [
        ("Hidden", "its settings are in no attributes named like its parameters"),
        ("HiddenLearner", "its settings are in no attributes"),
        ("Secret", "what it has learned is in no model"),
        ("Twice", "cannot be made anew with its settings"),
    ],
)
def test_a_file_that_would_give_another_one_back_is_not_written(mine, kind, says, tmp_path):
    with pytest.raises(MethodError, match=f"mine:{kind} .*{says}"):
        save_method(getattr(mine, kind)(60), tmp_path / "m.npz")
    assert not (tmp_path / "m.npz").exists()


def test_a_class_that_nobody_finds_again_is_not_written(tmp_path):
    class Level:
        def detect(self, photo):
            return np.full(photo.shape[1], 7.0)

    with pytest.raises(MethodError, match="inside of a function"):
        save_method(Level(), tmp_path / "m.npz")


def test_one_that_no_other_process_takes_is_refused_with_a_sentence(mine, items):
    method = mine.Field(3)
    method.look_up = lambda photo: 3
    with pytest.raises(BatchError, match=r"^Field cannot be sent.*use --workers 1\.$"):
        sv.evaluate(items, method, workers=2)
    assert len(sv.evaluate(items, method).results["field:row=3"]) == 2


def test_untold_settings_are_not_shared(mine):
    one, other = as_method(mine.HiddenLearner(10)), as_method(mine.HiddenLearner(50))
    assert one.family != other.family
    with pytest.raises(MethodError, match="cannot be made anew"):
        one.sharing(other)
    assert rows_of(one.sharing(replace(one, label="x"))) == {10}


@pytest.mark.parametrize(
    "no_method", [3, None, object(), sv.Detector], ids=["number", "none", "object", "class"]
)
def test_what_is_no_method_is_one_sentence(no_method):
    with pytest.raises(MethodError, match=r"(no method: it has no detect|is a class).*\.$"):
        as_method(no_method)
