"""Tasks: what is kept of them, and which failures are told once."""

import numpy as np

import skyline_viz as sv
from skyline_viz.detector import Detector
from skyline_viz.evaluation.tasks import compare_photos, photo_tasks
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.running.resume import Kept


def test_a_digest_of_the_method_is_made_only_where_results_are_kept(items, tmp_path):
    pairs = [(items[0], Detector()), (items[1], EdgesOnly())]
    assert {task.digest for task in photo_tasks(pairs)} == {""}
    digests = [task.digest for task in photo_tasks(pairs, Kept(tmp_path))]
    assert len(set(digests)) == 2
    assert "" not in digests


def test_results_in_memory_are_kept_as_those_of_files_are(items, tmp_path):
    loaded = [sv.LoadedItem(one.name, one.photo(), one.truth()) for one in items[:2]]
    kept = Kept(tmp_path)
    first, _ = compare_photos(photo_tasks([(one, EdgesOnly()) for one in loaded], kept), kept=kept)
    assert kept.known == 0
    again, _ = compare_photos(photo_tasks([(one, EdgesOnly()) for one in loaded], kept), kept=kept)
    assert kept.known == 2
    assert again == first
    for one, other in zip(again, first, strict=True):
        np.testing.assert_array_equal(one.errors, other.errors)
    moved = sv.LoadedItem(loaded[0].name, loaded[0].pixels, loaded[1].skyline)
    compare_photos(photo_tasks([(moved, EdgesOnly())], kept), kept=kept)
    assert kept.known == 2
