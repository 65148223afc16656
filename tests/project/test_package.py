"""The package's public names, and that importing it loads nothing heavy."""

import importlib
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import skyline_viz as sv
from testing import uncovered

CONTRACT = (
    "read_photo",
    "PhotoError",
    "Detector",
    "Detection",
    "DetectorConfig",
    "FilterBank",
    "train",
    "Skyline",
    "a_err",
    "open_dataset",
    "log_detection",
    "find_method",
    "Method",
)
HEAVY = ("numpy", "cv2", "numba", "matplotlib", "PIL", "rich", "tyro", "rerun", "multiprocessing")


def fresh(code):
    """What a new interpreter prints."""
    environment = uncovered() | {"PYTHONPATH": str(Path(sv.__file__).parents[1])}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.split()


def test_importing_the_package_loads_nothing_heavy():
    loaded = fresh("import sys, skyline_viz; print(*sys.modules)")
    assert "skyline_viz" in loaded
    assert [name for name in HEAVY if name in loaded] == []
    assert [name for name in loaded if name.startswith("skyline_viz.")] == ["skyline_viz._version"]


def test_settings_are_light_to_import():
    loaded = fresh("import sys, skyline_viz as sv; sv.DetectorConfig(); print(*sys.modules)")
    assert "skyline_viz.config" in loaded
    assert [name for name in ("cv2", "numba", "matplotlib") if name in loaded] == []


@pytest.mark.parametrize("name", CONTRACT)
def test_the_contracts_names_are_public(name):
    assert name in sv.__all__
    assert callable(getattr(sv, name))


@pytest.mark.parametrize("name", sv.__all__)
def test_every_public_name_can_be_loaded(name):
    value = getattr(sv, name)
    assert value.__name__ == name
    assert value is getattr(importlib.import_module(value.__module__), name)
    assert value.__doc__


def test_all_is_sorted_and_complete():
    assert sorted(sv.__all__) == sv.__all__
    assert len(set(sv.__all__)) == len(sv.__all__)
    assert set(sv.__all__) <= set(dir(sv))


def test_star_import():
    names = fresh("from skyline_viz import *; print(*dir())")
    assert set(sv.__all__) <= set(names)


def test_other_names_are_refused():
    with pytest.raises(AttributeError, match="detect_everything"):
        _ = sv.detect_everything


def test_the_contract_from_photo_to_error(tmp_path):
    photo = np.full((60, 80, 3), 210, np.uint8)
    photo[33:] = (50, 60, 40)
    sv.write_photo(tmp_path / "a.png", photo)
    detector = sv.Detector(sv.FilterBank.default(), sv.DetectorConfig.paper())
    detection = detector.detect(sv.read_photo(tmp_path / "a.png"))
    assert isinstance(detection, sv.Detection)
    truth = sv.Skyline(rows=np.full(80, 33.0), visible=np.ones(80, bool))
    assert sv.a_err(detection.skyline, truth) <= 1
    bank = sv.train([(photo, truth)], seed=0)
    bank.save(tmp_path / "bank.npz")
    again = sv.FilterBank.load(tmp_path / "bank.npz")
    assert again.samples.sum() == bank.samples.sum() == 2 * 80
    assert sv.Detector(again).detect(photo).skyline == sv.Detector(bank).detect(photo).skyline
