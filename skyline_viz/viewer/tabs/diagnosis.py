"""Tab *Diagnosis*: why it went wrong, where it did."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import errors_plot, photo_view, whole_photo, with_halos


def diagnosis_tab(contents: Contents) -> rrb.Container:
    """The failing segments on the photo, what both lines pay there, and why."""
    marks = [f"{entities.SEGMENTS}/**", entities.TRUTH_MISSED, entities.TRUTH_STARVED]
    lines = with_halos([entities.PATH, entities.TRUTH, entities.COUNTERFACTUAL])
    photo = photo_view(
        "Yellow: the path with its cause made right, or with other settings. On the truth, orange: "
        "no edge; blue: starved",
        [entities.PHOTO, *lines, *marks],
        whole_photo(contents),
    )
    report = rrb.TextDocumentView(origin=entities.DIAGNOSIS, name="Why")
    pays = photo_view("What they pay", [entities.STACKED_COSTS])
    plot = pays if contents.stacked_costs else errors_plot()
    foot = rrb.Horizontal(plot, report, column_shares=[2, 1])
    return rrb.Vertical(photo, foot, row_shares=[3, 2], name="Diagnosis")
