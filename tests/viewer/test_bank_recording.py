"""A filter bank as entities: its pictures, and words for every cell."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.colours import bin_legend
from skyline_viz.viewer import entities
from skyline_viz.viewer.bank_pictures import draw_bank
from skyline_viz.viewer.bank_recording import log_filter_bank
from testing.recordings import Read, scene


@pytest.fixture(scope="module")
def found():
    return sv.Detector().detect(scene()[0])


@pytest.fixture(scope="module")
def read(found, tmp_path_factory):
    path = tmp_path_factory.mktemp("bank") / "a.rrd"
    with sv.new_recording(path, "a") as recording:
        log_filter_bank(recording, found.bank, under="other")
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


def test_every_bin_has_a_colour_and_words_of_its_own():
    legend = bin_legend(sv.Bins())
    assert len({words for words, _ in legend}) == len(legend) == sv.Bins().count
