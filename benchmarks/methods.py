"""The earlier methods beside ours, as ``skyline-viz tables`` measures them."""

from dataclasses import replace
from pathlib import Path

from skyline_viz import Detector, open_dataset
from skyline_viz.evaluation.cross_validation import cross_validate
from skyline_viz.evaluation.paper_tables.tables import table_1, table_5, table_6
from skyline_viz.evaluation.paper_tables.writing import markdown
from skyline_viz.evaluation.timing import time_methods
from skyline_viz.methods.registry import NAMES, make_method
from skyline_viz.sky_model import SkyModel

FOLDS = 2


def compared(web: Path, sky: SkyModel) -> str:
    """Tables I, V and VI over the photographs of a data set, two folds.

    Args:
        web: Folder of the photographs.
        sky: A sky model that has not seen them, for our detector.
    """
    items = [item for item in open_dataset(web) if item.truth_path]
    made = [make_method(name) for name in NAMES]
    methods = [
        replace(one, sky=sky, label=name) if isinstance(one, Detector) else one
        for name, one in zip(NAMES, made, strict=True)
    ]
    found = cross_validate(items, methods, FOLDS, workers=0)
    assert not found.failures, found.failures
    timings = time_methods(found.methods, items[0].photo())
    measured = {web.name: found}
    page = markdown(
        [table_1(measured, FOLDS), table_5(measured, FOLDS), table_6(timings, found.methods)]
    )
    return page.replace("## Table", "## The earlier methods: Table").rstrip()
