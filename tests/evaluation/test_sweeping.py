"""A sweep comes to what evaluating each value comes to."""

from dataclasses import dataclass

import pytest

import skyline_viz as sv
from skyline_viz.detector import Detector
from skyline_viz.evaluation.cross_validation import evaluate
from skyline_viz.evaluation.sweeping import sweep
from skyline_viz.methods.edges_only import EdgesOnly


@pytest.mark.parametrize(
    ("setting", "values"),
    [("delta", [1, 4, 2]), ("edge_source", ["grey", "colour"]), ("v", [0.0, 1.0])],
)
def test_each_value_is_evaluated_by_itself(items, setting, values):
    found = sweep(items, setting, values, "paper")
    assert list(found.results) == [f"{setting}={value}" for value in values]
    for value, (name, results) in zip(values, found.results.items(), strict=True):
        config = found.methods[name].config
        assert getattr(config, setting) == value
        (alone,) = evaluate(items, Detector(config=config)).results.values()
        assert [(one.name, one.a_err) for one in results] == [
            (one.name, one.a_err) for one in alone
        ]


def test_a_photo_that_fails_is_told_once(items, tmp_path):
    gone = sv.DatasetItem("gone", tmp_path / "gone.png", items[0].truth_path)
    found = sweep([gone, items[0]], "delta", [1, 2])
    assert [one.name for one in found.failures] == ["gone"]
    assert [len(one) for one in found.results.values()] == [1, 1]


def test_settings_and_values_that_make_no_sense_are_sentences(items):
    with pytest.raises(ValueError, match=r"there is no setting dleta; did you mean delta?"):
        sweep(items, "dleta", [1])
    with pytest.raises(ValueError, match=r"delta is a whole number from 0 to 100000, not 0\.5"):
        sweep(items, "delta", [0.5])
    with pytest.raises(ValueError, match="settings are swept of our own detector, not of edges"):
        sweep(items, "delta", [1], EdgesOnly())
    with pytest.raises(ValueError, match=r"^3 is no method: it has no detect\(photo\)\.$"):
        sweep(items, "delta", [1], 3)


@dataclass(frozen=True)
class Deeper(sv.DetectorConfig):
    depth: float = 0.5


def test_settings_that_a_class_adds_are_swept_and_compared(items):
    detector = Detector(config=Deeper())
    found = sweep(items[:1], "depth", [0.5, 2], detector)
    assert [one.config.depth for one in found.methods.values()] == [0.5, 2]
    assert list(evaluate(items[:1], [detector, "default"]).results) == [
        "default:depth=0.5",
        "default",
    ]
