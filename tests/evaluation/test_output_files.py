"""The files of an evaluation: the same for one method and for several."""

import csv
import json
import math

import pytest

from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.evaluation.evaluated import Evaluation
from skyline_viz.evaluation.output_files import (
    FILES,
    write_evaluation,
    write_photos,
    write_summary,
)
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.running.batch import Failure
from testing.detections import result


def test_the_summary_has_the_figures_of_each_method_under_its_name(tmp_path):
    path = tmp_path / "out" / "summary.json"
    detector = Detector()
    found = Evaluation(
        {"default": [result("a", 2.5)], "edges": []},
        (Failure("b", "it is gone"),),
        {"default": detector, "edges": EdgesOnly()},
        fold_of={"a": 0, "b": 1},
        seed=3,
    )
    write_summary(path, found, {"dataset": "Ötztal"})
    document = json.loads(path.read_text("utf-8"))
    assert (document["dataset"], document["folds"], document["seed"]) == ("Ötztal", 2, 3)
    assert document["summary"]["default"]["mean"] == 2.5
    assert document["summary"]["edges"]["median"] is None
    assert document["settings"]["default"]["config"]["delta"] == 4
    images = document["settings"]["default"]["bank"]["images"]
    assert images == detector.bank.provenance.images > 0
    assert document["settings"]["edges"] == {}
    assert document["failed"] == [{"name": "b", "reason": "it is gone"}]


@pytest.mark.parametrize(("config", "sky"), [("default", "small"), ("paper", None)])
def test_a_sky_model_is_told_where_it_ran(tmp_path, config, sky):
    path = tmp_path / "summary.json"
    detector = Detector(config=DetectorConfig.presets()[config])
    found = Evaluation({config: []}, (), {config: detector}, fold_of={"a": 0, "b": 1}, seed=3)
    write_summary(path, found, {})
    assert json.loads(path.read_text("utf-8"))["settings"][config]["sky"] == sky


def test_a_line_for_each_photo_and_method(tmp_path):
    path = tmp_path / "photos.csv"
    odd = 'a "b", c'
    results = [result(odd, 1 / 3, gross_miss=True), result("d", seconds=math.nan)]
    write_photos(path, Evaluation({"default": results, "mine, too": results[:1]}))
    with path.open(newline="") as file:
        lines = list(csv.DictReader(file))
    assert [line["method"] for line in lines] == ["default", "default", "mine, too"]
    assert lines[0]["name"] == odd
    assert (lines[0]["a_err"], lines[0]["gross_miss"]) == ("0.333333", "1")
    assert (lines[1]["seconds"], lines[1]["height"]) == ("", "100")


@pytest.mark.parametrize("methods", [[], ["default"], ["default", "edges", "paper"]])
def test_the_same_files_whatever_the_number_of_methods(tmp_path, methods):
    found = Evaluation({name: [result("a", 1.0)] for name in methods})
    write_evaluation(tmp_path, found, about={}, title="one photo")
    assert sorted(one.name for one in tmp_path.iterdir()) == sorted(FILES)
    assert list(json.loads((tmp_path / "summary.json").read_text())["summary"]) == methods
    assert len((tmp_path / "photos.csv").read_text().splitlines()) == 1 + len(methods)
