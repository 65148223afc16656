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

from collections.abc import Iterable

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.answer import photos_tab, skyline_tab
from skyline_viz.viewer.tabs.columns import columns_tab
from skyline_viz.viewer.tabs.compare import compare_tab, side_by_side_tab
from skyline_viz.viewer.tabs.diagnosis import diagnosis_tab
from skyline_viz.viewer.tabs.methods import method_tab, methods_tab
from skyline_viz.viewer.tabs.pixel import bank_tab, pixel_tab
from skyline_viz.viewer.tabs.search import search_tab
from skyline_viz.viewer.tabs.stages import lettered, own_tab, stages_tab
from skyline_viz.viewer.tabs.sweep import sweep_tab
from skyline_viz.viewer.tabs.views import grid, map_view, photo_view, with_halos

TABS = ("Skyline", "Stages", "Tensor", "Terms", "Search", "Pixel", "Filter bank", "Columns")
"""The tabs of one photo with a full detection, as ``inspect`` shows it."""


def detection_blueprint(contents: Contents, active: str = "Skyline") -> rrb.Blueprint:
    """Layout of a recording of detections.

    Args:
        contents: What the recording holds.
        active: Name of the tab in front.
    """
    tabs = [
        skyline_tab(contents),
        stages_tab(contents, lettered(contents), "Stages"),
        *own_tab(contents, contents.stages, "Tensor"),
        *own_tab(contents, contents.terms, "Terms"),
        *([search_tab(contents)] if contents.search else []),
        *([pixel_tab(contents)] if contents.columns else []),
        *([bank_tab(contents)] if contents.bank else []),
        columns_tab(contents),
        *([diagnosis_tab(contents)] if contents.diagnosed else []),
        *([sweep_tab(contents)] if contents.swept else []),
        *([compare_tab(contents), side_by_side_tab(contents)] if contents.compared else []),
        *([methods_tab(contents)] if contents.methods else []),
        *(method_tab(contents, one) for one in contents.methods),
        *([photos_tab(contents)] if contents.photos > 1 else []),
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
    lines = [entities.PATH, entities.TRUTH]
    views = [
        photo_view("Photo", [entities.PHOTO]),
        *(
            map_view(contents, name.rsplit("/", 1)[-1].capitalize(), [name], lines)
            for name in stages
        ),
        photo_view("Skyline", [entities.PHOTO, *with_halos()]),
    ]
    line = photo_view("Where is the line?", [entities.PHOTO, *with_halos()])
    tabs = [
        rrb.Vertical(line, name="Skyline"),
        grid(contents, views, "Stages"),
    ]
    return _with_panels(tabs, contents, "Skyline")


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
