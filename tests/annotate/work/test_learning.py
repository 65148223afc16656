"""Learning while labelling: what it takes over, and what it leaves alone."""

import numpy as np
import pytest

from annotate.store.operations import SetAnchor, SetStatus, Straight
from annotate.work.learning import LEAST, Learner
from skyline_viz.detector import Detector
from skyline_viz.filter_bank import FilterBank
from skyline_viz.photo import write_photo
from testing import until
from testing.labelling import workbench, write_hills


@pytest.fixture
def bench(tmp_path):
    bench = workbench(write_hills(tmp_path, count=LEAST + 3, height=96, width=140))
    yield bench
    bench.close()


def accept(bench, count):
    for photo in list(bench.photos)[:count]:
        bench.session(photo).apply(SetStatus(status="accepted"), -1)


def learned(bench):
    learner = Learner(bench)
    assert learner.now().state == "idle"
    learner.start()
    return until(lambda: (now := learner.now()).state != "running" and now)


def test_a_handful_of_labels_is_too_little(bench):
    accept(bench, 2)
    now = learned(bench)
    assert now.state == "failed"
    assert now.detail == "learning needs 10 accepted photos, and there are 2."


def test_a_bank_that_is_no_better_is_not_taken_over(bench):
    accept(bench, LEAST)  # the present bank's own proposals: nothing can be better
    before = bench.detector
    now = learned(bench)
    assert now.state == "done"
    assert "stays as it is" in now.detail
    assert bench.detector is before


def test_untouched_photos_get_new_proposals_from_a_better_bank(bench):
    photos = list(bench.photos)
    accept(bench, LEAST)
    for photo in photos[LEAST:]:
        bench.session(photo)
    touched, *untouched = photos[LEAST:]
    session = bench.session(touched)
    session.apply(SetAnchor(column=5, row=5), -1)
    kept = session.wire.skyline
    flat = FilterBank(-bench.detector.bank.filters, bench.detector.bank.samples)
    bench.detector = Detector(flat, bench.detector.config)  # scores everything the wrong way round
    now = learned(bench)
    assert now.state == "done"
    assert now.changed == len(untouched)
    bench.close_photo(touched)
    assert bench.session(touched).wire.skyline == kept
    assert bench.session(touched).detector.bank is not bench.detector.bank
    for photo in untouched:
        kept_bank = bench.store.detector(bench.label(photo)).bank
        np.testing.assert_array_equal(kept_bank.filters, bench.detector.bank.filters)


def ridges(seed):
    """A photo of two level ridges, and their rows."""
    random = np.random.default_rng(seed)
    upper, lower = int(random.integers(20, 30)), int(random.integers(60, 70))
    photo = np.full((96, 140, 3), 210.0)
    photo[upper:] = 150
    photo[lower:] = 70
    return (photo + random.normal(0, 6, photo.shape)).clip(0, 255).astype(np.uint8), upper, lower


def test_a_bank_is_judged_on_photos_that_it_has_not_seen(tmp_path):
    """Every other photo is labelled along its lower ridge: what one half teaches, the other denies.

    A bank that was judged on its own photos would look perfect.
    """
    for number in range(2 * LEAST):
        write_photo(tmp_path / f"p{number:02}.png", ridges(number)[0])
    bench = workbench(tmp_path)
    for number, photo in enumerate(bench.photos.values()):
        row = ridges(number)[1 + number % 2]
        session = bench.session(photo.id)
        session.apply(Straight(column=0, row=row, to_column=139, to_row=row), -1)
        session.apply(SetStatus(status="accepted"), -1)
    before = bench.detector
    now = learned(bench)
    assert now.state == "done"
    assert "stays as it is" in now.detail
    assert bench.detector is before
    bench.close()
