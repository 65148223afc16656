"""Copies are called by their addresses."""

from pathlib import Path

import pytest

from skyline_viz.storage import copy_names
from skyline_viz.storage.copy_names import by_address, name_of, remember


@pytest.fixture(autouse=True)
def no_others(monkeypatch):
    monkeypatch.setattr(copy_names, "_copies", {})


@pytest.mark.parametrize(
    ("address", "said", "told"),
    [
        ("s3://b/hills", "C holds no photograph.", "s3://b/hills holds no photograph."),
        ("s3://b/hills/", "C/a/b.jpg is empty.", "s3://b/hills/a/b.jpg is empty."),
        ("zip://::h.zip", "a: C/b.jpg: it is, C.", "a: zip://b.jpg::h.zip: it is, zip://::h.zip."),
        ("zip://in::h.zip", "open C/b.jpg.", "open zip://in/b.jpg::h.zip."),
    ],
)
def test_a_path_in_a_copy_is_told_as_its_address(address, said, told):
    copy = Path("/caches/0123") / name_of(address)
    remember(copy, address)
    assert by_address(said.replace("C", str(copy))) == told


def test_all_else_stays():
    remember(Path("/caches/0123/hills"), "s3://b/hills")
    assert by_address("hills: /photos/hills/a.jpg") == "hills: /photos/hills/a.jpg"


def test_a_command_knows_of_no_copies_of_an_earlier_one(say):
    remember(Path("/caches/0123/hills"), "s3://b/hills")
    assert copy_names.has_copies()
    assert say("--version")[0] == 0
    assert not copy_names.has_copies()
