"""Learning while labelling: a bank from the accepted photos proposes for the untouched ones."""

from __future__ import annotations

import threading
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from annotate.store.identity import Photo
from annotate.store.opened import read_whole
from annotate.store.store import Store
from annotate.work.workbench import Workbench
from skyline_viz.arrays import F64, U8
from skyline_viz.detector import Detector
from skyline_viz.evaluation.cross_validation import cross_validate, evaluate
from skyline_viz.evaluation.evaluated import Evaluation
from skyline_viz.evaluation.training_runs import train_on
from skyline_viz.skyline import Skyline

LEAST = 10
"""Accepted photos that learning needs at least."""

GOOD = 5
"""A_err in pixels under which a proposal counts as good."""


@dataclass(frozen=True)
class Learning:
    """How far learning from the labels is."""

    state: Literal["idle", "running", "done", "failed"]
    detail: str
    """What happens or came of it, in words."""

    changed: int
    """Photos that have new proposals."""


class Learner:
    """Learns in the background, one run at a time.

    A bank is taken over only if it does better than the present one on accepted photos that it has
    not seen (two-fold cross-validation). So a handful of labels can do no harm.
    """

    def __init__(self, bench: Workbench) -> None:
        self._bench = bench
        self._lock = threading.Lock()
        self._now = Learning(state="idle", detail="", changed=0)

    def now(self) -> Learning:
        """How far it is."""
        with self._lock:
            return self._now

    def start(self) -> None:
        """Begin, unless it is at work."""
        with self._lock:
            if self._now.state == "running":
                return
            self._now = Learning(state="running", detail="reading accepted photos.", changed=0)
        threading.Thread(target=self._work, name="learning", daemon=True).start()

    def _work(self) -> None:
        try:
            done = self._learn()
        except Exception as error:  # shown on the page, whatever it is
            done = Learning(state="failed", detail=f"{error}", changed=0)
        with self._lock:
            self._now = done

    def _learn(self) -> Learning:
        bench = self._bench
        joined = bench.joined()
        photos = {photo.digest: photo for photo in joined.photos if photo.id in bench.photos}
        labels = [
            one
            for one in joined.labels
            if one.digest in photos
            and one.status == "accepted"
            and one.skyline
            and one.skyline.visible.any()
        ]
        if len(labels) < LEAST:
            found = len(labels)
            detail = f"learning needs {LEAST} accepted photos, and there are {found}."
            return Learning(state="failed", detail=detail, changed=0)
        proposes = bench.detector
        if not isinstance(proposes, Detector):
            detail = (
                f"the method {proposes.name} proposes here, and only our own learns on the way."
            )
            return Learning(state="failed", detail=detail, changed=0)
        items = [
            _Accepted(f"{number:09}", bench.store, photos[one.digest], one.skyline)
            for number, one in enumerate(labels)
            if one.skyline
        ]
        before = _errors(evaluate(items, proposes))
        after = _errors(cross_validate(items, proposes, folds=2))
        if after.mean() >= before.mean():
            says = told(before, after, ("now", "with it"))
            detail = f"the bank stays as it is: one learned from {len(labels)} photos has {says}."
            return Learning(state="done", detail=detail, changed=0)
        name = bench.store.folder.resolve().name
        bank, _ = train_on(items, proposes.training, dataset=name)
        changed = bench.propose_again(replace(proposes, bank=bank))
        says = told(before, after, ("before", "now"))
        detail = f"learned from {len(labels)} photos: {says}; {changed} photos have new proposals."
        return Learning(state="done", detail=detail, changed=changed)


@dataclass(frozen=True)
class _Accepted:
    """An accepted photo as an item to learn from: its pixels are read each time."""

    name: str
    store: Store
    file: Photo
    skyline: Skyline

    def photo(self) -> U8:
        return read_whole(self.store, self.file)

    def truth(self) -> Skyline:
        return self.skyline


def told(before: F64, after: F64, when: tuple[str, str]) -> str:
    """How good proposals are without and with learned filters, on photos these have not seen.

    Args:
        before: ``(n,)`` A_err of each photo without them, in pixels.
        after: ``(n,)`` the same with them.
        when: Words for both.

    Examples:
        >>> told(np.array([3.0, 432.0]), np.array([2.5, 264.0]), ("before", "now")).split("; ")[0]
        'mean A_err 218 px before, 133 px now'
    """
    figures = (
        ("mean A_err", np.mean, " px"),
        ("median", np.median, " px"),
        (f"under {GOOD} px", lambda errors: 100 * np.mean(errors < GOOD), " %"),
    )
    both = tuple(zip((before, after), when, strict=True))
    parts = [
        f"{name} {', '.join(f'{_short(float(of(errors)))}{unit} {word}' for errors, word in both)}"
        for name, of, unit in figures
    ]
    return f"{'; '.join(parts)} (photos that it has not seen)"


def _short(value: float) -> str:
    """A number without digits that tell nothing."""
    return f"{value:.1f}" if value < 10 and value != round(value) else f"{value:.0f}"


def _errors(found: Evaluation) -> F64:
    """A_err of each photo by the only method.

    Raises:
        ValueError: A photo failed.
    """
    if found.failures:
        raise ValueError(found.failures[0].reason)
    (results,) = found.results.values()
    return np.array([one.a_err for one in results])
