"""Evaluation: figures counted by hand, cross-validation against training by hand, reports."""

import csv
import io
import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from rich.console import Console

import skyline_viz as sv
from skyline_viz.config import FILTER_SIZES, DetectorConfig, TrainingConfig
from skyline_viz.evaluation import cross_validation as evaluation
from skyline_viz.evaluation import report as evaluation_report
from skyline_viz.evaluation.cross_validation import cross_validate, evaluate, train_on, train_sizes
from skyline_viz.evaluation.results import PhotoResult, Summary

HEIGHT, WIDTH = 64, 96


def scene(number):
    """A photo with texture below a slanting line, and the line."""
    rng = np.random.default_rng(number)
    rows = np.round(20 + number + np.arange(WIDTH) * 0.1 * (number % 3))
    truth = sv.Skyline(rows)
    photo = np.full((HEIGHT, WIDTH, 3), (190, 200, 215), np.uint8)
    terrain = rng.integers(20, 110, (HEIGHT, WIDTH, 1), dtype=np.uint8)
    return np.where(truth.to_mask(HEIGHT)[..., None], photo, terrain), truth


@pytest.fixture(scope="module")
def items(tmp_path_factory):
    root = tmp_path_factory.mktemp("hills")
    (root / "images").mkdir()
    for number in range(5):
        photo, truth = scene(number)
        sv.write_photo(root / "images" / f"p{number}.png", photo)
        truth.write_csv(root / "masks" / f"p{number}.csv")
    return sv.open_dataset(root).items


def result(name="a", error=0.0, **changes):
    values = {
        "name": name,
        "a_err": error,
        "worst_error": error,
        "worst_column": 0,
        "segmentation_accuracy": 1.0,
        "gross_miss": False,
        "seconds": 0.5,
        "height": 100,
        "width": 10,
    }
    return PhotoResult(**(values | changes))


@given(st.lists(st.floats(0, 1e4), min_size=1, max_size=20))
def test_shares_of_the_histogram_sum_to_one(errors):
    shares = evaluation_report.histogram([result("a", error) for error in errors])
    assert shares.sum() == pytest.approx(1.0)
    assert shares[-1] == pytest.approx(np.mean(np.array(errors) >= 10))


def test_skylines_of_a_data_set_are_compared_with_its_truths(items):
    results, failures = evaluate(items, sv.Detector())
    assert failures == []
    assert [one.name for one in results] == ["p0", "p1", "p2", "p3", "p4"]
    assert max(one.a_err for one in results) < 2
    assert all((one.height, one.width) == (HEIGHT, WIDTH) for one in results)
    assert all(one.seconds > 0 for one in results)


def test_bad_photos_and_bad_truths_are_failures(items, tmp_path):
    (tmp_path / "short.csv").write_text("column,row,visible\n0,3,1\n")
    bad = [
        sv.DatasetItem("gone", tmp_path / "gone.png", items[0].truth_path),
        sv.DatasetItem("bare", items[0].photo_path),
        sv.DatasetItem("short", items[0].photo_path, tmp_path / "short.csv"),
    ]
    results, failures = evaluate([*bad, items[1]], sv.Detector())
    assert [one.name for one in results] == ["p1"]
    assert [failure.name for failure in failures] == ["gone", "bare", "short"]
    assert str(failures[1]) == "bare: there is no truth."


def test_training_is_that_of_the_library(items):
    bank, failures = train_on(items, TrainingConfig(), seed=3, dataset="hills")
    expected = sv.train([(i.photo(), i.truth()) for i in items], seed=3, dataset="hills")
    assert failures == []
    np.testing.assert_array_equal(bank.filters, expected.filters)
    np.testing.assert_array_equal(bank.samples, expected.samples)
    assert bank.provenance == expected.provenance


def test_two_processes_train_the_same_bank(items):
    alone, _ = train_on(items, TrainingConfig())
    shared, _ = train_on(items, TrainingConfig(), workers=2)
    np.testing.assert_array_equal(alone.filters, shared.filters)


def test_training_on_nothing_is_refused(tmp_path):
    with pytest.raises(ValueError, match="at least one photo with a true skyline"):
        train_on([], TrainingConfig())
    with pytest.raises(ValueError, match=r"the first one failed: gone: there is no truth"):
        train_on([sv.DatasetItem("gone", tmp_path / "gone.png")], TrainingConfig())


def test_each_fold_is_tested_with_the_sum_of_the_others(items, monkeypatch):
    banks, gathered = {}, []
    gather = evaluation.gather

    def counting(photo, *rest):
        gathered.append(photo)
        return gather(photo, *rest)

    def remember(detector, item):
        banks[item.name] = detector.bank
        assert detector.config == DetectorConfig(delta=2)
        return result(item.name)

    monkeypatch.setattr(evaluation, "gather", counting)
    monkeypatch.setattr(evaluation, "_detect_and_compare", remember)
    backwards = list(items)[::-1]
    results, failures = cross_validate(backwards, 2, config=DetectorConfig(delta=2), seed=7)
    assert len(gathered) == len(items)
    assert failures == []
    assert [one.name for one in results] == [item.name for item in items]
    training = TrainingConfig(detector=DetectorConfig(delta=2))
    for fold in (0, 1):
        others = [items[index] for index in range(len(items)) if index % 2 != fold]
        expected = sv.train([(i.photo(), i.truth()) for i in others], seed=7, config=training)
        for item in items[fold::2]:
            np.testing.assert_array_equal(banks[item.name].samples, expected.samples)
            np.testing.assert_allclose(banks[item.name].filters, expected.filters, atol=1e-6)


def test_a_photo_that_fails_in_training_keeps_the_folds_of_the_others(items, tmp_path, monkeypatch):
    banks = {}

    def remember(detector, item):
        banks[item.name] = detector.bank.provenance.images
        return result(item.name)

    monkeypatch.setattr(evaluation, "_detect_and_compare", remember)
    gone = sv.DatasetItem("p05", tmp_path / "gone.png", items[0].truth_path)
    results, failures = cross_validate([*items, gone], 2)
    assert [failure.name for failure in failures] == ["p05"]
    # in order: p0 (fold 0), p05 (1, fails), p1 (0), p2 (1), p3 (0), p4 (1)
    assert banks == {"p0": 2, "p1": 2, "p2": 3, "p3": 2, "p4": 3}
    assert len(results) == 5


@pytest.mark.parametrize("folds", [-1, 0, 1, 6])
def test_too_few_and_too_many_folds_are_refused(items, folds):
    with pytest.raises(ValueError, match=f"from 2 to the 5 photos, not {folds}"):
        cross_validate(items, folds)


def test_a_cross_validation_finds_the_lines(items):
    results, failures = cross_validate(items, 5)
    assert failures == []
    assert max(one.a_err for one in results) < 2


def test_the_tables_name_figures_and_photos():
    results = [result("Jungfrau", 12.345, gross_miss=True, worst_column=77), result("Eiger", 1)]
    console = Console(width=100, file=io.StringIO())
    console.print(evaluation_report.summary_table(Summary.of(results)))
    console.print(evaluation_report.worst_table(results))
    text = console.file.getvalue()
    for word in ("6.67 px", "50.0%", "Jungfrau", "12.35 px (gross miss)", "77", "0.500 s"):
        assert word in text


def test_banks_of_all_sizes_are_those_trained_one_by_one(items, tmp_path):
    gone = sv.DatasetItem("gone", tmp_path / "gone.png", items[0].truth_path)
    banks, failures = train_sizes([*items, gone], TrainingConfig(), dataset="hills")
    assert [failure.name for failure in failures] == ["gone"]
    assert [bank.size for bank in banks] == list(FILTER_SIZES)
    for bank in banks:
        alone, _ = train_on(items, TrainingConfig(filter_size=bank.size), dataset="hills")
        assert np.array_equal(bank.filters, alone.filters)
        assert np.array_equal(bank.terrain, alone.terrain)
        assert bank.provenance == alone.provenance


def test_the_summary_as_json(tmp_path):
    path = tmp_path / "out" / "summary.json"
    evaluation_report.write_summary(path, Summary.of([result("a", 2.5)]), {"dataset": "Ötztal"})
    document = json.loads(path.read_text("utf-8"))
    assert document["dataset"] == "Ötztal"
    assert document["summary"]["mean"] == 2.5
    evaluation_report.write_summary(path, Summary.of([]), {})
    assert json.loads(path.read_text())["summary"]["median"] is None


def test_results_as_csv(tmp_path):
    path = tmp_path / "photos.csv"
    odd = 'a "b", c'
    results = [result(odd, 1 / 3, gross_miss=True), result("d", seconds=math.nan)]
    evaluation_report.write_results(path, results)
    with path.open(newline="") as file:
        lines = list(csv.DictReader(file))
    assert lines[0]["name"] == odd
    assert (lines[0]["a_err"], lines[0]["gross_miss"]) == ("0.333333", "1")
    assert (lines[1]["seconds"], lines[1]["height"]) == ("", "100")


def test_the_histogram_as_a_picture(tmp_path):
    few, many = tmp_path / "few.png", tmp_path / "many.png"
    evaluation_report.write_histogram(few, [result("a", 0.5)], "one photo")
    evaluation_report.write_histogram(many, [result("a", 0.5), result("b", 1e6)], "one photo")
    pictures = [np.asarray(Image.open(path).convert("RGB")) for path in (few, many)]
    assert pictures[0].shape == pictures[1].shape
    magenta = [(picture == (0xFF, 0x2D, 0x95)).all(axis=2).sum() for picture in pictures]
    assert magenta[0] == 0 < magenta[1]  # what is far off stands out


def test_a_histogram_of_nothing_is_empty():
    assert evaluation_report.histogram([]).sum() == 0
