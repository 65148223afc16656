"""Gross misses of three detectors: how many get a cause that names a term, and a remedy."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from benchmarks.left_out import LeftOut, Models, Variant
from benchmarks.sources import RENDERED, Source, sources
from benchmarks.table import markdown
from skyline_viz import DetectorConfig, evaluate
from skyline_viz.diagnosis import Diagnosed, diagnose_photos
from skyline_viz.evaluation.cross_validation import assign
from skyline_viz.method import Method
from skyline_viz.sky_model import SkyModel

WITHOUT_SKY = replace(DetectorConfig(), sky_weight=0.0)
CONFIGS = {
    "default": DetectorConfig(),
    "default without a sky model": WITHOUT_SKY,
    "`paper()`": DetectorConfig.paper(),
}


def measured(data: Path, models: Path | None) -> str:
    """A line for each detector, and what the causes of all are.

    Filters are learned from the other sources. So is the sky model where MODELS holds it; the
    shipped one, which has seen the photos, stands in where it does not.

    Args:
        data: Folder with the real data sets.
        models: Folder of sky models that have not seen a source.
    """
    given = [source for source in sources(data) if source.place != RENDERED]
    left_out, unseen = LeftOut(given), Models(models)
    rows, titles = [], Counter[str]()
    for name, config in CONFIGS.items():
        variant = Variant(name, config, lambda place: unseen(place) or SkyModel.small())
        missed = [one for source in given for one in _misses(left_out, variant, source)]
        titles.update(_title(one) for one in missed)
        rows.append([name, str(len(missed)), *_shares(missed)])
    head = ["detector", "gross misses", "a proved cause names a term", "a setting mends it"]
    causes = [[title, str(count)] for title, count in titles.most_common()]
    title = "## Gross misses: how many are explained, and how many are mended"
    note = f"\n\n{missing}" if (missing := unseen.missing(given)) else ""
    return (
        f"{title}\n\n{markdown(head, rows)}\n\nThe cause is that of the segment with the largest "
        "total error, and a counterfactual proves it. A setting mends a photo if its A_err is "
        "under 5 % of the height with it.\n\n"
        f"{markdown(['cause of the worst segment', 'photos'], causes)}{note}"
    )


def _misses(left_out: LeftOut, variant: Variant, source: Source) -> Iterator[Diagnosed]:
    """The gross misses of a source, diagnosed."""
    detector = left_out.detector(variant, source.place)
    assert detector is not None
    (results,) = evaluate(source.items, detector, workers=0).results.values()
    gross = {one.name for one in results if one.gross_miss}
    missed = [item for item in source.items if item.name in gross]
    methods: list[Method] = [detector]
    (tasks,) = assign(missed, methods, None).tasks.values()
    found, failures = diagnose_photos(tasks, workers=0)
    assert not failures, failures
    yield from found


def _shares(missed: Sequence[Diagnosed]) -> list[str]:
    if not missed:
        return ["", ""]
    named = sum(explained(one) for one in missed)
    mended = sum(any(not remedy.gross_miss for remedy in one.remedies) for one in missed)
    return [f"{count} ({count / len(missed):.0%})" for count in (named, mended)]


def explained(one: Diagnosed) -> bool:
    """Whether the worst segment of a photo has a cause that is proved, and names a term."""
    main = one.diagnosis.main
    return bool(main and main.terms and main.proof)


def _title(one: Diagnosed) -> str:
    main = one.diagnosis.main
    return main.title if main else ""
