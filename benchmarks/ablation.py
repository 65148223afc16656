"""What each part of the detector brings, over all sources, each of them left out of training."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.left_out import Models, Results, Variant
from benchmarks.sources import Source
from benchmarks.table import markdown
from skyline_viz import DetectorConfig
from skyline_viz.arrays import F64
from skyline_viz.evaluation.intervals import TAILS, means_resampled
from skyline_viz.evaluation.metrics import GROSS_MISS_SHARE
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.sky_model import SkyModel

DEFAULT = "**default**"
LARGE = "with the large sky model"
WITHOUT_SKY = "without the sky model"

WITHOUT = {
    WITHOUT_SKY: {"sky_weight": 0.0},
    "without edges sought at its boundary": {"sky_edges": 1.0},
    "without the clear-sky term": {"clear_sky": 0.0},
    "without fitted thresholds": {"fit_thresholds": False},
    "with grey edges": {"edge_source": "grey"},
}
"""The default less each of its parts."""


def variants(small: Models, networks: Sequence[Path]) -> list[Variant]:
    """The default first, then what it is compared with.

    Args:
        small: Sky models of the default size that have not seen a place.
        networks: Further ones, which are taken as they are.
    """
    default, paper = DetectorConfig(), DetectorConfig.paper()
    steep = replace(paper, delta=default.delta, link_weight=default.link_weight)
    found = [Variant(DEFAULT, default, small)]
    found += [
        Variant(name, less, small)
        for name, changes in WITHOUT.items()
        if (less := default.with_settings(changes)) != default  # it has the part
    ]
    found.append(Variant(LARGE, default, small.large))
    for path in networks:
        network = SkyModel.load(path)
        found.append(Variant(f"with {path.name}, as it is", default, lambda _, own=network: own))
    found.append(Variant("`paper()`, as steep as the default", steep, small))
    found.append(Variant("`paper()`", paper, small))
    return found


def compared(sources: Sequence[Source], found: Mapping[str, Results]) -> str:
    """One table: near the truth and gross misses of each source, and differences over all."""
    base = found[DEFAULT] or found[WITHOUT_SKY]
    rows = [
        [
            name,
            *(_cell(source, results.get(source.name)) for source in sources),
            *_differences(sources, base, results),
        ]
        for name, results in found.items()
    ]
    to = "the default" if found[DEFAULT] else "the default without the sky model"
    header = ["near, gross", *(one.name for one in sources), "near", "gross", "A_err, capped"]
    return (
        "### What each part brings\n\n"
        "Of each source: photos near the truth, and gross misses. The last columns are differences "
        f"to {to}, over all sources, each of them with the same weight: in percent of the photos, "
        "and for A_err in percent of the height, of which no photo counts more than 5. In brackets "
        "are their 95 % intervals, paired, by the bootstrap over photos and clips. They are bold "
        f"where they do not hold 0.\n\n{markdown(header, rows)}"
    )


def _cell(source: Source, results: Sequence[PhotoResult] | None) -> str:
    if results is None:
        return "not measured"
    gross = sum(one.gross_miss for one in results)
    return f"{sum(source.near(results))}/{len(results)}, {gross}"


def _differences(sources: Sequence[Source], base: Results, results: Results) -> list[str]:
    """Cells of what is more than in the base, in percent."""
    both = [one for one in sources if one.name in base and one.name in results]
    if results is base or not both:
        return [""] * 3
    means, draws = [], []
    for seed, source in enumerate(both):
        values = 100 * (_values(source, results[source.name]) - _values(source, base[source.name]))
        means.append(values.mean(axis=1))
        draws.append([means_resampled(one, source.groups, seed) for one in values])
    ends = np.percentile(np.mean(draws, axis=0), TAILS, axis=1)
    return [_signed(*one) for one in zip(np.mean(means, axis=0), *ends, strict=True)]


def _values(source: Source, results: Sequence[PhotoResult]) -> F64:
    """``(3, n)`` near the truth, gross miss, and error as a share of the height, capped."""
    shares = [min(one.a_err / one.height, GROSS_MISS_SHARE) for one in results]
    gross = [one.gross_miss for one in results]
    return np.array([source.near(results), gross, shares], np.float64)


def _signed(mean: float, low: float, high: float) -> str:
    text = f"{mean:+.2f} ({low:+.2f} to {high:+.2f})"
    return f"**{text}**" if low > 0 or high < 0 else text
