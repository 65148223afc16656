"""Photos of a sequence: the accepted line of a neighbour is proposed."""

import numpy as np
import pytest

from annotate.engine.carried import carried_over
from annotate.store.operations import SetAnchor, SetStatus, SetTag
from annotate.work.carrying import carry_over
from skyline_viz import render
from skyline_viz.photo import write_photo
from testing.labelling import workbench

HEIGHT, WIDTH = 240, 400
ROW = 160  # far below the ridge


@pytest.fixture(scope="module")
def scene():
    return render("clear", 3, 640, 480).photo


@pytest.fixture
def folder(tmp_path, scene):
    """Two photos of a pan, one of another place, and one that is smaller."""
    for name, left in (("pan-1", 100), ("pan-2", 140)):
        write_photo(tmp_path / f"{name}.png", scene[20 : 20 + HEIGHT, left : left + WIDTH])
    write_photo(tmp_path / "pan-3.png", render("snow", 77, WIDTH, HEIGHT).photo)
    write_photo(tmp_path / "pan-4.png", scene[:HEIGHT, : WIDTH - 9])
    return tmp_path


@pytest.fixture
def bench(folder):
    bench = workbench(folder)
    yield bench
    bench.close()


def accept(bench, photo):
    """Accept a photo with a line that no detector would propose."""
    session = bench.session(photo)
    session.apply(SetAnchor(column=200, row=ROW), -1)
    session.apply(SetStatus(status="accepted"), -1)
    return session


def shown(bench, photo):
    session = bench.session(photo)
    carry_over(bench, session)
    return session


def test_the_accepted_line_is_proposed_on_the_next_photo(bench):
    before = accept(bench, 1)
    own = bench.session(2).wire.skyline
    session = shown(bench, 2)
    line = session.wire.skyline
    stroke = carried_over(before.pixels, before.wire.skyline, session.pixels)
    columns, rows = np.array(stroke.points).T
    near = np.abs(line.rows[: WIDTH - 50] - np.interp(np.arange(WIDTH - 50), columns, rows))
    assert line != own
    assert np.median(near) <= stroke.radius
    assert session.state.status == "to do"
    assert session.state.carried == "pan-1.png"
    assert bench.store.line(session.label).skyline == line
    assert {card.photo.name: card.status for card in bench.cards()}["pan-2.png"] == "to do"


def test_undo_gives_the_detectors_own_and_it_is_not_carried_again(bench):
    accept(bench, 1)
    own = bench.session(2).wire.skyline
    session = shown(bench, 2)
    session.undo(-1)
    assert session.wire.skyline == own
    assert session.state.status == "to do"
    assert session.state.carried == ""
    assert shown(bench, 2).wire.skyline == own
    session.redo(-1)
    assert session.state.carried == "pan-1.png"
    assert session.state.status == "to do"


def test_it_is_as_it_was_when_the_folder_is_opened_again(folder):
    bench = workbench(folder)
    accept(bench, 1)
    line = shown(bench, 2).wire.skyline
    bench.close()
    again = workbench(folder)
    assert again.session(2).wire.skyline == line
    assert again.session(2).state.carried == "pan-1.png"
    again.close()


def test_an_edit_makes_it_the_annotators(bench):
    accept(bench, 1)
    session = shown(bench, 2)
    session.apply(SetAnchor(column=30, row=90), -1)
    assert session.state.carried == ""
    assert session.state.status == "in progress"


def test_the_way_back_is_a_way_too(bench):
    accept(bench, 2)
    assert shown(bench, 1).state.carried == "pan-2.png"


def test_nothing_is_carried_where_it_should_not_be(bench):
    own = shown(bench, 2)
    assert own.state.revision == 0  # its neighbour is not accepted yet
    accept(bench, 2)
    assert shown(bench, 3).state.revision == 0  # another place
    accept(bench, 3)
    assert shown(bench, 4).state.revision == 0  # another size


def test_what_somebody_has_begun_stays(bench):
    session = bench.session(2)
    session.apply(SetAnchor(column=30, row=90), -1)
    line = session.wire.skyline
    accept(bench, 1)
    assert shown(bench, 2).wire.skyline == line


def test_blind_photos_get_nothing(folder):
    bench = workbench(folder, blind=1.0)
    first = bench.session(1)
    first.apply(SetAnchor(column=30, row=90), -1)
    first.apply(SetStatus(status="accepted"), -1)
    session = shown(bench, 2)
    assert session.wire.empty
    assert session.state.revision == 0
    bench.close()


def test_the_same_line_is_not_carried(tmp_path, scene):
    photo = scene[20 : 20 + HEIGHT, 100 : 100 + WIDTH].copy()
    write_photo(tmp_path / "still-1.png", photo)
    photo[-1, 0] ^= 1
    write_photo(tmp_path / "still-2.png", photo)
    bench = workbench(tmp_path)
    bench.session(1).apply(SetStatus(status="accepted"), -1)
    assert shown(bench, 2).state.revision == 0  # the detector proposes just that
    bench.close()


def test_a_neighbour_that_has_vanished_carries_nothing(bench, folder):
    accept(bench, 1)
    bench.close_photo(1)
    (folder / "pan-1.png").unlink()
    assert shown(bench, 2).state.revision == 0


def test_the_line_of_a_photo_without_a_visible_skyline_is_not_carried(bench):
    before = accept(bench, 1)
    before.apply(SetTag(tag="no visible skyline", on=True), -1)
    assert shown(bench, 2).state.carried == ""
