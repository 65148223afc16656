"""Labels as pictures: masks, painted photos, and the layout of CH1."""

import shutil

import numpy as np
import pytest

from annotate.formats import export_labels
from skyline_viz.datasets.layouts import open_dataset
from testing import label_files as made
from testing.exports import WIDTH, label, put
from testing.imports import imported, is_right, said_about


@pytest.mark.parametrize("kind", made.SAME)
def test_masks_that_are_read_as_truths_are_imported(tmp_path, photos, kind):
    folder = tmp_path / "in"
    folder.mkdir()
    mask = made.SAME[kind](folder)
    mask.rename(mask.with_name(f"ridge{mask.suffix}"))
    (found,) = imported(folder, photos)
    seen = found.skyline.visible
    assert seen.sum() > 0.9 * made.WIDTH
    assert found.skyline.rows[seen].tolist() == made.ROWS[seen].tolist()


@pytest.mark.parametrize("kind", ["palette of three", "three greys"])
def test_masks_ask_and_are_answered(tmp_path, photos, kind):
    (tmp_path / "in").mkdir()
    made.ASK[kind](tmp_path / "in").rename(tmp_path / "in" / "ridge_mask.png")
    assert "--sky" in said_about(tmp_path / "in", photos)
    is_right(imported(tmp_path / "in", photos, sky="0" if kind == "palette of three" else "2"))


@pytest.fixture
def small(tmp_path):
    put(tmp_path / "small", "a.png")
    return tmp_path / "small"


@pytest.mark.parametrize(("kind", "layout"), [("ch1", "CH1"), ("painted", "Web")])
def test_an_export_opens_as_a_data_set(tmp_path, small, kind, layout):
    put(small, "x/a.png", seed=1)
    labels = [
        label(small, "a.png"),
        label(small, "x/a.png", np.full(WIDTH, 7)),
    ]
    export_labels(labels, small, tmp_path / "out", kind)
    dataset = open_dataset(tmp_path / "out")
    assert dataset.layout == layout
    assert dataset.problems == ()
    assert sorted(item.truth().rows[1] for item in dataset) == [5, 7]


@pytest.mark.parametrize(("kind", "place"), [("mask", "masks"), ("csv", "ground_truth")])
def test_masks_and_tables_are_truths_beside_their_photos(tmp_path, small, kind, place):
    export_labels([label(small, "a.png")], small, tmp_path / "out", kind)
    shutil.copytree(tmp_path / "out" / ("masks" if kind == "mask" else "."), small / place)
    (item,) = open_dataset(small)
    assert item.truth() == label(small, "a.png").skyline
