"""The accepted line of a neighbour, proposed on a photo that shows the same place."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from annotate.engine.carried import carried_over
from annotate.engine.edits import EditError
from annotate.store.database import StoreError
from annotate.store.labels import NO_SKYLINE
from annotate.store.opened import read_whole
from annotate.store.operations import Carry
from annotate.store.store import Photo, StaleError
from annotate.work.session import Session
from annotate.work.workbench import Workbench
from skyline_viz.constraints import PathError
from skyline_viz.photo import PhotoError


def carry_over(bench: Workbench, session: Session) -> None:
    """Propose the line of a neighbour on a photo on which nobody has worked, where they overlap.

    Where that cannot be found out or kept, the proposal stays that of the detector.

    Args:
        bench: The photos.
        session: The photo, which is about to be shown.
    """
    if session.blind or session.state.revision:
        return
    with session.lock:
        for photo, label in _accepted_beside(bench, session.photo):
            with suppress(PathError, EditError, PhotoError, StoreError, StaleError):
                if _carry(bench, session, photo, label):
                    return


def _carry(bench: Workbench, session: Session, photo: Photo, label: int) -> bool:
    """Whether a photo overlaps with its neighbour, whose line is proposed then."""
    line = bench.store.line(label)
    key = photo.id, bench.store.state(label).revision
    if line is None or key in session.compared:
        return False
    session.compared.add(key)
    opened = bench.session(photo.id).pixels if bench.is_open(photo.id) else None
    before = read_whole(bench.store, photo) if opened is None else opened
    stroke = carried_over(before, line.skyline, session.pixels)
    if stroke is None:
        return False
    name = photo.name.encode("utf-8", "replace").decode("utf-8")
    session.carry(Carry(points=list(stroke.points), radius=stroke.radius, name=name))
    return True


def _accepted_beside(bench: Workbench, photo: Photo) -> Iterator[tuple[Photo, int]]:
    """The photos before and after one by name, with their labels, where accepted and as large."""
    who = bench.assignment
    order = list(bench.photos)
    place = order.index(photo.id)
    cards = bench.store.cards(who.annotator, who.number)
    for beside in (*order[max(place - 1, 0) : place], *order[place + 1 : place + 2]):
        card = cards.get(beside)
        if card is None or card.label is None or card.status != "accepted":
            continue
        if NO_SKYLINE in card.tags:  # nothing of its line counts
            continue
        if (card.photo.height, card.photo.width) == (photo.height, photo.width):
            yield card.photo, card.label
