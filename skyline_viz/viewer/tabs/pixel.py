"""Tabs of one pixel: *Pixel*, all the way down, and *Filter bank*, which filter it uses."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import BLACK, chosen_view, is_wide, photo_view


def pixel_tab(contents: Contents) -> rrb.Container:
    """Patch, filter and product of both pixels, and what they pay."""
    about = rrb.TextDocumentView(origin=entities.PIXEL_ABOUT, name="What it pays, and why")
    photo: rrb.View | rrb.Container = chosen_view(contents)
    if contents.bank:
        rows = [_steps(line) for line in ("path", *(["truth"] if contents.truth else []))]
        share = 2 if is_wide(contents) or len(rows) == 1 else 3
        photo = rrb.Vertical(photo, *rows, row_shares=[share, *(1.2 for _ in rows)])
    return rrb.Horizontal(photo, about, column_shares=[3, 2], name="Pixel")


def _steps(line: str) -> rrb.Container:
    """From the patch around a line's pixel to what it adds to the score."""
    parent, title = entities.pixel_of(line), line.capitalize()
    return rrb.Horizontal(
        photo_view(f"{title}: patch", [f"{parent}/patch", f"{parent}/ellipse"]),
        photo_view(f"{title}: filter", [f"{parent}/filter"]),
        photo_view(f"{title}: product", [f"{parent}/product"]),
    )


def bank_tab(contents: Contents) -> rrb.Container:
    """The filters, and those that the chosen pixels use."""
    filters = _mosaic("Filters: blue negative, red positive taps", entities.BANK_FILTERS)
    samples = _mosaic("Training samples in each bin", entities.BANK_SAMPLES)
    if not contents.columns:
        return rrb.Horizontal(filters, samples, name="Filter bank")
    photo = chosen_view(contents)
    if is_wide(contents):
        pictures = rrb.Horizontal(filters, samples)
        return rrb.Vertical(pictures, photo, row_shares=[3, 1], name="Filter bank")
    return rrb.Horizontal(filters, samples, photo, column_shares=[4, 4, 3], name="Filter bank")


def _mosaic(title: str, entity: str) -> rrb.View:
    return rrb.Spatial2DView(
        origin="bank",
        contents=[f"+ /{entity}/**", f"+ /{entities.BANK_CHOSEN}/**"],
        name=title,
        background=BLACK,
    )
