"""A filter bank as entities, and which of its filters the path used."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.colours import bin_legend
from skyline_viz.viewer import entities
from skyline_viz.viewer.bank_pictures import cell_box, draw_bank
from skyline_viz.viewer.bank_recording import log_filter_bank, log_path_bins, path_bins
from testing.recordings import Read, scene


@pytest.fixture(scope="module")
def found():
    return sv.Detector().detect(scene()[0])


@pytest.fixture(scope="module")
def read(found, tmp_path_factory):
    path = tmp_path_factory.mktemp("bank") / "a.rrd"
    with sv.new_recording(path, "a") as recording:
        log_filter_bank(recording, found.bank, under="other")
        log_path_bins(recording, found)
    return Read(path)


def test_the_pictures_lie_under_their_parent_and_cells_have_words(read, found):
    pictures, bank = draw_bank(found.bank), found.bank
    for entity, picture in (
        (entities.BANK_FILTERS, pictures.filters),
        (entities.BANK_SAMPLES, pictures.samples),
    ):
        place = entities.below("other", entity)
        np.testing.assert_array_equal(read.picture(place), picture)
        np.testing.assert_array_equal(read.classes(f"{place}/cells"), pictures.cells)
        labels = read.labels(f"{place}/cells")
        assert labels[8] == f"{bank.bins.label(7)}: {int(bank.samples[7]):,} samples"


def test_the_path_used_the_bins_of_its_edge_pixels(found):
    bins = path_bins(found)
    by_place = dict(
        zip(
            zip(found.edge_rows.tolist(), found.edge_columns.tolist(), strict=True),
            found.bins.tolist(),
            strict=True,
        )
    )
    rows = found.skyline.rows.astype(int).tolist()
    assert bins.tolist() == [by_place.get((row, column), -1) for column, row in enumerate(rows)]
    assert (bins >= 0).any()


def test_scrubbing_tells_of_each_column(read, found):
    texts = read.on(entities.COLUMN, entities.BANK_USED, "text")
    assert len(texts) == found.skyline.width
    bins = path_bins(found)
    for column in (0, 31, 90):
        (text,) = texts[column]
        assert text.startswith(f"**Column {column}**, row {int(found.skyline.rows[column])}")
        if bins[column] >= 0:
            assert found.bank.bins.label(int(bins[column])).capitalize() in text
            here = found.edge_rows == int(found.skyline.rows[column])
            (pixel,) = np.flatnonzero(here & (found.edge_columns == column))
            assert f"Score {found.scores[pixel]:.3f}" in text
        else:
            assert "no filter was used" in text


def test_the_frame_lies_around_the_filter_that_was_used(read, found):
    bins = path_bins(found)
    centres = read.on(entities.COLUMN, entities.BANK_CHOSEN, "centers")
    column = int(np.flatnonzero(bins >= 0)[0])
    left, top, right, bottom = cell_box(int(bins[column]), found.bank.bins)
    assert centres[column][0] == [(left + right) / 2, (top + bottom) / 2]


def test_every_bin_has_a_colour_and_words_of_its_own():
    legend = bin_legend(sv.Bins())
    assert len({words for words, _ in legend}) == len(legend) == sv.Bins().count
