"""Gross misses of three detectors: how many get a cause that names a term, and a remedy."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from benchmarks.left_out import LeftOut, Models, Variant
from benchmarks.sources import RENDERED, Source, sources
from benchmarks.table import markdown
from skyline_viz import DetectorConfig, evaluate
from skyline_viz.diagnosis import Diagnosed, Remedy, diagnose_photos
from skyline_viz.diagnosis.counterfactual import REPAIRED
from skyline_viz.diagnosis.remedies import LARGER
from skyline_viz.evaluation.cross_validation import assign
from skyline_viz.method import Method
from skyline_viz.sky_model import SkyModel

WITHOUT_SKY = replace(DetectorConfig(), sky_weight=0.0)
CONFIGS = {
    "default": DetectorConfig(),
    "default without a sky model": WITHOUT_SKY,
    "`paper()`": DetectorConfig.paper(),
}

EVERY = 3
"""Of frames of clips every third one is taken: neighbours resemble each other, and `paper()` fails
on most of them."""


@dataclass(frozen=True)
class Missed:
    """The gross misses of a detector, diagnosed."""

    photos: int
    """Photos that it was tested on."""

    found: Sequence[Diagnosed]
    """The gross misses."""


def measured(data: Path, models: Path | None) -> str:
    """A line for each detector, and what the causes of all are.

    Filters are learned from the other sources. So is the sky model where MODELS holds it; the
    shipped one, which has seen the photos, stands in where it does not.

    Args:
        data: Folder with the real data sets.
        models: Folder of sky models that have not seen a source.
    """
    given = [
        replace(one, items=one.items[::EVERY]) if one.clips else one
        for one in sources(data)
        if one.place != RENDERED
    ]
    left_out, unseen = LeftOut(given), Models(models)
    every = {}
    for name, config in CONFIGS.items():
        variant = Variant(name, config, lambda place: unseen(place) or SkyModel.small())
        found = [one for source in given for one in _misses(left_out, variant, source)]
        every[name] = Missed(sum(len(source.items) for source in given), found)
    return told(every, unseen.missing(given))


def told(every: dict[str, Missed], missing: str) -> str:
    """The tables.

    Args:
        every: What each detector misses.
        missing: What to say of models that are not there; nothing if all are.
    """
    head = [
        "detector", "photos", "gross misses", "a proved cause names a term", "one setting mends it",
        "one or two do",
    ]  # fmt: skip
    rows = [
        [name, str(one.photos), str(len(one.found)), *_shares(one.found)]
        for name, one in every.items()
    ]
    causes: dict[str, list[Diagnosed]] = {}
    for missed in every.values():
        for one in missed.found:
            causes.setdefault(_title(one), []).append(one)
    ordered = sorted(causes.items(), key=lambda one: -len(one[1]))
    of_causes = [
        [title, *(str(count) for count in (len(of), sum(map(anew, of)), sum(map(mended, of))))]
        for title, of in ordered
    ]
    head_of_causes = ["cause of the worst segment", "photos", "edges found anew", "mended"]
    note = f"\n\n{missing}" if missing else ""
    return (
        f"## Gross misses: how many are explained, and how many are mended\n\n"
        f"{markdown(head, rows)}\n\nThe cause is that of the segment with the largest total error, "
        "and a counterfactual proves it. Settings mend a photo if its A_err is under 5 % of the "
        "height with them: the best of all that are tried on it, or of the pairs of those that "
        "helped most alone. The truth chooses them, so this is what some setting can do, and not "
        "what anybody would have chosen. The larger sky model, which has seen the photos, does not "
        f"count. Of frames of clips every {EVERY}rd is taken.\n\n"
        f"{markdown(head_of_causes, of_causes)}\n\n*Edges found anew*: other Canny thresholds "
        f"around both lines bring at least {REPAIRED:.0%} of the worst segment back.{note}"
    )


def _misses(left_out: LeftOut, variant: Variant, source: Source) -> Iterator[Diagnosed]:
    """The gross misses of a source, diagnosed."""
    detector = left_out.detector(variant, source.place)
    sky = variant.sky(source.place)
    assert detector is not None
    assert sky is not None
    detector = replace(detector, sky=sky)  # a remedy of one without may be to run it
    (results,) = evaluate(source.items, detector, workers=0).results.values()
    gross = {one.name for one in results if one.gross_miss}
    missed = [item for item in source.items if item.name in gross]
    if not missed:
        return
    methods: list[Method] = [detector]
    (tasks,) = assign(missed, methods, None).tasks.values()
    found, failures = diagnose_photos(tasks, workers=0)
    assert not failures, failures
    yield from found


def _shares(missed: Sequence[Diagnosed]) -> list[str]:
    if not missed:
        return ["", "", ""]
    counts = [
        sum(map(explained, missed)),
        sum(map(mended_by_one, missed)),
        sum(map(mended, missed)),
    ]
    return [f"{count} ({count / len(missed):.0%})" for count in counts]


def explained(one: Diagnosed) -> bool:
    """Whether the worst segment of a photo has a cause that is proved, and names a term."""
    main = one.diagnosis.main
    return bool(main and main.terms and main.proof)


def anew(one: Diagnosed) -> bool:
    """Whether edges found anew bring the worst segment of a photo back."""
    main = one.diagnosis.main
    trials = main.trials if main else ()
    return any(trial.thresholds != 1 and trial.repaired >= REPAIRED for trial in trials)


def mended(one: Diagnosed) -> bool:
    """Whether some settings leave a photo no gross miss."""
    return any(not remedy.gross_miss for remedy in _counted(one))


def mended_by_one(one: Diagnosed) -> bool:
    """Whether a single setting does, or a preset."""
    return any(not remedy.gross_miss and not remedy.pair for remedy in _counted(one))


def _counted(one: Diagnosed) -> list[Remedy]:
    return [remedy for remedy in one.remedies if remedy.flags != LARGER]


def _title(one: Diagnosed) -> str:
    main = one.diagnosis.main
    return main.title if main else ""
