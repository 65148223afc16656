"""``skyline-annotate open``: who labels, and proposals that are made ahead."""

import pytest

from annotate.commands.open import Open, propose_all
from annotate.server.address import Address, folder_id, keep_address
from skyline_viz.command_line.messages import UsageError
from skyline_viz.detector import Detector
from testing.labelling import beside, workbench, write_hills


@pytest.fixture
def bench(tmp_path):
    bench = workbench(write_hills(tmp_path / "alps", count=2))
    yield bench
    bench.close()


def test_proposals_are_made_ahead_and_a_photo_that_fails_is_said(bench, capsys):
    (bench.store.folder / "hill-0.png").unlink()
    propose_all([bench])
    told = {card.photo.name: card.confidence for card in bench.cards()}
    assert told["hill-0.png"] is None
    assert told["hill-1.png"] is not None
    assert "hill-0.png" in capsys.readouterr().err


def test_what_is_proposed_to_one_person_is_found_once_for_all(bench, monkeypatch):
    other, found = beside(bench, "bob"), []
    real = Detector.detect
    monkeypatch.setattr(Detector, "detect", lambda *words: found.append(len(found)) or real(*words))
    propose_all([bench, other])
    assert len(found) == 2
    for one in (bench, other):
        assert None not in [card.confidence for card in one.cards()]
    other.finish()


def people(bench, *names):
    return Open(bench.store.folder, annotator=names)._people(bench.store)


def test_several_people_are_remembered_and_a_single_one_is_not(bench, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setattr("getpass.getuser", lambda: "me")
    folder = folder_id(bench.store)
    assert people(bench) == ["me"]
    assert people(bench, "ann", " bob ") == ["ann", "bob"]
    keep_address(folder, Address(port=8000).serving(["ann", "bob"]))
    assert people(bench) == ["ann", "bob"]
    assert people(bench, "eve") == ["eve"]
    keep_address(folder, Address(port=8000).serving(["eve"]))
    assert people(bench) == ["me"]


def test_a_person_has_one_pass_at_a_time(bench):
    with pytest.raises(UsageError, match="ann is named twice"):
        people(bench, "ann", "bob", "ann")
