"""How the viewer lays a recording out: first the answer, then the stages, then the details.

- *Skyline*: where is the line, and is it right?
- *Stages*: the paper's figure 1, (a) to (f), and what is added to it.
- *Tensor*: what picks the filter.
- *Terms*, *Search*: what each pixel pays for each term, and what the path search found there.
- *Pixel*: one pixel of the path and one of the truth, all the way down.
- *Filter bank*: the filters, and which of them the chosen pixels use.
- *Columns*: error, margin and costs along the columns.
- *Diagnosis*: why it went wrong, where it did.
- *Sweep*: how the path changes with a setting.
- *Compare*, *Side by side*: where two detections part, and the stages of both.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from skyline_viz.stage import ADDED, COST, FUSED, Quantity
from skyline_viz.system.names import shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents, MethodContents
from skyline_viz.viewer.entities import below
from skyline_viz.viewer.tabs.compare import compare_tab, side_by_side_tab
from skyline_viz.viewer.tabs.search import search_tab

TABS = ("Skyline", "Stages", "Tensor", "Terms", "Search", "Filter bank", "Columns")
"""The tabs of a recording of one photo with a full detection."""

_BLACK = (12, 12, 12)
_THIN = 0.6  # half the width of a line on a map, in points of the screen
_LEAN = " (lean: the cheapest of each column)"
_LINES = (entities.PATH, entities.TRUTH, entities.ALTERNATIVE)


def detection_blueprint(contents: Contents, active: str = "Skyline") -> rrb.Blueprint:
    """Layout of a recording of detections.

    Args:
        contents: What the recording holds.
        active: Name of the tab in front.
    """
    tabs = [
        _first_tab(contents),
        _stages_tab(contents, _lettered(contents), "Stages"),
        *_own_tab(contents, contents.stages, "Tensor"),
        *_own_tab(contents, contents.terms, "Terms"),
        *([search_tab(contents)] if contents.search else []),
        *([_pixel_tab(contents)] if contents.columns else []),
        *([_bank_tab(contents)] if contents.bank else []),
        _columns_tab(contents),
        *([_diagnosis_tab(contents)] if contents.diagnosed else []),
        *([_sweep_tab(contents)] if contents.swept else []),
        *([compare_tab(contents), side_by_side_tab(contents)] if contents.compared else []),
        *([_methods_tab(contents)] if contents.methods else []),
        *(_method_tab(contents, one) for one in contents.methods),
        *([_photos_tab(contents)] if contents.photos > 1 else []),
    ]
    return _with_panels(tabs, contents, active)


def stages_blueprint(height: int, width: int, stages: Iterable[str]) -> rrb.Blueprint:
    """Layout of what `recording.log_stages` logged.

    Args:
        height: Rows of the photo.
        width: Its columns.
        stages: Names of the maps.
    """
    contents = Contents(height, width)
    views = {name.rsplit("/", 1)[-1].capitalize(): [name] for name in stages}
    views = {"Photo": [entities.PHOTO], **views, "Skyline": [entities.PHOTO, *_with_halos()]}
    line = _photo_view("Where is the line?", [entities.PHOTO, *_with_halos()])
    tabs = [
        rrb.Vertical(line, name="Skyline"),
        _grid(contents, [_photo_view(*one) for one in views.items()], "Stages"),
    ]
    return _with_panels(tabs, contents, "Skyline")


def _first_tab(contents: Contents) -> rrb.Container:
    line = _photo_view(
        "Where is the line? magenta: path"
        + (", turquoise: truth" if contents.truth else "")
        + (f", yellow: {contents.compared}" if contents.compared else ""),
        [entities.PHOTO, *_with_halos(), entities.STRIP, f"{entities.CHOSEN}/**"],
    )
    plot = _errors() if contents.truth else _plot(entities.MARGINS, "Margin (cost)")
    report = rrb.TextDocumentView(origin=entities.REPORT, name="Report")
    if contents.width < 1.2 * contents.height:
        side = rrb.Vertical(report, plot, row_shares=[3, 2])
        return rrb.Horizontal(line, side, column_shares=[3, 2], name="Skyline")
    foot = rrb.Horizontal(plot, report, column_shares=[3, 2])
    return rrb.Vertical(line, foot, row_shares=[3, 2], name="Skyline")


def _stages_tab(contents: Contents, stages: dict[str, list[str]], name: str) -> rrb.Container:
    views = [
        _photo_view(title, shown) if entities.PHOTO in shown else _map_view(contents, title, shown)
        for title, shown in stages.items()
    ]
    return _grid(contents, views, name)


def _map_view(contents: Contents, title: str, shown: Sequence[str]) -> rrb.View:
    """A map with path and truth on it, so thin that it stays in sight."""
    lines = [entities.PATH, *([entities.TRUTH] if contents.truth else [])]
    thin = rr.LineStrips2D.from_fields(radii=[-_THIN]).visualizer()
    return rrb.Spatial2DView(
        origin="/",
        contents=[f"+ /{entity}" for entity in (*shown, *lines)],
        name=shown_in_viewer(title + (_LEAN if contents.lean else "")),
        background=_BLACK,
        overrides={f"/{line}": thin for line in lines},
    )


_PAPERS = ("edges", "score", "strength", "score and strength")  # figure 1 besides photo and path
_FIGURE_1 = {
    "edges": 0,
    "score": 1,
    "score and strength": 3,
    "cost": 4,
}  # where others have no place of their own: 2


def _figure_1(stages: Sequence[Quantity]) -> dict[str, list[str]]:
    """Titles and entities of the stages, in the order of the paper's figure."""
    mine = [one for one in stages if "Stages" in one.tabs]
    mine.sort(key=lambda one: _FIGURE_1.get(one.name, 2))
    return {one.title: [entities.of_quantity(one)] for one in mine}


def _lettered(contents: Contents) -> dict[str, list[str]]:
    """Figure 1 of the paper, (a) to (f), and what we add to it as added; or all of another's."""
    figure = _figure_1(contents.stages)
    path = [entities.PHOTO, *_with_halos()]
    ours = FUSED in contents.stages
    papers = {one.title for one in contents.stages if one.name in _PAPERS or not ours}
    known = {title: shown for title, shown in figure.items() if title in papers}
    views = {"Photo": [entities.PHOTO], **known, "Path": path}
    named = {f"({chr(ord('a') + at)}) {title}": views[title] for at, title in enumerate(views)}
    added = {title: shown for title, shown in figure.items() if title not in papers}
    if ADDED in contents.terms:
        added[ADDED.title] = [entities.of_quantity(ADDED)]
    return named | {
        title if title == COST.title else f"Added: {title}": shown for title, shown in added.items()
    }


def _own_tab(contents: Contents, quantities: Sequence[Quantity], name: str) -> list[rrb.Container]:
    """A tab of those quantities that belong there; nothing without any."""
    views = {one.title: [entities.of_quantity(one)] for one in quantities if name in one.tabs}
    return [_stages_tab(contents, views, name)] if views else []


def _bank_tab(contents: Contents) -> rrb.Container:
    filters = rrb.Spatial2DView(
        origin="bank",
        contents=[f"+ /{entities.BANK_FILTERS}/**", f"+ /{entities.BANK_CHOSEN}/**"],
        name="Filters: blue negative, red positive taps",
        background=_BLACK,
    )
    samples = rrb.Spatial2DView(
        origin="bank",
        contents=[f"+ /{entities.BANK_SAMPLES}/**", f"+ /{entities.BANK_CHOSEN}/**"],
        name="Training samples in each bin",
        background=_BLACK,
    )
    pictures = rrb.Horizontal(filters, samples)
    if not contents.columns:
        return rrb.Horizontal(filters, samples, name="Filter bank")
    return rrb.Vertical(pictures, _chosen_view(contents), row_shares=[3, 1], name="Filter bank")


def _chosen_view(contents: Contents) -> rrb.View:
    """The photo with the chosen pixels."""
    others = ", turquoise: of the truth" if contents.truth else ""
    return _photo_view(
        f"Magenta: pixel of the path{others}. Scrub the column timeline",
        [entities.PHOTO, *_with_halos([entities.PATH, entities.TRUTH, entities.CHOSEN])],
    )


def _pixel_tab(contents: Contents) -> rrb.Container:
    about = rrb.TextDocumentView(origin=entities.PIXEL_ABOUT, name="What it pays, and why")
    head = rrb.Horizontal(_chosen_view(contents), about, column_shares=[3, 2])
    if not contents.bank:
        return rrb.Vertical(head, name="Pixel")
    views = []
    for line in ("path", *(["truth"] if contents.truth else [])):
        for title in ("patch", "filter", "product"):
            shown = [f"{entities.pixel_of(line)}/{one}" for one in (title, "ellipse")]
            shown = shown if title == "patch" else shown[:1]
            views.append(_photo_view(f"{line.capitalize()}: {title}", shown))
    return rrb.Vertical(head, rrb.Horizontal(*views), row_shares=[2, 1], name="Pixel")


def _columns_tab(contents: Contents) -> rrb.Container:
    if not contents.columns:
        return _bars_tab(contents)
    titles = {
        **({"error": "Error (px)"} if contents.truth else {}),
        "margin": "Margin (cost): how much dearer the best other path is",
        **({"apart": "Truth less path (cost), mean of 9 columns"} if contents.truth else {}),
        "path": "Nodal and link cost of the path",
    }
    axis = rrb.TimeAxis(link=rrb.components.LinkAxis.LinkToGlobal)
    plots = [
        rrb.TimeSeriesView(
            origin=f"{entities.SERIES}/{name}",
            name=title,
            axis_x=axis,
            plot_legend=rrb.PlotLegend(corner=rrb.Corner2D.RightTop),
        )
        for name, title in titles.items()
    ]
    shares = [2, *(2 if name == "apart" else 1 for name in titles)]
    return rrb.Vertical(_chosen_view(contents), *plots, row_shares=shares, name="Columns")


def _bars_tab(contents: Contents) -> rrb.Container:
    """Plots of several photos, whose timeline is that of the photos."""
    plots = [
        *([_errors()] if contents.truth else []),
        _plot(entities.MARGINS, "Margin (cost): how much dearer the best other path is"),
        _plot(entities.NODE_COSTS, "Nodal cost of the path"),
        _plot(entities.LINK_COSTS, "Link cost of the path"),
        *([_plot(entities.DIFFERENCES, "Difference (px)")] if contents.compared else []),
    ]
    return rrb.Vertical(*plots, name="Columns")


def _diagnosis_tab(contents: Contents) -> rrb.Container:
    marks = [f"{entities.SEGMENTS}/**", entities.TRUTH_MISSED, entities.TRUTH_STARVED]
    lines = _with_halos([entities.PATH, entities.TRUTH, entities.COUNTERFACTUAL])
    photo = _photo_view(
        "Yellow: the path with its cause made right; dashes: with other settings. Above the truth, "
        "orange: no edge; blue: starved",
        [entities.PHOTO, *lines, *marks],
        _whole_photo(contents),
    )
    report = rrb.TextDocumentView(origin=entities.DIAGNOSIS, name="Why")
    pays = _photo_view("What they pay", [entities.STACKED_COSTS])
    plot = pays if contents.stacked_costs else _errors()
    foot = rrb.Horizontal(plot, report, column_shares=[2, 1])
    return rrb.Vertical(photo, foot, row_shares=[3, 2], name="Diagnosis")


def _sweep_tab(contents: Contents) -> rrb.Container:
    photo = _photo_view(
        "Choose a timeline below and drag it. Yellow: path with that setting, magenta: path now"
        + (", turquoise: truth" if contents.truth else ""),
        [entities.PHOTO, *_with_halos([entities.PATH, entities.TRUTH, entities.SWEEP_PATH])],
    )
    edges = _photo_view("Edges", [entities.SWEEP_EDGES])
    cost = _photo_view("Nodal cost: bright is cheap", [entities.SWEEP_COST])
    pictures = rrb.Vertical(photo, rrb.Horizontal(edges, cost), row_shares=[3, 2])
    plot = rrb.TimeSeriesView(
        origin=entities.SWEEP_ERROR,
        name="A_err (px)" if contents.truth else "Mean distance from the present path (px)",
        plot_legend=rrb.PlotLegend(visible=False),
    )
    report = rrb.TextDocumentView(origin=entities.SWEEP_REPORT, name="The setting")
    side = rrb.Vertical(report, plot, row_shares=[3, 2])
    return rrb.Horizontal(pictures, side, column_shares=[2, 1], name="Sweep")


def _methods_tab(contents: Contents) -> rrb.Container:
    lines = _with_halos([entities.PATH, entities.TRUTH, entities.METHOD_LINES])
    photo = _photo_view(
        "What each method finds",
        [entities.PHOTO, *lines],
        _whole_photo(contents),
    )
    table = rrb.TextDocumentView(origin=entities.METHODS_TABLE, name="Methods")
    costs = [
        _photo_view(
            f"{one.name}: nodal cost",
            [
                below(_stages_of(one), entities.COST),
                *_with_halos([entities.line_of(one.name)]),
            ],
        )
        for one in contents.methods[:3]
    ]
    foot = rrb.Horizontal(table, *costs)
    return rrb.Vertical(photo, foot, row_shares=[3, 2], name="Methods")


def _method_tab(contents: Contents, one: MethodContents) -> rrb.Container:
    """The stages of a method, as the stages of ours."""
    line = entities.line_of(one.name)
    views = {
        title: [below(_stages_of(one), stage) for stage in shown]
        for title, shown in _figure_1(one.stages).items()
    }
    views["Path"] = [entities.PHOTO, *_with_halos([line, entities.TRUTH])]
    pictures = [_photo_view(title, shown) for title, shown in views.items()]
    report = rrb.TextDocumentView(origin=below(_stages_of(one), entities.REPORT), name="Report")
    return _grid(contents, [*pictures, report], shown_in_viewer(one.name))


def _stages_of(one: MethodContents) -> str:
    return entities.stages_of(one.name)


def _photos_tab(contents: Contents) -> rrb.Container:
    metrics = [("a_err", "A_err of each photo (px)")] if contents.truth else []
    metrics.append(("margin", "Margin of each photo (cost)"))
    metrics.append(("confidence", "Confidence that the line of each photo is the skyline"))
    plots = [
        rrb.TimeSeriesView(origin=f"{entities.METRICS}/{metric}", name=title)
        for metric, title in metrics
    ]
    times = rrb.TimeSeriesView(origin=entities.TIMINGS, name="Time of each stage (ms)")
    return rrb.Vertical(*plots, times, name="Photos")


def _errors() -> rrb.View:
    return _plot(entities.ERRORS, "Error (px) in each column")


def _plot(entity: str, title: str) -> rrb.View:
    legend = rrb.PlotLegend(visible=False)
    return rrb.BarChartView(origin=entity, name=title, plot_legend=legend)


def _photo_view(
    title: str, shown: Iterable[str], bounds: rrb.VisualBounds2D | None = None
) -> rrb.View:
    return rrb.Spatial2DView(
        visual_bounds=bounds,
        origin="/",
        contents=[f"+ /{entity}" for entity in shown],
        name=shown_in_viewer(title),
        background=_BLACK,
    )


def _whole_photo(contents: Contents) -> rrb.VisualBounds2D | None:
    """Bounds without which frames and their words at a rim push the photo out of a view."""
    if not contents.one_size:
        return None
    return rrb.VisualBounds2D(x_range=(0, contents.width), y_range=(0, contents.height))


def _with_halos(lines: Iterable[str] = _LINES) -> list[str]:
    return [f"{line}/**" for line in lines]


def _grid(contents: Contents, views: Sequence[rrb.View], name: str) -> rrb.Container:
    """Two columns for wide photos, three for others: a panorama needs the width of the window.

    Rows with a view less are filled by those that they have.
    """
    columns = 2 if contents.width > 1.6 * contents.height else 3
    rows = np.array_split(np.arange(len(views)), -(-len(views) // columns))
    return rrb.Vertical(*(rrb.Horizontal(*(views[at] for at in row)) for row in rows), name=name)


def _with_panels(tabs: list[rrb.Container], contents: Contents, active: str) -> rrb.Blueprint:
    time = rrb.TimePanel(state="hidden")
    if contents.photos > 1:
        time = rrb.TimePanel(state="collapsed", timeline=entities.IMAGE, play_state="paused")
    elif contents.swept:
        time = rrb.TimePanel(state="collapsed", timeline=contents.swept, play_state="paused")
    elif contents.columns:
        time = rrb.TimePanel(state="collapsed", timeline=entities.COLUMN, play_state="paused")
    return rrb.Blueprint(
        rrb.Tabs(*tabs, active_tab=[tab.name for tab in tabs].index(active)),
        time,
        rrb.SelectionPanel(state="hidden"),
        rrb.BlueprintPanel(state="hidden"),
        auto_views=False,
        auto_layout=False,
    )
