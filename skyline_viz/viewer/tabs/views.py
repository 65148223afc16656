"""What tabs are made of: views of the photo, of maps, and of plots."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from skyline_viz.system.names import shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents

BLACK = (12, 12, 12)
"""What lies behind pictures."""

_THIN = 0.6  # half the width of a line on a map, in points of the screen
_LEAN = " (lean: the cheapest of each column)"
_LINES = (entities.PATH, entities.TRUTH, entities.ALTERNATIVE)


def photo_view(
    title: str, shown: Iterable[str], bounds: rrb.VisualBounds2D | None = None
) -> rrb.View:
    """A view of some entities, which fits itself to them unless there are bounds."""
    return rrb.Spatial2DView(
        visual_bounds=bounds,
        origin="/",
        contents=[f"+ /{entity}" for entity in shown],
        name=shown_in_viewer(title),
        background=BLACK,
    )


def map_view(contents: Contents, title: str, shown: Sequence[str]) -> rrb.View:
    """A map with path and truth on it, so thin that it stays in sight."""
    lines = [entities.PATH, *([entities.TRUTH] if contents.truth else [])]
    thin = rr.LineStrips2D.from_fields(radii=[-_THIN]).visualizer()
    return rrb.Spatial2DView(
        origin="/",
        contents=[f"+ /{entity}" for entity in (*shown, *lines)],
        name=shown_in_viewer(title + (_LEAN if contents.lean else "")),
        background=BLACK,
        overrides={f"/{line}": thin for line in lines},
    )


def with_halos(lines: Iterable[str] = _LINES) -> list[str]:
    """Lines with all that lies below them: halos, labels."""
    return [f"{line}/**" for line in lines]


def grid(contents: Contents, views: Sequence[rrb.View], name: str) -> rrb.Container:
    """Two columns for wide photos, three for others: a panorama needs the width of the window.

    Rows with a view less are filled by those that they have.
    """
    columns = 2 if contents.width > 1.6 * contents.height else 3
    rows = np.array_split(np.arange(len(views)), -(-len(views) // columns))
    return rrb.Vertical(*(rrb.Horizontal(*(views[at] for at in row)) for row in rows), name=name)


def bar_plot(entity: str, title: str) -> rrb.View:
    """A plot of bars."""
    legend = rrb.PlotLegend(visible=False)
    return rrb.BarChartView(origin=entity, name=title, plot_legend=legend)


def errors_plot() -> rrb.View:
    """The error of each column, as bars."""
    return bar_plot(entities.ERRORS, "Error (px) in each column")


def whole_photo(contents: Contents) -> rrb.VisualBounds2D | None:
    """Bounds without which frames and their words at a rim push the photo out of a view."""
    if not contents.one_size:
        return None
    return rrb.VisualBounds2D(x_range=(0, contents.width), y_range=(0, contents.height))


def chosen_view(contents: Contents) -> rrb.View:
    """The photo with the chosen pixels."""
    others = ", turquoise: of the truth" if contents.truth else ""
    return photo_view(
        f"Magenta: pixel of the path{others}. Scrub the column timeline",
        [entities.PHOTO, *with_halos([entities.PATH, entities.TRUTH, entities.CHOSEN])],
    )
