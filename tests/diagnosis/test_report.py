"""Diagnoses of a data set: what they are together, and what would help."""

import csv

import pytest

from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.diagnosis.record import Diagnosed
from skyline_viz.diagnosis.report import write_csv


def test_contributing_causes_are_kept_apart(hazy, tmp_path):
    detection, truth = hazy
    one = Diagnosed("hazy-1", 1.0, False, 960, diagnose(detection, truth), ())
    write_csv(tmp_path / "s.csv", [one])
    with (tmp_path / "s.csv").open() as file:
        (row,) = csv.DictReader(file)
    assert (row["contributing"], row["terms"], row["place"]) == ("", "no edge", "haze")
    assert float(row["total_error"]) == pytest.approx(one.diagnosis.main.total_error, abs=1e-3)
