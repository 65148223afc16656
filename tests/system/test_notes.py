"""Notes about photos, and who hears them."""

import pytest

from skyline_viz.system.notes import heard_by, note, once


def test_the_innermost_listener_hears_and_nobody_need_listen():
    note("nobody listens.")
    outer, inner = [], []
    with heard_by(outer.append):
        note("one.")
        with heard_by(inner.append):
            note("two.")
        note("three.")
    note("nobody listens any more.")
    assert (outer, inner) == (["one.", "three."], ["two."])


def test_a_listener_goes_with_its_block_also_when_that_fails():
    heard = []
    with pytest.raises(RuntimeError), heard_by(heard.append):
        raise RuntimeError
    note("too late.")
    assert heard == []


def test_a_sentence_is_heard_once():
    heard = []
    hear = once(heard.append)
    for sentence in ("a.", "b.", "a."):
        hear(sentence)
    assert heard == ["a.", "b."]
