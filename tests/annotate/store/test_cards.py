"""Labels in short: one card a photo, whoever has begun."""

import pytest

from annotate.store.cards import cards_of, labels_of_pass, seconds_a_photo
from annotate.store.standings import Standing
from annotate.store.store import Store
from testing.labelling import write_hills


@pytest.fixture
def store(tmp_path):
    store = Store(write_hills(tmp_path, count=3))
    store.find()
    yield store
    store.close()


def test_photos_that_nobody_has_begun_are_to_do(store):
    store.begin(1, "ann", 1, blind=True)
    store.begin(2, "bob", 1)
    begun = labels_of_pass(store._connection, "ann", 1)
    cards = cards_of(store.photos(), begun, {}, {})
    assert [card.photo.name for card in cards.values()] == [
        "hill-0.png",
        "hill-1.png",
        "hill-2.png",
    ]
    assert [(card.label, card.blind, card.status) for card in cards.values()] == [
        (1, True, "to do"),
        (None, False, "to do"),
        (None, False, "to do"),
    ]


def test_a_card_says_where_its_own_label_stands(store):
    labels = [store.begin(photo, "ann", 1) for photo in (1, 2)]
    begun = labels_of_pass(store._connection, "ann", 1)
    stand = {labels[1]: Standing("accepted", ("fog",), 3.5)}
    cards = cards_of(store.photos(), begun, stand, {labels[0]: "it is damaged."})
    assert (cards[1].status, cards[1].problem) == ("needs review", "it is damaged.")
    assert (cards[2].status, cards[2].tags, cards[2].seconds) == ("accepted", ("fog",), 3.5)
    assert (cards[3].status, cards[3].problem) == ("to do", "")


def test_how_long_a_photo_takes_is_not_known_from_those_that_took_no_time(store):
    labels = [store.begin(photo, "ann", 1) for photo in (1, 2, 3)]
    begun = labels_of_pass(store._connection, "ann", 1)

    def taken(*standings):
        stand = dict(zip(labels, standings, strict=False))
        return seconds_a_photo(cards_of(store.photos(), begun, stand, {}).values())

    assert taken(Standing("in progress", (), 9.0)) is None
    assert taken(Standing("accepted"), Standing("rejected")) is None  # at once, and unopened
    assert taken(Standing("accepted", (), 0.004)) is None  # by a program, in two steps
    assert taken(Standing("accepted", (), 3.0), Standing("rejected", (), 5.0)) == 4.0
