"""Recordings in memory: whole, of the line that is given, and lean where the photo is large."""

import numpy as np

import skyline_viz as sv
from skyline_viz.viewer import entities
from skyline_viz.viewer.program import in_memory
from testing.recordings import Read


def detection():
    photo = np.full((60, 70, 3), (150, 190, 230), np.uint8)
    photo[25:] = (60, 70, 40)
    return sv.Detector().detect(photo)


def test_a_recording_in_memory_is_one_like_any_other(tmp_path):
    data = in_memory.recorded(detection(), sv.Skyline(np.full(70, 30.0)), "a photo")
    (tmp_path / "one.rrd").write_bytes(data)
    read = Read(tmp_path / "one.rrd")
    strip = np.array(read.last(entities.TRUTH, "strips").as_py()[0])
    assert set(strip[:, 1]) == {30.0}
    assert entities.COST in read.entities()


def test_large_photos_are_kept_lean(monkeypatch):
    truth = sv.Skyline(np.full(70, 30.0))
    full = in_memory.recorded(detection(), truth, "a photo")
    monkeypatch.setattr(in_memory, "fidelity_of", lambda pixels: "lean")
    assert len(in_memory.recorded(detection(), truth, "a photo")) < len(full)
