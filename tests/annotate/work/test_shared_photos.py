"""What people who label the same photos share, and what each of them has alone."""

import threading

import pytest

from annotate.store.operations import SetAnchor, SetStatus
from annotate.work.carrying import carry_over
from annotate.work.shown import Pictures
from skyline_viz.detector import Detector
from skyline_viz.photo import PhotoError, write_photo
from testing.labelling import beside, hills, workbench, write_hills


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps", count=2)


@pytest.fixture
def ann(folder):
    bench = workbench(folder)
    yield bench
    bench.close()


@pytest.fixture
def bob(ann):
    bench = beside(ann, "bob")
    yield bench
    bench.finish()


def test_a_photo_is_read_and_detected_once_while_both_have_it_open(ann, bob, monkeypatch):
    one = ann.session(1)
    monkeypatch.setattr(Detector, "detect", lambda *_: pytest.fail("it is detected again"))
    other = bob.session(1)
    assert other.pixels is one.pixels
    assert bob.detection(other) is ann.detection(one)
    assert other.wire.skyline == one.wire.skyline


def test_another_detector_of_one_person_is_not_the_others(ann, bob):
    other = Detector(config=Detector().config.paper())
    ann.propose_again(other)
    assert ann.detection(ann.session(1)) is not bob.detection(bob.session(1))
    assert bob.detector != ann.detector


def test_what_one_does_the_other_does_not_see(ann, bob):
    before = bob.session(1).wire.skyline
    ann.session(1).apply(SetAnchor(column=30, row=5), -1)
    ann.session(1).apply(SetStatus(status="accepted"), -1)
    assert bob.session(1).wire.skyline == before
    assert [card.status for card in bob.cards()] == ["to do", "to do"]
    assert bob.session(1).state.revision == 0
    session = bob.session(2)
    carry_over(bob, session)  # from photos that bob has accepted
    assert session.state.revision == 0
    assert bob.joined().labels[0].annotator == "bob"
    assert {one.annotator for one in bob.joined().labels} == {"bob"}


def test_two_who_finish_the_same_photo_at_once_lose_nothing(ann, bob):
    start = threading.Barrier(2)

    def label(bench, row):
        session = bench.session(1)
        start.wait()
        for column in range(2, 68, 6):
            session.apply(SetAnchor(column=column, row=row), session.state.revision)
        session.apply(SetStatus(status="accepted"), session.state.revision)

    threads = [
        threading.Thread(target=label, args=(bench, row)) for bench, row in ((ann, 12), (bob, 30))
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for bench, row in ((ann, 12), (bob, 30)):
        (label,) = [one for one in bench.joined().labels if one.status == "accepted"]
        assert len(label.operations) == 12
        assert (label.skyline.rows[2:68:6] == row).all()


def test_a_photo_that_is_replaced_is_refused_to_both(folder, ann, bob):
    for bench in (ann, bob):
        bench.session(1)
    write_photo(folder / "hill-0.png", hills(7))
    for bench in (ann, bob):
        with pytest.raises(PhotoError, match="replaced by another photo"):
            bench.session(1).apply(SetAnchor(column=30, row=5), -1)
        bench.close_photo(1)
        with pytest.raises(PhotoError, match="another photo now"):
            bench.session(1)


def test_pictures_are_made_once_for_all(ann, bob):
    assert Pictures(ann).whole(1) is Pictures(bob).whole(1)
    ann.session(1).apply(SetAnchor(column=30, row=5), -1)
    assert Pictures(ann).strip(1, 64).tag != Pictures(bob).strip(1, 64).tag
