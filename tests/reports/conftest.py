"""Photos as reports show them: one that is lost in haze, one that is right, one without a truth."""

import pytest

from skyline_viz.diagnosis.data_set import diagnose_detection
from skyline_viz.reports import photo_report
from testing import detections


@pytest.fixture(scope="session")
def hazy():
    detection, truth = detections.hazy()
    diagnosed = diagnose_detection("hazy", detection, truth, remedies=True)
    return photo_report("hazy", detection, truth, diagnosed, photos=3)


@pytest.fixture(scope="session")
def flat():
    detection, truth = detections.flat(), detections.flat_truth([], 0)
    diagnosed = diagnose_detection("flat", detection, truth, remedies=True)
    return photo_report("flat", detection, truth, diagnosed, photos=3)


@pytest.fixture(scope="session")
def blind():
    return photo_report("blind", detections.flat(), photos=3)
