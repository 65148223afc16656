"""Studies of the filter bank: what starved bins do, and the size of the filters."""

from pathlib import Path

import numpy as np

from benchmarks.table import A_ERR_HEADER, a_err_cells, markdown
from skyline_viz import Detector, DetectorConfig, FilterBank, TrainingConfig, open_dataset
from skyline_viz.config import FILTER_SIZES
from skyline_viz.evaluation.cross_validation import cross_validate
from skyline_viz.evaluation.results import PhotoResult, Summary
from skyline_viz.evaluation.tables import untrained
from skyline_viz.filter_bank import STARVED_SAMPLES
from skyline_viz.terrain import solve_terrain
from skyline_viz.training import GramMatrices, gather, pooled, regress

POLICIES: dict[str, tuple[int, ...] | None] = {
    "its own few samples": None,
    "no filter: score 0": (),
    "pooled over strength": (1,),
    "pooled over coherence": (0,),
    "**pooled over both** (default)": (0, 1),
    "pooled over all bins": (0, 1, 2),
}


def studies(web: Path) -> str:
    """Both studies, in two folds over the real photographs."""
    items = [item for item in open_dataset(web) if item.truth_path]
    examples = [(item.photo(), item.truth()) for item in items]
    config = TrainingConfig()
    sums = [GramMatrices.empty(config)] * 2
    for index, (photo, truth) in enumerate(examples):
        sums[index % 2] += gather(photo, truth, 0, config)
    starved = max(int((half.samples < STARVED_SAMPLES).sum()) for half in sums)
    rows = []
    for name, over in POLICIES.items():
        cells = [name]
        for preset in (DetectorConfig.paper(), DetectorConfig()):
            detectors = [Detector(_bank(sums[1 - fold], config, over), preset) for fold in (0, 1)]
            results = [
                PhotoResult.of(
                    item.name, detectors[index % 2].detect(photo).skyline, truth, len(photo)
                )
                for index, (item, (photo, truth)) in enumerate(zip(items, examples, strict=True))
            ]
            summary = Summary.of(results)
            cells += [f"{summary.mean:.3f}", f"{summary.median:.3f}", f"{summary.maximum:.2f}"]
        rows.append(cells)
    header = [
        "a starved bin uses",
        "`paper()` mean",
        "median",
        "max",
        "default mean",
        "median",
        "max",
    ]
    text = (
        f"## Starved bins\n\nOf 288 bins up to {starved} are starved (fewer than "
        f"{STARVED_SAMPLES} samples) with 20 training photographs. A_err in px, two folds; both "
        "columns use the same filter bank, trained with colour edges.\n\n" + markdown(header, rows)
    )
    sizes = []
    for size in FILTER_SIZES[2:]:
        found = cross_validate(items, Detector(untrained(size)), 2)
        assert not found.failures, found.failures
        (results,) = found.results.values()
        sizes.append([f"{size} x {size}", *a_err_cells(Summary.of(results))])
    table = markdown(["filters", *A_ERR_HEADER], sizes)
    return f"{text}\n\n## Filter size (the paper's Table III), default, A_err in px\n\n{table}"


def _bank(gram: GramMatrices, config: TrainingConfig, over: tuple[int, ...] | None) -> FilterBank:
    filters = regress(gram.sums, config.smoothness)
    if over is not None:
        fallback = regress(pooled(gram.sums, config.bins, over), config.smoothness) if over else 0.0
        starved = gram.samples < STARVED_SAMPLES
        filters = np.where(starved[:, None, None], fallback, filters)
    return FilterBank(
        filters=filters.astype(np.float32),
        samples=gram.samples,
        terrain=solve_terrain(gram.terrain),
        bins=config.bins,
    )
