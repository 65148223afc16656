"""Labels in short, as lists of photos show them."""

import sqlite3
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from annotate.store.identity import Photo
from annotate.store.labels import Comment
from annotate.store.standings import Standing

_WORK = 0.5  # seconds: nobody looks at a photo for less
_NOBODY: Mapping[int, tuple[str, ...]] = MappingProxyType({})


@dataclass(frozen=True)
class Card:
    """A label in short, as lists show it."""

    photo: Photo
    label: int | None
    """Its id; None where nobody has begun."""

    status: str
    tags: tuple[str, ...]
    confidence: float | None
    """Probability that the proposal is no gross miss; None where there is none yet."""

    blind: bool
    seconds: float
    comment: Comment | None = None
    problem: str = ""
    """A sentence that says why its log cannot be read, if so."""

    finished_by: tuple[str, ...] = ()
    """Other passes that have accepted or rejected the photo. What they found is told nowhere."""


def seconds_a_photo(cards: Iterable[Card]) -> float | None:
    """Mean time of the photos that are accepted or rejected; None where none of them took any.

    That is before the first one, and where all were decided unopened: by a program, or several at
    once. Nothing tells then how long the others will take.
    """
    taken = [card.seconds for card in cards if card.status in ("accepted", "rejected")]
    return sum(taken) / len(taken) if max(taken, default=0.0) >= _WORK else None


@dataclass(frozen=True)
class _Begun:
    """What the table of labels says of a label."""

    label: int | None = None
    confidence: float | None = None
    blind: bool = False


def labels_of_pass(
    database: sqlite3.Connection, annotator: str, number: int
) -> Mapping[int, _Begun]:
    """Labels of a pass, by the id of their photo."""
    rows = database.execute(
        "SELECT photo, id, confidence, blind FROM labels WHERE annotator = ? AND number = ?",
        (annotator, number),
    )
    return {
        photo: _Begun(label, confidence, bool(blind)) for photo, label, confidence, blind in rows
    }


def cards_of(
    photos: Iterable[Photo],
    begun: Mapping[int, _Begun],
    stand: Mapping[int, Standing],
    unreadable: Mapping[int, str],
    finished: Mapping[int, tuple[str, ...]] = _NOBODY,
) -> dict[int, Card]:
    """A card for each photo, by its id.

    Args:
        photos: The photos.
        begun: The labels of a pass, as `labels_of_pass` gives them.
        stand: Where labels stand, by their id.
        unreadable: Why logs could not be read, by the id of their label; this counts more.
        finished: Other passes that are done with a photo, by its id.
    """
    cards = {}
    for photo in photos:
        one = begun.get(photo.id, _Begun())
        where = stand.get(one.label or 0, Standing())
        if one.label is not None and one.label in unreadable:  # its standing may look well
            where = Standing("needs review", problem=unreadable[one.label])
        cards[photo.id] = Card(
            photo,
            one.label,
            confidence=one.confidence,
            blind=one.blind,
            finished_by=finished.get(photo.id, ()),
            **vars(where),
        )
    return cards
