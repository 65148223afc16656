"""Photos of a gallery: in which order they are shown, and how they are kept."""

import json
from dataclasses import asdict, replace

import pytest

from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.gallery.documents import GalleryError
from skyline_viz.gallery.entry import Entry, by_need, read_entry
from skyline_viz.gallery.store import VERSION, Gallery
from skyline_viz.stage import OURS

VERDICT = Verdict(1.0, 3, 9.0, False, ((0, 4),), 1.5, 7)
ENTRY = Entry("a", "a.png", "x", 60, 70, VERDICT, OURS, causes=("too steep",), titles=("t",))


def test_without_a_truth_the_least_sure_come_first():
    entries = [
        Entry(name, "", "", 9, 9, Verdict(a_err, None, None, None, None, margin, 0))
        for name, margin, a_err in (("a", 3, None), ("b", 0.5, None), ("c", 9, 0.1), ("d", 9, 7))
    ]
    assert [one.name for one in by_need(entries)] == ["d", "c", "b", "a"]


def test_what_the_second_method_makes_worse_comes_first_and_what_it_mends_last():
    entries = [
        replace(ENTRY, name=name, compared="paper", other_a_err=error, difference=2.0)
        for name, error in (("better", 0.2), ("worse", 8.0), ("level", 1.0))
    ]
    assert [one.name for one in by_need(entries)] == ["worse", "level", "better"]
    assert [one.change for one in entries] == pytest.approx([-0.8, 7.0, 0.0])
    assert ENTRY.change is None


def test_what_is_kept_is_read_again(tmp_path):
    kept = json.loads(json.dumps(asdict(ENTRY)))
    assert read_entry(tmp_path, kept) == ENTRY


def test_an_index_with_unknown_fields_is_damaged(tmp_path):
    text = json.dumps({"version": VERSION, "photos": [{"name": "a", "colour": "red"}]})
    (tmp_path / "gallery.json").write_text(text)
    with pytest.raises(GalleryError, match="damaged"):
        Gallery(tmp_path).entries()
