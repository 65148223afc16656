"""What was found about passes, as files for other programs: ``agreement.json``, ``photos.csv``."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from annotate.agreement.figures import WITHIN, Agreement, by_making, lean, people
from annotate.agreement.pairs import Comparison, Pair, Pass
from annotate.store.labels import named
from skyline_viz.evaluation.intervals import Interval
from skyline_viz.files import make_folder, write_text

FORMAT = "skyline-agreement"
"""What ``agreement.json`` says that it is."""


def write_tables(comparisons: Sequence[Comparison], passes: Sequence[Pass], folder: Path) -> None:
    """Write all figures as JSON, and a row for each photo and two passes as CSV.

    Args:
        comparisons: Passes that were compared.
        passes: All of them.
        folder: Where to; it is made, and files of before are replaced.
    """
    rows = [row for one in comparisons for row in _photos(one)]
    bias = lean(comparisons)
    document = {
        "format": FORMAT,
        "version": 1,
        "passes": [{"annotator": who, "number": number} for who, number in passes],
        "pairs": [_pair(one) for one in comparisons],
        "people": [
            {"annotator": one.name, "alone": _told(one.alone), "others": _told(one.others)}
            for one in people(comparisons)
        ],
        "made": {made: _told(one) for made, one in by_making(comparisons).items()},
        "proposed_below_blind": bias and {"mean": bias[0], "interval": _interval(bias[1])},
        "photos": rows,
    }
    make_folder(folder)
    write_text(folder / "agreement.json", json.dumps(document, indent=1) + "\n")
    text = io.StringIO()
    table = csv.DictWriter(text, list(rows[0]) if rows else ["photo"], lineterminator="\n")
    table.writeheader()
    table.writerows(rows)
    write_text(folder / "photos.csv", text.getvalue())


def _pair(one: Comparison) -> dict[str, Any]:
    return {
        "first": named(*one.first),
        "second": named(*one.second),
        "decided_otherwise": one.decided_otherwise,
        **(_told(Agreement.of(one.pairs)) or {"photos": 0}),
    }


def _told(one: Agreement | None) -> dict[str, Any] | None:
    if one is None:
        return None
    within = {f"within_{most}": share for most, share in zip(WITHIN, one.within, strict=True)}
    figures = {name: getattr(one, name) for name in ("photos", "columns", "mean", "worst", "kappa")}
    return {**figures, "interval": _interval(one.interval), **within}


def _interval(interval: Interval) -> list[float]:
    return [interval.low, interval.high]


def _photos(one: Comparison) -> Iterator[dict[str, Any]]:
    """A row for each photo, as both files have it; None where there is no number."""
    for pair in one.pairs:
        yield {
            "photo": pair.first.name.encode("utf-8", "replace").decode(),
            "sha256": pair.first.digest,
            "first": named(*one.first),
            "second": named(*one.second),
            "made": pair.made,
            "columns": len(pair.differences),
            **_differences(pair),
            "seen_by_both": int(pair.seen[1, 1]),
            "seen_by_first": int(pair.seen[1, 0]),
            "seen_by_second": int(pair.seen[0, 1]),
            "seen_by_none": int(pair.seen[0, 0]),
        }


def _differences(pair: Pair) -> dict[str, Any]:
    some = bool(len(pair.differences))
    first, last = pair.span(WITHIN[0]) or (None, None)
    return {
        "mean": None if math.isnan(pair.mean) else pair.mean,
        "worst": pair.worst if some else None,
        **{f"within_{most}": _share(pair, most) for most in WITHIN},
        "lower": float(pair.differences.mean()) if some else None,
        "first_column": first,
        "last_column": last,
    }


def _share(pair: Pair, most: int) -> float | None:
    return float((pair.apart <= most).mean()) if len(pair.differences) else None
