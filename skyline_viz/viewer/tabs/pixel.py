"""Tabs of one pixel: *Pixel*, all the way down, and *Filter bank*, which filter it uses."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import BLACK, chosen_view, photo_view


def pixel_tab(contents: Contents) -> rrb.Container:
    """Patch, filter and product of both pixels, and what they pay."""
    about = rrb.TextDocumentView(origin=entities.PIXEL_ABOUT, name="What it pays, and why")
    head = rrb.Horizontal(chosen_view(contents), about, column_shares=[3, 2])
    if not contents.bank:
        return rrb.Vertical(head, name="Pixel")
    views = []
    for line in ("path", *(["truth"] if contents.truth else [])):
        for title in ("patch", "filter", "product"):
            shown = [f"{entities.pixel_of(line)}/{one}" for one in (title, "ellipse")]
            shown = shown if title == "patch" else shown[:1]
            views.append(photo_view(f"{line.capitalize()}: {title}", shown))
    return rrb.Vertical(head, rrb.Horizontal(*views), row_shares=[2, 1], name="Pixel")


def bank_tab(contents: Contents) -> rrb.Container:
    """The filters, and those that the chosen pixels use."""
    filters = rrb.Spatial2DView(
        origin="bank",
        contents=[f"+ /{entities.BANK_FILTERS}/**", f"+ /{entities.BANK_CHOSEN}/**"],
        name="Filters: blue negative, red positive taps",
        background=BLACK,
    )
    samples = rrb.Spatial2DView(
        origin="bank",
        contents=[f"+ /{entities.BANK_SAMPLES}/**", f"+ /{entities.BANK_CHOSEN}/**"],
        name="Training samples in each bin",
        background=BLACK,
    )
    pictures = rrb.Horizontal(filters, samples)
    if not contents.columns:
        return rrb.Horizontal(filters, samples, name="Filter bank")
    return rrb.Vertical(pictures, chosen_view(contents), row_shares=[3, 1], name="Filter bank")
