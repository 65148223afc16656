"""What tabs are made of: views of the photo, of maps, and of plots, laid out by a photo's shape."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from skyline_viz.stage import SKY
from skyline_viz.system.names import shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.maps.map_aids import DRAWN, SCALE, SCALE_SHARE

BLACK = (12, 12, 12)
"""What lies behind pictures."""

_THIN = 0.6  # half the width of a line on a map, in points of the screen
_LEAN = "Lean: "  # the cheapest edge pixels of each column
_OTHERS = f"{entities.OTHER}/"
_WHOLE = {entities.EDGES, entities.of_quantity(SKY)}  # in lean recordings, too
_LINES = (entities.PATH, entities.TRUTH, entities.ALTERNATIVE)
_ROOM = (1280, 740)  # pixels of a tab in a window of 1280x800
_TITLE = 24  # rows of the title of a view
_AS_GOOD = 0.9  # of the largest pictures: fewer columns leave titles more room


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


def map_view(
    contents: Contents, title: str, maps: Sequence[str], lines: Sequence[str] = ()
) -> rrb.View:
    """A map with its scale, and with lines so thin that it stays in sight.

    Where photos have several sizes the scale is left out: it would shrink the map.

    Args:
        contents: What the recording holds.
        title: What it shows.
        maps: Entities of the map.
        lines: Entities of the lines.
    """
    thin = rr.LineStrips2D.from_fields(radii=[-_THIN]).visualizer()
    unread = rrb.EntityBehavior(interactive=False)
    shown = [*(f"+ /{one}/**" for one in maps), *(f"+ /{line}" for line in lines)]
    lean = contents.lean and any(one.removeprefix(_OTHERS) not in _WHOLE for one in maps)
    bounds = None
    if contents.one_size:
        right = contents.width + SCALE_SHARE * max(contents.width, contents.height)
        bounds = rrb.VisualBounds2D(x_range=(0, right), y_range=(0, contents.height))
    else:
        shown += [f"- /{one}/{SCALE}" for one in maps]
    return rrb.Spatial2DView(
        origin="/",
        contents=shown,
        visual_bounds=bounds,
        name=shown_in_viewer((_LEAN if lean else "") + title),
        background=BLACK,
        overrides={
            **{f"/{line}": thin for line in lines},
            **{f"/{one}/{DRAWN}": unread for one in maps},
        },
    )


def lines_of(contents: Contents) -> list[str]:
    """The lines that lie on every map: the path, and the truth if there is one."""
    return [entities.PATH, *([entities.TRUTH] if contents.truth else [])]


def with_halos(lines: Iterable[str] = _LINES) -> list[str]:
    """Lines with all that lies below them: halos, labels."""
    return [f"{line}/**" for line in lines]


def is_wide(contents: Contents) -> bool:
    """Whether a photo is so wide that what belongs to it lies below it better than beside it."""
    return contents.width > 1.7 * contents.height


def columns_for(contents: Contents, count: int, together: int = 1) -> int:
    """How many columns show so many maps of a photo as large as possible.

    Args:
        contents: What the recording holds.
        count: How many maps there are, or groups of maps.
        together: Maps beside each other in a group.

    >>> columns_for(Contents(519, 1388), 9), columns_for(Contents(1024, 768), 9)
    (3, 5)
    """
    width = together * (contents.width + SCALE_SHARE * max(contents.width, contents.height))
    scales = []
    for columns in range(1, count + 1):
        rows = -(-count // columns)
        across, down = _ROOM[0] / columns, _ROOM[1] / rows - _TITLE
        scales.append(min(across / width, down / contents.height))
    best = max(scales)
    return next(at for at, scale in enumerate(scales, 1) if scale >= _AS_GOOD * best)


def grid(contents: Contents, views: Sequence[rrb.View], name: str) -> rrb.Container:
    """Views of maps as a tab, as large as the shape of the photo allows.

    Rows with a view less are filled by those that they have.
    """
    count = -(-len(views) // columns_for(contents, len(views)))
    rows = np.array_split(np.arange(len(views)), count)
    return rrb.Vertical(*(rrb.Horizontal(*(views[at] for at in row)) for row in rows), name=name)


def beside(
    contents: Contents,
    photo: rrb.View | rrb.Container,
    others: Sequence[rrb.View],
    name: str,
    shares: Sequence[float] = (3, 2),
) -> rrb.Container:
    """A photo, and what belongs to it: below it if it is wide, else beside it.

    Args:
        contents: What the recording holds.
        photo: The photo.
        others: What belongs to it, in order of how much is read there.
        name: Name of the tab.
        shares: How much of the tab the photo takes, and the rest.
    """
    if is_wide(contents):
        foot = rrb.Horizontal(*others[::-1], column_shares=[3, 2][: len(others)])
        return rrb.Vertical(photo, foot, row_shares=shares, name=name)
    side = rrb.Vertical(*others, row_shares=[3, 2][: len(others)])
    return rrb.Horizontal(photo, side, column_shares=shares, name=name)


def bar_plot(entity: str, title: str) -> rrb.View:
    """A plot of bars."""
    legend = rrb.PlotLegend(visible=False)
    return rrb.BarChartView(origin=entity, name=title, plot_legend=legend)


def series_plot(contents: Contents, series: str, title: str, *, legend: bool = True) -> rrb.View:
    """A plot along the columns, with a cursor; its axis is that of all such plots.

    Args:
        contents: What the recording holds, which opens on another timeline where it is swept.
        series: What is below `entities.SERIES`.
        title: What it shows.
        legend: Whether its curves are named.
    """
    return rrb.TimeSeriesView(
        origin=f"{entities.SERIES}/{series}",
        name=title + (f"; choose the timeline {entities.COLUMN}" if contents.swept else ""),
        axis_x=rrb.TimeAxis(link=rrb.components.LinkAxis.LinkToGlobal),
        plot_legend=rrb.PlotLegend(corner=rrb.Corner2D.RightTop, visible=legend),
    )


def errors_plot(contents: Contents) -> rrb.View:
    """The error of each column."""
    if contents.columns and not contents.swept:
        return series_plot(contents, "error", "Error (px) in each column", legend=False)
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
        f"Magenta: pixel of the path{others}. Drag the column timeline",
        [entities.PHOTO, *with_halos([entities.PATH, entities.TRUTH, entities.CHOSEN])],
    )
