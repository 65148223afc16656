"""Failures of a known cause or place, put into rendered scenes that the detector gets right."""

from dataclasses import dataclass, replace
from functools import cache

import cv2
import numpy as np

from skyline_viz.detection import Detection
from skyline_viz.detector import Detector
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.filter_bank import FilterBank
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline
from testing import injected_places
from testing.detections import WITHOUT_SKY
from testing.injected_places import span

KINDS = ("clear", "desert", "cloudy", "rover")
SIZE = (640, 360)
SCENES = 40  # that are varied
FAMILIAR = 1000  # first of the scenes that the rules were made with
CONSULTED = 7000  # of those by which the rules were checked while they were being made
UNSEEN = 31000  # of those that were first used when the rules stood
NEW = 47000  # of those that were first used when the rules of places stood
TRIES = 60  # for each case that is asked for
DETECTOR = WITHOUT_SKY  # which would mend what is injected
BY_SCORE = replace(DETECTOR.config, v=0.95, clear_sky=0.0)
WITH_FRAMES = replace(DETECTOR.config, frame=0)


@dataclass(frozen=True, eq=False)
class Injected:
    """A failure that was made on purpose."""

    cause: str
    detection: Detection
    truth: Skyline
    columns: tuple[int, int]
    """Where it was made."""


def cases(cause, count, first_scene=FAMILIAR):
    """Yield `count` failures of a cause, always the same ones for scenes that begin at a number."""
    found = 0
    for seed in range(count * TRIES):
        one = inject(cause, seed, first_scene)
        if one is not None:
            yield one
            found += 1
            if found == count:
                return
    raise AssertionError(f"only {found} of {count} cases of {cause}")


def main_cause(one):
    """What the diagnosis says about the segment where a failure was made."""
    first, last = one.columns
    segments = [
        segment
        for segment in diagnose(one.detection, one.truth).segments
        if segment.columns[1] >= first - 5 and segment.columns[0] <= last + 5
    ]
    return max(segments, key=lambda segment: segment.total_error)


def inject(cause, seed, first_scene):
    """A failure of a cause; None where the detector stands it, or was wrong there before."""
    random = np.random.default_rng([seed, len(cause), first_scene])
    kind, number = KINDS[seed % len(KINDS)], first_scene + seed % SCENES
    settings = {"starved bin": BY_SCORE, "misjudged": BY_SCORE, "frame": WITH_FRAMES}
    config = settings.get(cause, DETECTOR.config)
    photo, truth, before = base(kind, number, config)
    made = (MAKERS | PLACE_MAKERS)[cause](random, photo, truth, before)
    if made is None:
        return None
    changed, truth, bank, (first, last) = made
    off = np.abs(before.skyline.rows - base(kind, number, config)[1].rows)
    near = off[max(first - 40, 0) : last + 40]
    most = np.percentile(near, 95) if cause in PLACE_MAKERS else near.max()  # these are wide
    if off.mean() > 4 or most > 4:
        return None  # a photo that was lost before, or a failure where there was one
    detection = Detector(bank, config).detect(changed)
    wrong = np.abs(detection.skyline.rows - truth.rows)[first : last + 1] > 4
    enough = len(wrong) / 3 if cause in PLACE_MAKERS else 8
    return Injected(cause, detection, truth, (first, last)) if wrong.sum() >= enough else None


@cache
def base(kind, number, config):
    """A scene and its detection."""
    scene = render(kind, number, *SIZE)
    return scene.photo, scene.truth, Detector(DETECTOR.bank, config).detect(scene.photo)


def missed_edge(random, photo, truth, before):
    """The ridge fades over a span: sky turns into terrain over tens of rows."""
    first, last = span(random, truth.width, 60, 200)
    reach = int(random.integers(24, 44))
    faded = photo.astype(np.float32)
    share = np.zeros(photo.shape[:2], np.float32)
    for column in range(first, last + 1):
        row = int(truth.rows[column])
        top, bottom = max(row - reach, 0), min(row + reach, len(photo) - 9)
        near = slice(max(column - 8, 0), column + 9)
        sky = photo[max(top - 3, 0) : top + 1, near].reshape(-1, 3).mean(axis=0)
        ground = photo[bottom : bottom + 8, near].reshape(-1, 3).mean(axis=0)
        along = np.linspace(0, 1, bottom - top + 1)[:, None]
        along = along * along * (3 - 2 * along)
        faded[top : bottom + 1, column] = (1 - along) * sky + along * ground
        edge = min(column - first, last - column) / 12
        share[top : bottom + 1, column] = min(edge, 1)
    share = cv2.GaussianBlur(share, (0, 0), 3)[..., None]
    soft = cv2.GaussianBlur(faded, (0, 0), 4)
    mixed = photo * (1 - share) + soft * share
    return mixed.clip(0, 255).astype(np.uint8), truth, before.bank, (first, last)


def starved_bin(random, photo, truth, before):
    """The bins of a span were left out of training: no samples, and a filter that says nothing."""
    return bank_without(random, photo, truth, before, samples=0)


def misjudged(random, photo, truth, before):
    """The bins of a span were trained, and their filters say the wrong thing."""
    return bank_without(random, photo, truth, before, samples=1000)


def bank_without(random, photo, truth, before, samples):
    first, last = span(random, truth.width, 60, 200)
    rows = truth.rows.astype(int)
    near = np.abs(before.edge_rows - rows[before.edge_columns]) <= 2
    near &= (before.edge_columns >= first) & (before.edge_columns <= last)
    silent = np.unique(before.bins[near])
    filters, counts = before.bank.filters.copy(), np.maximum(before.bank.samples, 1000)
    filters[silent], counts[silent] = 0, samples
    bank = FilterBank(filters, counts, before.bank.bins)
    return photo, truth, bank, (first, last)


def too_steep(random, photo, truth, before):
    """A tower steeper than delta stands on the ridge."""
    wide, high = int(random.integers(9, 16)), int(random.integers(50, 100))
    first = int(random.integers(40, truth.width - 60))
    rows, changed = truth.rows.copy(), photo.copy()
    top = int(max(rows[first : first + wide].min() - high, 8))
    for column in range(first, first + wide):
        foot = int(truth.rows[column])
        changed[top : foot + 6, column] = photo[foot + 6 : foot + 40, column].mean(axis=0) * 0.6
        rows[column] = top
    return changed, Skyline(rows=rows), before.bank, (first, first + wide - 1)


def cheaper_path(random, photo, truth, before):
    """A dark band in the sky, from the ridge and back to it: a stronger line than the ridge."""
    first, last = span(random, truth.width, 140, 300)
    away, thick = int(random.integers(24, 40)), int(random.integers(10, 16))
    changed = photo.copy()
    for column in range(first, last + 1):
        share = min(min(column - first, last - column) / (away / 2), 1)
        top = int(max(truth.rows[column] - share * away, 4))
        changed[top : min(top + thick, max(int(truth.rows[column]) - 4, top)), column] = 12
    return changed, truth, before.bank, (first, last)


def at_a_place(paint):
    """The maker of a failure that is painted into the photo."""

    def make(random, photo, truth, before):
        changed, columns = paint(random, photo, truth)
        return changed, truth, before.bank, columns

    return make


def truth_doubtful(random, photo, truth, before):
    """The annotation is shifted over a span."""
    first, last = span(random, truth.width, 60, 220)
    rows = truth.rows.copy()
    rows[first : last + 1] += int(random.integers(6, 13)) * (1 if random.random() < 0.5 else -1)
    shifted = Skyline(rows=rows.clip(0, len(photo) - 1))
    return photo, shifted, before.bank, (first, last)


MAKERS = {
    "missed edge": missed_edge,
    "starved bin": starved_bin,
    "misjudged": misjudged,
    "too steep": too_steep,
    "cheaper path": cheaper_path,
    "truth doubtful": truth_doubtful,
}

PLACE_MAKERS = {place: at_a_place(paint) for place, paint in injected_places.PAINTERS.items()}
