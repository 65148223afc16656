"""Studies of the filter bank: how filters are learned, whole data sets left out, and their size."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce
from operator import add
from pathlib import Path

import numpy as np
import numpy.typing as npt

from benchmarks.table import A_ERR_HEADER, a_err_cells, markdown
from skyline_viz import Detector, DetectorConfig, TrainingConfig, open_dataset
from skyline_viz.arrays import F32, Int
from skyline_viz.config import FILTER_SIZES
from skyline_viz.datasets.item import Item, LoadedItem, photo_and_truth
from skyline_viz.edges import candidate_edges, edge_pixels, to_grey
from skyline_viz.evaluation.cross_validation import cross_validate
from skyline_viz.evaluation.paper_tables.tables import untrained
from skyline_viz.evaluation.results import Summary
from skyline_viz.rendering import KINDS, render
from skyline_viz.score import score_at
from skyline_viz.sky_model import SkyModel
from skyline_viz.tensor import tensor_at
from skyline_viz.training import gather_item, solve, together

REAL = ("web_dataset", "mountains", "uav")
"""Folders of real photographs; those that are missing are left out."""

SEEDS = range(2000, 2008)
"""Seeds of the rendered scenes, for each kind."""

OURS = TrainingConfig()
AS_PUBLISHED = replace(TrainingConfig.of(DetectorConfig.paper()), detector=OURS.detector)

RULES: dict[str, tuple[TrainingConfig, bool]] = {
    "the true pixels, each bin alone": (
        replace(AS_PUBLISHED, pooling=0),
        False,
    ),
    "bins pooled for 50 samples (`paper()`)": (AS_PUBLISHED, False),
    "and data sets counted alike": (AS_PUBLISHED, True),
    "and the edges nearest to the truth": (replace(AS_PUBLISHED, reach=OURS.reach), True),
    "and pooled for 1,000": (replace(OURS, smoothness=AS_PUBLISHED.smoothness), True),
    "**and smoothness 100,000** (default)": (OURS, True),
    "pooled for 10,000": (replace(OURS, pooling=1e4), True),
    "smoothness 1,000,000": (replace(OURS, smoothness=1e6), True),
}
"""How filters are learned: settings, and whether data sets count alike. Each line that begins with
"and" adds to the one before it; the last two vary the default."""


@dataclass(frozen=True, eq=False)
class _Edges:
    """Edge pixels of a photo that lie on the skyline, or clearly off it."""

    grey: npt.NDArray[np.uint8]
    rows: Int
    columns: Int
    bins: Int
    on_line: npt.NDArray[np.bool_]

    @classmethod
    def of(cls, item: Item, tolerance: int) -> "_Edges":
        photo, truth = photo_and_truth(item)
        edges, _ = candidate_edges(photo, OURS.detector)
        rows, columns = edge_pixels(edges)
        off = np.abs(rows - truth.pixel_rows(len(photo))[columns])
        told = truth.visible[columns] & ((off <= tolerance) | (off > OURS.band))
        rows, columns, off = rows[told], columns[told], off[told]
        bins = OURS.bins.of(tensor_at(photo, rows, columns))
        return cls(to_grey(photo), rows, columns, bins, off <= tolerance)

    def told_apart(self, filters: F32) -> float:
        """Area under the curve: how often an edge on the line scores above one off it."""
        scores = score_at(self.grey, self.rows, self.columns, self.bins, filters)
        low = np.sort(scores[~self.on_line])
        high = scores[self.on_line]
        if not len(low) or not len(high):
            return np.nan
        below = np.searchsorted(low, high) + np.searchsorted(low, high, side="right")
        return float(below.mean()) / (2 * len(low))


def studies(data: Path, sky: SkyModel) -> str:
    """Both studies: how filters are learned, and their size.

    Args:
        data: Folder of the real data sets.
        sky: A sky model that has not seen the Web photographs.
    """
    return f"{_learning(data)}\n\n{_sizes(data / 'web_dataset', sky)}"


def _learning(data: Path) -> str:
    """Each rule: learned from all data sets but one, tested on that one."""
    sets = _sets(data)
    reaches = {config.reach: config for config, _ in RULES.values()}
    sums = {
        (name, reach): reduce(add, [gather_item(config, 0, item) for item in items])
        for name, items in sets.items()
        for reach, config in reaches.items()
    }
    edges = {
        name: [_Edges.of(item, 4 if name == "mountains" else 2) for item in items]
        for name, items in sets.items()
    }
    rows = []
    for rule, (config, alike) in RULES.items():
        found = []
        for left_out, tested in edges.items():
            taught = [sums[name, config.reach] for name in sets if name != left_out]
            joined = together(taught) if alike else reduce(add, taught)
            filters = solve(joined, 0, config).filters
            found.append(float(np.nanmean([one.told_apart(filters) for one in tested])))
        rows.append([rule, *(f"{one:.4f}" for one in [*found, np.mean(found)])])
    header = ["filters are learned from", *sets, "mean"]
    counts = ", ".join(f"{name} {len(items)}" for name, items in sets.items())
    return (
        "## How filters are learned\n\nEach column is a data set that was left out: filters are "
        "learned from the others. How often an edge on its skyline scores above an edge of the "
        "same photo that is more than 10 rows off it (the area under the ROC curve, mean over "
        f"photos). Photos: {counts}.\n\n{markdown(header, rows)}"
    )


def _sets(data: Path) -> dict[str, Sequence[Item]]:
    """The data sets that are there, and as one more the rendered scenes."""
    there = {name: open_dataset(data / name) for name in REAL if (data / name).is_dir()}
    sets: dict[str, Sequence[Item]] = {
        name: [item for item in dataset if item.truth_path] for name, dataset in there.items()
    }
    scenes = (render(kind, seed) for kind in KINDS for seed in SEEDS)
    return {**sets, "rendered": [LoadedItem(one.name, one.photo, one.truth) for one in scenes]}


def _sizes(web: Path, sky: SkyModel) -> str:
    """The default with filters of several sizes, in two folds over the Web photographs."""
    items = [item for item in open_dataset(web) if item.truth_path]
    sizes = []
    for size in FILTER_SIZES[2:]:
        found = cross_validate(items, Detector(untrained(size), sky=sky), 2)
        assert not found.failures, found.failures
        (results,) = found.results.values()
        sizes.append([f"{size} x {size}", *a_err_cells(Summary.of(results))])
    table = markdown(["filters", *A_ERR_HEADER], sizes)
    return f"## Filter size (the paper's Table III), default, A_err in px\n\n{table}"
