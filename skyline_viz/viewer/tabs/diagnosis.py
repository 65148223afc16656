"""Tab *Diagnosis*: why it went wrong, where it did."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import (
    beside,
    errors_plot,
    photo_view,
    series_plot,
    whole_photo,
    with_halos,
)


def diagnosis_tab(contents: Contents) -> rrb.Container:
    """The failing segments on the photo, what both lines pay there, and why."""
    marks = [f"{entities.SEGMENTS}/**", entities.TRUTH_MISSED, entities.TRUTH_STARVED]
    lines = with_halos([entities.PATH, entities.TRUTH, entities.COUNTERFACTUAL])
    photo = photo_view(
        "Yellow: cause made right; dashed: other settings; orange: no edge; blue: starved",
        [entities.PHOTO, *lines, *marks],
        whole_photo(contents),
    )
    report = rrb.TextDocumentView(origin=entities.DIAGNOSIS, name="Why")
    if contents.columns and not contents.swept:
        plot = series_plot(contents, "apart", "Truth less path (cost), mean of 9 columns")
    else:
        plot = errors_plot(contents)
    return beside(contents, photo, [report, plot], "Diagnosis")
