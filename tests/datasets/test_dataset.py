"""A photo of a data set as a file: where it is, how large, and what it is made from."""

import hashlib

import pytest

import skyline_viz as sv
from skyline_viz.datasets.dataset import DatasetItem
from testing.datasets import HEIGHT, MASK, PHOTO, SKYLINE, WIDTH, put


@pytest.fixture
def item(tmp_path):
    return DatasetItem("a", put(tmp_path / "a.png"), put(tmp_path / "a_mask.png", MASK))


def test_an_item_says_where_it_is_and_how_large(item):
    assert item.where == str(item.photo_path)
    assert item.size() == (HEIGHT, WIDTH)
    assert item.has_truth
    assert (item.photo() == PHOTO).all()
    assert item.truth() == SKYLINE


def test_a_photo_alone_has_no_truth(item):
    alone = item.without_truth()
    assert (alone.name, alone.has_truth, alone.truth()) == ("a", False, None)


def test_its_contents_are_those_of_both_files(item):
    files = (item.photo_path, item.truth_path)
    digests = [hashlib.sha256(file.read_bytes()).digest() for file in files]
    assert [*item.contents()] == digests
    assert [*item.without_truth().contents()] == digests[:1]


def test_what_cannot_be_read_is_said(tmp_path):
    gone = DatasetItem("gone", tmp_path / "gone.png")
    with pytest.raises(sv.PhotoError, match=r"gone\.png"):
        gone.size()
    with pytest.raises(FileNotFoundError):
        [*gone.contents()]
