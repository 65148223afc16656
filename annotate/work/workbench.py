"""What a server works with: a folder, who labels it and in which order, and its open photos."""

from __future__ import annotations

import threading
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass
from typing import Literal

import numpy as np

from annotate.store.cards import Card, seconds_a_photo
from annotate.store.store import Photo, Store
from annotate.work.joined import Joined, joined
from annotate.work.open_photos import (
    BLIND,
    KEPT,
    SESSION,
    OpenPhotos,
    detection_bytes,
    require_room,
)
from annotate.work.overlays import overlays
from annotate.work.session import Session
from annotate.work.shared_photos import SharedPhotos
from annotate.work.warming import warm_up
from skyline_viz.detection import Detection
from skyline_viz.method import Method
from skyline_viz.photo import PhotoError
from skyline_viz.system.memory import photo_limit

Order = Literal["name", "confidence", "random"]
"""In which order photos are labelled: by name, the least certain first, or shuffled."""

_SMALL = np.repeat(np.arange(64, dtype=np.uint8) // 32 * 200, 96 * 3).reshape(64, 96, 3)


class UnknownPhotoError(LookupError):
    """There is no photo with this id."""


@dataclass(frozen=True)
class Assignment:
    """Who labels, and how."""

    annotator: str
    """Who."""

    number: int = 1
    """1 for the first pass over the photos, 2 for the second."""

    order: Order = "name"
    """In which order."""

    blind: float = 0.0
    """Share of the photos that are labelled without a proposal, in [0, 1]."""

    seed: int = 0
    """Seed of what is random: the order, and which photos are blind."""

    reviewer: str = ""
    """Who looks the pass through, where that is not its annotator; comments are theirs."""


@dataclass(frozen=True)
class Progress:
    """How far a pass over the photos is."""

    done: int
    """Photos that are accepted or rejected."""

    total: int
    """All photos."""

    seconds_a_photo: float | None
    """Mean time of those that are done; None where none of them took any."""

    seconds_left: float | None
    """Time that the others will take."""


class Workbench:
    """A pass of an annotator over the photos of a folder, which others may label meanwhile."""

    def __init__(
        self,
        shared: SharedPhotos,
        detector: Method,
        assignment: Assignment,
    ) -> None:
        """Begin.

        Args:
            shared: The photos, which other people may label at the same time.
            detector: What proposes.
            assignment: Who labels, and how.
        """
        self.shared, self.detector, self.assignment = shared, detector, assignment
        self.store, self.photos, self.doubts = shared.store, shared.by_id, shared.doubts
        self._labels: dict[int, int] = {}
        self._open: OpenPhotos[Session] = OpenPhotos(shared.room)
        self._lock = threading.RLock()
        self._ahead = ThreadPoolExecutor(1, "ahead")
        self._soon = ThreadPoolExecutor(1, "soon")
        if len(shared.room.people) == 1:  # once, before the first gesture asks
            self._soon.submit(warm_up)
        self._detection: tuple[int, int, Detection] | None = None
        chance = np.random.default_rng([assignment.seed, 1])
        drawn = chance.random(len(self.photos)) < assignment.blind
        by_content = sorted(self.photos.values(), key=lambda photo: photo.digest)
        self._blind = {one.id for one, is_blind in zip(by_content, drawn, strict=True) if is_blind}

    def finish(self) -> None:
        """Finish what is being prepared."""
        self._ahead.shutdown(cancel_futures=True)
        self._soon.shutdown(cancel_futures=True)

    def close(self) -> None:
        """Finish what is being prepared, and close the labels, which nobody else may use then."""
        self.finish()
        self.store.close()

    def cards(self) -> list[Card]:
        """All photos of the folder in short, in the order of the assignment."""
        who = self.assignment
        found = self.store.cards(who.annotator, who.number)
        cards = [found[photo] for photo in self.photos if photo in found]
        if who.order == "confidence":
            unknown = float("inf")
            cards.sort(key=lambda card: unknown if card.confidence is None else card.confidence)
        elif who.order == "random":
            places = np.random.default_rng([who.seed, 2]).permutation(len(cards))
            cards = [cards[place] for place in places.tolist()]
        return cards

    def progress(self, cards: list[Card]) -> Progress:
        """How far the pass is, by its `cards`."""
        done = [card for card in cards if card.status in ("accepted", "rejected")]
        each = seconds_a_photo(cards)
        left = None if each is None else each * (len(cards) - len(done))
        return Progress(len(done), len(cards), each, left)

    def photo(self, photo: int) -> Photo:
        """A photo by its id.

        Raises:
            UnknownPhotoError: There is none.
        """
        if photo not in self.photos:
            raise UnknownPhotoError(f"there is no photo number {photo}.")
        return self.photos[photo]

    def label(self, photo: int) -> int:
        """Id of the label of a photo in this pass, which is made where there is none.

        Raises:
            UnknownPhotoError: There is no such photo.
        """
        self.photo(photo)
        with self._lock:
            if photo not in self._labels:
                who, blind = self.assignment, photo in self._blind
                self._labels[photo] = self.store.begin(
                    photo, who.annotator, who.number, blind=blind
                )
            return self._labels[photo]

    def session(self, photo: int) -> Session:
        """A photo, open for labelling.

        Raises:
            UnknownPhotoError: There is none.
            PhotoError: It has vanished, or cannot be read.
        """
        future, mine = self._future(photo)
        if mine:
            self._fill(photo, future)
        return future.result()

    def is_open(self, photo: int) -> bool:
        """Whether a photo is open, so that asking for its session does not wait."""
        waiting = self._open.get(photo)
        return waiting is not None and waiting.done()

    def prepare_after(self, photo: int) -> None:
        """Show a photo, and open the next one to do in the background where both fit."""
        with self._lock:
            if self._detection and self._detection[0] != photo:
                self._detection = None
                self._open.drop_beside()
            if self._open.show(photo):  # else it was asked for again, and the next one is ready
                self._let_go_of_detections(photo)

        def work() -> None:
            cards = self.cards()
            place = next((at for at, one in enumerate(cards) if one.photo.id == photo), 0)
            rest = cards[place + 1 :] + cards[:place]
            most = photo_limit() * 1e6
            waiting = [
                card
                for card in rest
                if card.status == "to do" and card.photo.height * card.photo.width <= most
            ]
            if waiting and self._open.fits(self._bytes(waiting[0].photo.id)):
                following, mine = self._future(waiting[0].photo.id)
                if mine:
                    self._fill(waiting[0].photo.id, following)

        self._ahead.submit(work)

    def refresh(self, session: Session) -> None:
        """Bring a photo's tables up to date in the background, before the next question."""
        self._soon.submit(session.refresh)

    def close_photo(self, photo: int) -> None:
        """Forget an open photo: it is read from the disk again when it is asked for."""
        self._open.close(photo)

    def propose_again(self, detector: Method) -> int:
        """Let another detector propose for the photos nobody has worked on; return how many."""
        self.detector = detector
        waiting = [card for card in self.cards() if card.status == "to do" and not card.blind]
        changed = 0
        for card in waiting:
            self.close_photo(card.photo.id)
            before = card.confidence
            worked_on = self.session(card.photo.id).state.revision > 0  # and undone: it stays
            changed += before is not None and not worked_on
        return changed

    def overlays(self) -> dict[str, str]:
        """What can be laid over a photo: stages and terms of what proposes, and how they read.

        Of a method that refuses so small a photo only the stages that all methods have are known.
        """
        try:
            return overlays(self.detector.detect(_SMALL))
        except Exception:  # of somebody's own method; what is wrong is said where it proposes
            return {one: one.capitalize() for one in ("edges", "score", "cost")}

    def detection(self, session: Session) -> Detection:
        """All stages of an open photo, by the detector that made its proposal.

        They are at hand unless the photo is large or blind; those of one of these are kept if they
        fit.
        """
        photo, held = session.photo.id, session.wire.detection
        if held is not None:
            return held
        with self._lock:
            kept = self._detection
            if kept and kept[:2] == (photo, id(session.detector)):
                return kept[2]
            self._detection = None
        with self.shared.turns:
            found = session.detect()
        with self._lock:
            if self._open.keep_beside(photo, detection_bytes(found)):
                self._detection = (photo, id(session.detector), found)
        return found

    def joined(self) -> Joined:
        """Labels of this pass, joined to the photos that are in the folder now."""
        who = self.assignment
        with closing(Store(self.store.folder, of=self.store)) as store:
            return joined(store, who.annotator, who.number)

    def _let_go_of_detections(self, shown: int) -> None:
        """Only the photo that is shown keeps its detection, and the next one will."""
        for photo in self._open.open:
            if photo != shown and self.is_open(photo):
                session = self.session(photo)
                session.wire.detection = None
                self._count(session)

    def _count(self, session: Session) -> None:
        """Count what an open photo really takes: most have far fewer edges than is allowed for."""
        one, held = session.photo, session.wire.detection
        own = one.height * one.width * (BLIND if session.blind else SESSION)
        self._open.lighten(one.id, own + (detection_bytes(held) if held else 0))

    def _future(self, photo: int) -> tuple[Future[Session], bool]:
        """What an open photo will be, and whether the caller has to open it."""
        return self._open.take(photo, self._bytes(photo))

    def _bytes(self, photo: int) -> int:
        """Bytes that a photo takes while it is open."""
        one = self.photo(photo)
        each = BLIND if photo in self._blind else SESSION + (KEPT if self._open.keeps(one) else 0)
        return one.height * one.width * each

    def _fill(self, photo: int, future: Future[Session]) -> None:
        try:
            label = self.label(photo)
            blind = self.store.is_blind(label)
            with self.shared.turns:
                self._require_room(photo, blind=blind)
                one = self.photo(photo)
                session = Session(
                    self.shared,
                    one,
                    label,
                    self.detector,
                    blind=blind,
                    keep=self._open.keeps(one),
                    by=self.assignment.reviewer or self.assignment.annotator,
                )
            self._count(session)
            future.set_result(session)
        except BaseException as error:
            self.close_photo(photo)
            future.set_exception(error)

    def _require_room(self, photo: int, *, blind: bool) -> None:
        """Refuse a photo that does not fit into the memory, even with others closed.

        Raises:
            PhotoError: It does not fit.
        """
        if blind:
            return
        one = self.photo(photo)
        keep = self._open.keeps(one)
        for others in (False, True):  # what other people are shown is closed last
            try:
                require_room(one, keep=keep)
            except PhotoError:
                self._open.close_others(photo, shown=others)
            else:
                return
        require_room(one, keep=keep)
