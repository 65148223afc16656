"""The nearest known word to one that is not known: whatever takes names answers with it."""

import difflib
from collections.abc import Iterable

_ALIKE = 0.65  # of 1: "grey" for "gray", but no "clear" for "lunar"


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word that is most like another one, whatever their case; None if none is.

    >>> nearest("Grya", ["grey", "colour"]), nearest("mauve", ["grey", "colour"])
    ('grey', None)
    """
    folded = {one.casefold(): one for one in known}
    near = difflib.get_close_matches(word.casefold(), list(folded), n=1, cutoff=_ALIKE)
    return folded[near[0]] if near else None


def meant(word: str, known: Iterable[str], among: str) -> str:
    """What somebody may have meant by an unknown word, or what there is.

    Args:
        word: The word.
        known: Words that are known.
        among: What to say before them where none is near.

    >>> meant("detla", ["delta", "v"], "there are"), meant("x", ["delta", "v"], "there are")
    ('did you mean delta?', 'there are delta, v.')
    """
    names = list(known)
    near = nearest(word, names)
    return f"did you mean {near}?" if near else f"{among} {', '.join(names) or 'none'}."
