"""A_err on real photographs, cross-validated, and on the rendered samples."""

from dataclasses import replace
from itertools import groupby
from pathlib import Path

from benchmarks.table import A_ERR_HEADER, a_err_cells, markdown
from skyline_viz import Detector, DetectorConfig, Summary, cross_validate, evaluate, open_dataset
from skyline_viz.evaluation.results import worst
from skyline_viz.sky_model import SkyModel

WITHOUT = {
    "default": {},
    "without fitted thresholds": {"fit_thresholds": False},
    "with grey edges": {"edge_source": "grey"},
    "without the clear-sky term": {"clear_sky": 0.0},
    "without the sky model": {"sky_weight": 0.0},
    "without both": {"clear_sky": 0.0, "sky_weight": 0.0},
    "with delta 1": {"delta": 1},
    "with delta 8": {"delta": 8},
}


def cross_validated(web: Path, sky: SkyModel) -> str:
    """Two folds: the published method, the default, and the default less each of its parts.

    Args:
        web: Folder of the Web photographs.
        sky: A sky model that has not seen them.
    """
    items = [item for item in open_dataset(web) if item.truth_path]
    paper = DetectorConfig.paper()
    steep = replace(paper, delta=4, link_weight=0.1)
    configs = {"`paper()`": paper, "`paper()`, delta 4, link weight 0.1": steep}
    for name, changes in WITHOUT.items():
        configs[name] = replace(DetectorConfig(), **changes)
    rows, notes = [], ""
    for name, config in configs.items():
        found = cross_validate(items, Detector(config=config, sky=sky), 2)
        assert not found.failures, found.failures
        (results,) = found.results.values()
        rows.append([name, *a_err_cells(Summary.of(results))])
        if name == "default":
            bad = ", ".join(f"{result.name} {result.a_err:.2f}" for result in worst(results))
            notes = f"Worst photos of the default: {bad} px."
    table = markdown(["two folds", *A_ERR_HEADER], rows)
    return (
        f"## Cross-validation on {len(items)} Web photographs (A_err in px)\n\n{table}\n\n{notes}"
    )


def rendered(samples: Path) -> str:
    """The shipped filter bank, which never saw a rendered photo, on the rendered samples."""
    items = open_dataset(samples).items
    rows = []
    for preset, config in (("`paper()`", DetectorConfig.paper()), ("default", DetectorConfig())):
        found = evaluate(items, Detector(config=config))
        assert not found.failures, found.failures
        (results,) = found.results.values()
        kinds = groupby(results, key=lambda result: result.name.rsplit("-", 1)[0])
        cells = {kind: " ".join(f"{one.a_err:.1f}" for one in group) for kind, group in kinds}
        rows.append([preset, *cells.values()])
    table = markdown(["A_err in px", *cells], rows)
    return f"## The rendered samples, with the shipped filter bank\n\n{table}"
