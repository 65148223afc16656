"""Diagnoses as they are kept between two runs."""

import json

import pytest

import skyline_viz as sv
from skyline_viz.diagnosis.data_set import diagnose_photo
from skyline_viz.diagnosis.record import pack, unpack
from skyline_viz.evaluation.tasks import PhotoTask
from testing.programs.ends import write_set

PHOTOS = 6


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    return write_set(tmp_path_factory.mktemp("data") / "hills", PHOTOS, size=(160, 120))


def test_a_diagnosis_comes_back_as_it_was(data):
    (item, *_) = sv.open_dataset(data)
    item = type(item)(item.name, item.photo_path, data.parent / "low.csv")
    sv.Skyline([110.0] * 160).write_csv(data.parent / "low.csv")
    one = diagnose_photo(None, PhotoTask(item, sv.Detector()), remedies=True)
    assert one.diagnosis.segments
    assert one.remedies
    again = unpack(json.loads(json.dumps(pack(one))))
    assert pack(again) == pack(one)
    assert again.diagnosis.document() == one.diagnosis.document()
    assert again.diagnosis.markdown() == one.diagnosis.markdown()
    assert again.remedies == one.remedies
