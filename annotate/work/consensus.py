"""The consensus: a pass of its own, in which stands what other passes have in common.

It is made by the program where they agree, and waits for somebody where they do not. What a person
has done in it stays as it is.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import groupby

from annotate.agreement.consensus import Common, common
from annotate.store.history import LogError, State
from annotate.store.kept_states import Request
from annotate.store.labels import CONSENSUS, LONGEST_COMMENT, Label, Status, named
from annotate.store.lines import Line
from annotate.store.operations import Carry, Consensus, SetStatus
from annotate.store.store import StaleError, Store
from annotate.work.choices import runs_of
from skyline_viz.arrays import runs

_SPANS = 5  # spans that a comment names


@dataclass
class Outcome:
    """What became of the photos, by name."""

    accepted: list[str] = field(default_factory=list)
    """All agree."""

    rejected: list[str] = field(default_factory=list)
    """All have rejected them."""

    review: list[tuple[str, str]] = field(default_factory=list)
    """They do not agree, and where that is, in a sentence."""

    kept: list[str] = field(default_factory=list)
    """Somebody has worked on them in the consensus, or they were decided there before."""

    changed: list[str] = field(default_factory=list)
    """Those of them that were labelled anew since, in one of the passes."""

    @property
    def photos(self) -> int:
        """Number of photos."""
        return sum(map(len, (self.accepted, self.rejected, self.kept))) + len(self.review)


@dataclass(frozen=True)
class _Verdict:
    """What the labels of a photo come to."""

    status: Status
    comment: str = ""
    operation: Consensus | None = None
    line: Line | None = None


def make_consensus(store: Store, labels: Iterable[Label], within: float) -> Outcome:
    """Write the consensus of the photos that were decided in two passes or more, photo by photo.

    Args:
        store: The labels, open for writing.
        labels: Labels of the passes that are compared, of photos that are in the folder.
        within: Rows by which lines may differ that agree, in pixels.

    Raises:
        StoreError: That of a photo cannot be kept; those before it are.
    """
    outcome = Outcome()
    ids = {photo.digest: photo.id for photo in store.find()}
    decided = sorted(
        (one for one in labels if one.status in ("accepted", "rejected")),
        key=lambda one: (one.name, one.digest, one.annotator, one.number),
    )
    for (name, digest), grouped in groupby(decided, key=lambda one: (one.name, one.digest)):
        of_photo = list(grouped)
        if len(of_photo) < 2 or digest not in ids:
            continue
        label = store.begin(ids[digest], CONSENSUS, 1)
        try:
            state = store.state(label)
        except LogError:  # it is said where all labels are read
            outcome.kept.append(name)
            continue
        if not _is_free(state):
            outcome.kept.append(name)
            if state.at is not None and any(_changed_after(one, state.at) for one in of_photo):
                outcome.changed.append(name)
            continue
        verdict = _verdict(of_photo, within)
        try:
            store.append_all(_requests(label, state, verdict))
        except StaleError:  # somebody works on it just now
            outcome.kept.append(name)
            continue
        if verdict.status == "needs review":
            outcome.review.append((name, verdict.comment))
        else:
            {"accepted": outcome.accepted, "rejected": outcome.rejected}[verdict.status].append(
                name
            )
    return outcome


def _verdict(labels: Sequence[Label], within: float) -> _Verdict:
    """What labels come to that were all decided."""
    lines = [one for one in labels if one.status == "accepted" and one.skyline is not None]
    names = [named(one.annotator, one.number) for one in lines]
    against = [named(one.annotator, one.number) for one in labels if one.status == "rejected"]
    if not lines:
        return _Verdict("rejected")
    found = common(lines, within)
    comment = _comment(names, against, found)
    skyline = found.line.skyline
    operation = Consensus(
        first=0,
        rows=skyline.rows.astype(int).tolist(),
        origins=runs_of(found.line.origin),
        hidden=runs(~skyline.visible),
        of=names,
        apart=list(found.apart),
    )
    status: Status = "needs review" if comment else "accepted"
    return _Verdict(status, comment, operation, found.line)


def _comment(names: Sequence[str], against: Sequence[str], found: Common) -> str:
    """What they do not agree on, in a sentence; empty where there is nothing."""
    said = []
    if against:
        said.append(f"rejected by {_listed(against)}, accepted by {_listed(names)}")
    if found.apart:
        shown = [f"{a} to {b}" if a < b else f"{a}" for a, b in found.apart[:_SPANS]]
        more = len(found.apart) - len(shown)
        where = f"columns {', '.join(shown)}{f' and {more} more spans' if more else ''}"
        how = f"differ by up to {found.worst:.0f} px" if found.worst else "see the line or not"
        said.append(f"{_listed(names)} {how} in {where}")
    text = "; ".join(said)
    return text if len(text) <= LONGEST_COMMENT else f"{text[: LONGEST_COMMENT - 1]}…"


def _listed(names: Sequence[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _requests(label: int, state: State, verdict: _Verdict) -> list[tuple[Request, Line | None]]:
    """Operations that bring a label to a verdict; none where it is there already."""
    status = SetStatus(
        status=verdict.status, comment=verdict.comment, by=CONSENSUS if verdict.comment else ""
    )
    said = state.comment.text if state.comment else ""
    if (state.status, said, state.consensus) == (
        verdict.status,
        verdict.comment,
        verdict.operation,
    ):
        return []
    asked: list[tuple[Consensus | SetStatus, Line | None]] = [(status, None)]
    if verdict.operation is not None:
        asked = [(verdict.operation, verdict.line), *asked]
    return [
        (_request(label, -1 if place else state.revision, operation), line)
        for place, (operation, line) in enumerate(asked)
    ]


def _request(label: int, revision: int, operation: Consensus | SetStatus) -> Request:
    body = operation.model_dump(mode="json", exclude={"kind"})
    return Request(label, revision, operation.kind, body)


def _is_free(state: State) -> bool:
    """Whether the program may write: nothing is decided, and all that holds is its own."""
    if state.status in ("accepted", "rejected"):
        return False
    after_own = False
    for step in state.steps:
        own = isinstance(step.change, Consensus | Carry)
        if not own and not (after_own and isinstance(step.change, SetStatus)):
            return False
        after_own = isinstance(step.change, Consensus)
    return True


def _changed_after(label: Label, at: float) -> bool:
    """Whether more than a look was taken at a label after a moment."""
    return any(one["at"] > at for one in label.operations if one["kind"] != "open")
