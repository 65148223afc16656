"""The nearest known word."""

from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.system.nearest import meant, nearest

WORDS = st.text("abcdefgh-", min_size=1)


def test_what_was_meant():
    assert meant("papr", ["default", "paper"], "there are") == "did you mean paper?"
    assert meant("PAPER", ["default", "paper"], "there are") == "did you mean paper?"
    assert meant("q", [], "there are") == "there are none."
    assert meant("q", iter(["one", "two"]), "there are") == "there are one, two."


@given(WORDS, st.lists(WORDS))
def test_a_known_word_is_nearest_to_itself(word, others):
    assert nearest(word, [*others, word]) == word
    assert nearest(word, others) in {None, *others}
