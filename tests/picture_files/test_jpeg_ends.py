"""JPEG files that end too early."""

import numpy as np

import skyline_viz as sv
from skyline_viz.photo import read_photo_with_notes
from testing import photo_files

PHOTO, ROWS = photo_files.scene()


def test_a_jpeg_without_its_last_rows_is_read_with_a_note(tmp_path):
    photo, rows = photo_files.scene(height=400)
    path = tmp_path / "a.jpg"
    photo_files.jpeg_cut(0.993)(path, photo)
    read, (note,) = read_photo_with_notes(path)
    assert "rows are missing" in note
    assert np.abs(sv.Detector().detect(read).skyline.rows - rows).mean() < 3
    assert np.abs(read[:380].astype(int) - photo[:380]).mean() < 6
    assert (read[-1] == read[-8]).all()
