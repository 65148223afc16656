"""What follows from the log of a label: which edits hold, its status, its tags, its time.

A state and one more operation give the next state, so nothing is ever folded anew while somebody
works. What can be undone is a history of changes, edits and statuses alike, and undo and redo move
along it. A step remembers the edits before it only if it is one of the last, or one in every so
many: the others are found again from there, so that a long history takes little memory, and undo
little time.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

from pydantic import ValidationError

from annotate.engine.edits import EditError, Edits
from annotate.store.labels import Comment, Status
from annotate.store.lines import Line
from annotate.store.operations import (
    LOGGED,
    Carry,
    Change,
    Consensus,
    Drawn,
    Logged,
    Open,
    Redo,
    SetStatus,
    SetTag,
    Undo,
)

IDLE_SECONDS = 60.0
"""Longer pauses between two operations on a photo count as this long."""

COMMENTED: tuple[Status, ...] = ("needs review", "rejected")
"""Statuses with which a sentence may be said."""

_REMEMBERED = 64  # steps at the end whose edits are known; and every one of so many before them


class LogError(ValueError):
    """A log cannot be read; the message is one sentence that says why."""


@dataclass(frozen=True)
class Step:
    """A change that can be undone."""

    change: Change
    """The edit, or the new status."""

    status: Status
    """The status before it."""

    edits: Edits | None = field(default=None, compare=False)
    """What held before it; None where it is not remembered."""


@dataclass(frozen=True)
class State:
    """Where a label stands."""

    edits: Edits
    """What holds."""

    line: Line | None = field(default=None, compare=False)
    """The line as it was acknowledged; None where there is none."""

    steps: tuple[Step, ...] = ()
    """What can be undone, oldest first."""

    taken: tuple[Change, ...] = ()
    """What was taken back, the next one to redo last."""

    status: Status = "to do"
    """How far it is."""

    tags: tuple[str, ...] = ()
    """What has been noted about the photo."""

    seconds: float = 0.0
    """Time spent on it."""

    at: float | None = None
    """When the last operation was made, as a Unix time; None before the first one."""

    count: int = 0
    """Number of operations."""

    last: int = 0
    """Id of the last operation; 0 before the first one."""

    revision: int = 0
    """Id of the last operation that is more than a look at the photo; 0 before the first one."""

    @property
    def done(self) -> tuple[Drawn, ...]:
        """Edits that hold, oldest first."""
        return tuple(one.change for one in self.steps if not isinstance(one.change, SetStatus))

    @property
    def carried(self) -> str:
        """The photo from which the line is carried over, where nothing else was done to it."""
        if len(self.done) != 1 or not isinstance(self.done[0], Carry):
            return ""
        return self.done[0].name

    @property
    def comment(self) -> Comment | None:
        """What was said with its status; None where nothing was."""
        if self.status not in COMMENTED:
            return None
        for step in reversed(self.steps):
            if isinstance(step.change, SetStatus):
                said = step.change
                return Comment(said.comment, said.by) if said.comment else None
        return None

    @property
    def consensus(self) -> Consensus | None:
        """What the passes have in common that were compared last; None where none were."""
        changes = (one.change for one in reversed(self.steps))
        return next((one for one in changes if isinstance(one, Consensus)), None)

    @property
    def undone(self) -> tuple[Drawn, ...]:
        """Edits that were taken back, the next one to redo last."""
        return tuple(one for one in self.taken if not isinstance(one, SetStatus))

    def after(self, operation: Logged, at: float, number: int, line: Line | None = None) -> State:
        """The state after one more operation.

        Args:
            operation: What is done.
            at: When, as a Unix time.
            number: Its id, larger than all before.
            line: The line after it, where there is one.

        Raises:
            EditError: It makes no sense for the photo.
        """
        looked = isinstance(operation, Open)
        idle = 0.0 if looked or self.at is None else min(max(at - self.at, 0.0), IDLE_SECONDS)
        changes_line = not isinstance(operation, Open | SetTag | SetStatus)
        return replace(
            self._done(operation),
            seconds=self.seconds + idle,
            at=at,
            count=self.count + 1,
            last=number,
            revision=self.revision if looked else number,
            line=line if changes_line or line is not None else self.line,
        )

    def _done(self, operation: Logged) -> State:
        """The state with what an operation changes, but for its place in the log."""
        match operation:
            case Open():
                return self
            case SetTag(tag=tag, on_photo=on_photo):
                tags = tuple(one for one in self.tags if one != tag)
                return replace(self, tags=(*tags, tag) if on_photo else tags)
            case Undo(status=with_status):
                return self._undone(with_status=with_status)
            case Redo(status=with_status):
                return self._redone(with_status=with_status)
            case SetStatus(status=status, comment=words):
                before = self.comment
                same = status == self.status and words in ("", before.text if before else "")
                return self if same else replace(self._changed(operation), taken=self.undone)
            case _:
                return replace(self._changed(operation), taken=())

    def _changed(self, change: Change) -> State:
        """With one more step; what can be redone stays."""
        step = Step(change, self.status, self.edits)
        if isinstance(change, SetStatus):
            status, edits = change.status, self.edits
        else:
            by_itself = isinstance(change, Carry | Consensus)
            status = self.status if by_itself else _touched(self.status)
            edits = change.on(self.edits)
        return replace(self, steps=_thinned((*self.steps, step)), status=status, edits=edits)

    def _undone(self, *, with_status: bool) -> State:
        count = len(self.steps)
        if not with_status:  # past changes of the status, which are then no steps any more
            while count and isinstance(self.steps[count - 1].change, SetStatus):
                count -= 1
        if not count:
            return self if with_status else replace(self, status=_touched(self.status))
        *steps, step = remembered(self.steps[:count], self.edits)
        assert step.edits is not None
        return replace(
            self,
            steps=tuple(steps),
            taken=(*self.taken, step.change),
            edits=step.edits,
            status=step.status if with_status else _touched(self.status),
        )

    def _redone(self, *, with_status: bool) -> State:
        count = len(self.taken)
        if not with_status:
            while count and isinstance(self.taken[count - 1], SetStatus):
                count -= 1
        if not count:
            return self if with_status else replace(self, status=_touched(self.status))
        return replace(self._changed(self.taken[count - 1]), taken=self.taken[: count - 1])


Row = tuple[int, float, str, str]
"""An operation as the store keeps it: id, time, kind, and all of it as JSON."""


def folded(state: State, log: Iterable[Row]) -> State:
    """The state after the operations of a log, without their lines.

    Raises:
        LogError: One of them is unknown, or makes no sense.
    """
    for place, (number, at, kind, body) in enumerate(log, state.count + 1):
        try:
            operation = LOGGED.validate_json(body)
            if operation.kind != kind:
                raise LogError(f"operation {place} of the log is not what it is called.")
            state = state.after(operation, at, number)
        except EditError as error:
            raise LogError(f"operation {place} of the log makes no sense: {error}") from error
        except ValidationError as error:
            raise LogError(
                f"operation {place} of the log ({kind[:40]!r}) is unknown or not whole; a newer "
                "version of this program may have made it."
            ) from error
    return state


def remembered(steps: Sequence[Step], edits: Edits) -> tuple[Step, ...]:
    """Steps of which the last one knows the edits before it.

    Args:
        steps: Steps from the first one on.
        edits: Any edits of the photo, for its size.
    """
    if not steps or steps[-1].edits is not None:
        return tuple(steps)
    known = next((at for at in range(len(steps) - 1, -1, -1) if steps[at].edits is not None), 0)
    before = steps[known].edits or Edits(edits.height, edits.width)
    again = list(steps[:known])
    for place, step in enumerate(steps[known:], known):
        kept = place % _REMEMBERED == 0 or place >= len(steps) - _REMEMBERED
        again.append(replace(step, edits=before if kept else None))
        if not isinstance(step.change, SetStatus):
            before = step.change.on(before)
    return tuple(again)


def _thinned(steps: tuple[Step, ...]) -> tuple[Step, ...]:
    """Steps of which the one that is no longer among the last forgets the edits before it."""
    place = len(steps) - _REMEMBERED - 1
    if place < 0 or place % _REMEMBERED == 0:
        return steps
    return (*steps[:place], replace(steps[place], edits=None), *steps[place + 1 :])


def _touched(status: Status) -> Status:
    """A status after the line has been changed."""
    return status if status in ("needs review", "rejected") else "in progress"
