"""A state as bytes: it comes back whole, or counts as none."""

import zlib

import pytest
from hypothesis import given

from annotate.engine.edits import Edits
from annotate.store.checkpoints import packed, unpacked
from annotate.store.history import folded
from testing.logs import EMPTY, HEIGHT, WIDTH, edits, logs, new_moves, old_moves, others


@given(logs(edits, others, old_moves, new_moves, most=20))
def test_every_state_comes_back(kept):
    state = folded(EMPTY, kept)
    assert unpacked(packed(state, 7), 7, EMPTY.edits) == state


def test_another_label_or_another_photo_has_none():
    data = packed(EMPTY, 7)
    assert unpacked(data, 7, EMPTY.edits) == EMPTY
    assert unpacked(data, 8, EMPTY.edits) is None
    assert unpacked(data, 7, Edits(HEIGHT, WIDTH + 1)) is None


@pytest.mark.parametrize(
    "data",
    [None, 7, b"", b"text", zlib.compress(b"{}"), zlib.compress(b"[1]"), packed(EMPTY, 7)[:-4]],
)
def test_what_is_damaged_counts_as_none(data):
    assert unpacked(data, 7, EMPTY.edits) is None


def test_a_checkpoint_with_more_in_it_is_of_another_version():
    text = zlib.decompress(packed(EMPTY, 7)).decode()
    for changed in (text.replace('"version":1', '"version":2'), text[:-1] + ',"more":1}'):
        assert changed != text
        assert unpacked(zlib.compress(changed.encode()), 7, EMPTY.edits) is None


def test_a_checkpoint_of_before_reasons_counts():
    state = folded(EMPTY, [(1, 1.0, "hidden", '{"kind": "hidden", "first": 3, "last": 9}')])
    text = zlib.decompress(packed(state, 7)).decode()
    old = text.replace('"hidden":[[3,9,""]]', '"hidden":[[3,9]]')
    assert old != text
    assert unpacked(zlib.compress(old.encode()), 7, EMPTY.edits) == state
