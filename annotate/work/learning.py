"""Learning while labelling: a bank from the accepted photos proposes for the untouched ones."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from annotate.store.identity import Photo
from annotate.store.labels import Label
from annotate.store.opened import read_whole
from annotate.work.workbench import Workbench
from skyline_viz.config import TrainingConfig
from skyline_viz.detector import Detector
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.filter_bank import FilterBank
from skyline_viz.training import GramMatrices, gather, solve

LEAST = 10
"""Accepted photos that learning needs at least."""

_SEED = 0


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
        config = TrainingConfig(detector=proposes.config)
        halves = [GramMatrices.empty(config), GramMatrices.empty(config)]
        for number, label in enumerate(labels):
            pixels = read_whole(bench.store, photos[label.digest])
            assert label.skyline is not None
            halves[number % 2] += gather(pixels, label.skyline, _SEED, config)
        name = bench.store.folder.resolve().name
        before = self._error(labels, photos, [proposes] * 2)
        learned = [Detector(solve(one, _SEED, config, name), config.detector) for one in halves]
        after = self._error(labels, photos, learned[::-1])  # each on the photos of the other
        says = f"A_err {after:.2f} px on accepted photos it has not seen, now {before:.2f} px"
        if after >= before:
            detail = f"the bank stays as it is: one learned from {len(labels)} photos has {says}."
            return Learning(state="done", detail=detail, changed=0)
        bank: FilterBank = solve(halves[0] + halves[1], _SEED, config, name)
        changed = bench.propose_again(Detector(bank, config.detector))
        detail = f"learned from {len(labels)} photos: {says}; {changed} photos have new proposals."
        return Learning(state="done", detail=detail, changed=changed)

    def _error(
        self, labels: Sequence[Label], photos: dict[str, Photo], detectors: Sequence[Detector]
    ) -> float:
        """Mean A_err of the accepted photos, each by the detector of its half."""
        errors = []
        for number, label in enumerate(labels):
            pixels = read_whole(self._bench.store, photos[label.digest])
            assert label.skyline is not None
            found = detectors[number % 2].detect(pixels).skyline
            errors.append(a_err(found, label.skyline))
        return float(np.mean(errors))
