"""skyline-viz: look inside a mountain-skyline detector.

    import skyline_viz as sv
    photo = sv.read_photo("photo.jpg")
    detection = sv.Detector().detect(photo)
    detection.skyline.rows

Names are loaded when first used, so that ``import skyline_viz`` costs nothing.
"""

from importlib import import_module
from typing import TYPE_CHECKING

__version__ = "0.1.0"

if TYPE_CHECKING:
    from skyline_viz.bins import Bins
    from skyline_viz.config import DetectorConfig, TrainingConfig
    from skyline_viz.constraints import Anchor, Constraints, PathError, StraightSpan
    from skyline_viz.datasets import Dataset, DatasetError, DatasetItem, open_dataset
    from skyline_viz.detection import Detection
    from skyline_viz.detector import Detector, FilterDetection
    from skyline_viz.diagnosis import Diagnosis, diagnose
    from skyline_viz.filter_bank import FilterBank, FilterBankError
    from skyline_viz.metrics import a_err, column_errors, is_gross_miss, segmentation_accuracy
    from skyline_viz.notebook import show_detection
    from skyline_viz.path import margins, path_tables, shortest_path
    from skyline_viz.photo import PhotoError, read_photo, write_photo
    from skyline_viz.recording import log_detection, log_stages, new_recording
    from skyline_viz.skyline import Skyline, SkylineError
    from skyline_viz.training import train
    from skyline_viz.verdict import Verdict

_HOME = {
    "Anchor": "constraints",
    "Constraints": "constraints",
    "StraightSpan": "constraints",
    "margins": "path",
    "path_tables": "path",
    "shortest_path": "path",
    "Bins": "bins",
    "Dataset": "datasets",
    "DatasetError": "datasets",
    "DatasetItem": "datasets",
    "Detection": "detection",
    "Detector": "detector",
    "FilterDetection": "detector",
    "DetectorConfig": "config",
    "Diagnosis": "diagnosis",
    "FilterBank": "filter_bank",
    "FilterBankError": "filter_bank",
    "PathError": "constraints",
    "PhotoError": "photo",
    "Skyline": "skyline",
    "SkylineError": "skyline",
    "TrainingConfig": "config",
    "Verdict": "verdict",
    "a_err": "metrics",
    "column_errors": "metrics",
    "diagnose": "diagnosis",
    "is_gross_miss": "metrics",
    "log_detection": "recording",
    "log_stages": "recording",
    "new_recording": "recording",
    "open_dataset": "datasets",
    "read_photo": "photo",
    "segmentation_accuracy": "metrics",
    "show_detection": "notebook",
    "train": "training",
    "write_photo": "photo",
}

__all__ = [
    "Anchor",
    "Bins",
    "Constraints",
    "Dataset",
    "DatasetError",
    "DatasetItem",
    "Detection",
    "Detector",
    "DetectorConfig",
    "Diagnosis",
    "FilterBank",
    "FilterBankError",
    "FilterDetection",
    "PathError",
    "PhotoError",
    "Skyline",
    "SkylineError",
    "StraightSpan",
    "TrainingConfig",
    "Verdict",
    "a_err",
    "column_errors",
    "diagnose",
    "is_gross_miss",
    "log_detection",
    "log_stages",
    "margins",
    "new_recording",
    "open_dataset",
    "path_tables",
    "read_photo",
    "segmentation_accuracy",
    "shortest_path",
    "show_detection",
    "train",
    "write_photo",
]


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOME])
