"""A gallery as a table of cards in the viewer, served on this machine alone.

The table shows what people said about photos. It is said elsewhere, on the `flag_page` or by a
command: the viewer keeps a click on a flag to itself for a while, and Rerun's own server takes
changes from every program of this machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import pyarrow as pa
import rerun as rr
import rerun.blueprint as rrb

from skyline_viz.gallery.better_worse import outcome
from skyline_viz.gallery.entry import Entry
from skyline_viz.gallery.flags import Flag, read_flags
from skyline_viz.gallery.store import Gallery
from skyline_viz.system.aftermath import passing_temporaries
from skyline_viz.system.loopback import LOOPBACK
from skyline_viz.system.names import recording_id, shortened, shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.blueprints import detection_blueprint
from skyline_viz.viewer.comparison import LEAN
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.program.process import free_port
from skyline_viz.viewer.program.rerun_internals import card_parts
from skyline_viz.viewer.recording import APPLICATION

if TYPE_CHECKING:
    from rerun.blueprint.table import TableBlueprint

_DATASET = "photos"
_TABLE = "gallery"
_MOST_LAYOUTS = 12  # that are made for single sizes


@dataclass
class ServedGallery:
    """A gallery that is being served."""

    address: str
    """What to open in the viewer: the cards."""

    gallery: Gallery
    """Its files."""

    entries: Sequence[Entry]
    """Its photos."""

    flags: dict[str, Flag]
    """What the table says about reviews and comments."""

    _photos: Mapping[str, Any] = field(repr=False)  # the data set of each
    _table: Any = field(repr=False)
    _client: Any = field(repr=False)  # the server forgets its tables when it is dropped

    def refresh(self) -> bool:
        """Put what people said since into the table; whether there was anything.

        The viewer shows it when it asks again, which the arrow beside *Last updated* has it do.
        """
        flags = read_flags(self.gallery.folder)
        nothing = Flag()
        changed = [
            one
            for one in self.entries
            if flags.get(one.name, nothing) != self.flags.get(one.name, nothing)
        ]
        if changed:
            self._table.upsert(**_columns(changed, flags, self._photos))
        self.flags = flags
        return bool(changed)


@contextmanager
def served(
    gallery: Gallery, entries: Sequence[Entry], truth: bool, cause: str = ""
) -> Iterator[ServedGallery]:
    """Serve a gallery for as long as the block lasts.

    Args:
        gallery: Its files.
        entries: Its photos, in the order in which to show them.
        truth: Whether there is a truth for any of them.
        cause: Show only those of which a cause says this, by a filter that can be changed in the
            viewer; empty for all.

    Raises:
        ViewerError: This version of Rerun has no cards.
    """
    parts = card_parts()
    shapes = by_shape(entries)
    files = {
        dataset: [gallery.recording(entry.name) for entry in alike]
        for dataset, alike in shapes.items()
    }
    flags = read_flags(gallery.folder)
    with (
        passing_temporaries() as folder,
        parts.server.Server(host=LOOPBACK, port=free_port(), datasets=files) as server,
    ):
        client = server.client()
        photos: dict[str, Any] = {}
        for dataset, alike in shapes.items():
            layout = folder / f"{dataset}.rbl"
            detection_blueprint(contents_of(alike, truth)).save(APPLICATION, layout)
            held = client.get_dataset(dataset)
            held.register_blueprint(layout.as_uri())
            photos |= {entry.name: held for entry in alike}
        table = client.create_table(_TABLE, _schema(parts.index))
        table.append(**_columns(entries, flags, photos))
        cards = folder / "cards.rbl"
        compared = next((entry.compared for entry in entries), "")
        told = any(entry.shows for entry in entries)
        seen = any(entry.seen for entry in entries)
        _cards(parts.tables, truth, cause, compared, told, seen).save(_TABLE, cards)
        table.register_blueprint(cards.as_uri())
        address = f"{server.url()}/entry/{table.id}"
        yield ServedGallery(address, gallery, entries, flags, photos, table, client)


def by_shape(entries: Sequence[Entry]) -> dict[str, list[Entry]]:
    """Photos of one size together, by the name of their data set in the viewer.

    The server knows one layout a data set, and a panorama wants another one than a square. Where
    there are many sizes, it is photos of about one shape that are together.

    Args:
        entries: The photos, in any order, which stays.
    """
    few = len({(entry.height, entry.width) for entry in entries}) <= _MOST_LAYOUTS
    found: dict[Any, list[Entry]] = {}
    for entry in entries:
        shape = round(2 * math.log2(entry.width / entry.height))
        found.setdefault((entry.height, entry.width) if few else shape, []).append(entry)
    return {
        _DATASET + (f"-{number}" if number > 1 else ""): alike
        for number, alike in enumerate(found.values(), 1)
    }


def contents_of(entries: Sequence[Entry], truth: bool) -> Contents:
    """What recordings of a gallery hold: one layout shows them.

    Args:
        entries: The photos, all of about one shape, see `by_shape`. Where they have several sizes,
            views fit themselves to each.
        truth: Whether there is a truth for any of them.
    """
    first = entries[0]
    return Contents(
        first.height,
        first.width,
        one_size=all((one.height, one.width) == (first.height, first.width) for one in entries),
        truth=truth,
        bank=False,
        lean=True,
        stages=first.stages,
        first=first.method,
        compared=first.compared,
        apart=LEAN if first.compared else (),
        diagnosed=any(entry.causes for entry in entries),
    )


def _schema(index: str) -> pa.Schema:
    """The table's columns.

    Args:
        index: Metadata key of the column that tells rows apart.
    """
    return pa.schema(
        [
            pa.field("id", pa.utf8(), metadata={index: "true"}),
            pa.field("name", pa.utf8()),
            pa.field("photo", pa.utf8()),
            pa.field("a_err", pa.float32()),
            pa.field("worst", pa.utf8()),
            pa.field("difference", pa.float32()),
            pa.field("other_a_err", pa.float32()),
            pa.field("change", pa.float32()),
            pa.field("outcome", pa.utf8()),
            pa.field("parts_at", pa.utf8()),
            pa.field("turned_by", pa.utf8()),
            pa.field("margin", pa.float32()),
            pa.field("confidence", pa.float32()),
            pa.field("shows", pa.utf8()),
            pa.field("method", pa.utf8()),
            pa.field("seen", pa.utf8()),
            pa.field("wrong", pa.utf8()),
            pa.field("cause", pa.utf8()),
            pa.field("causes", pa.utf8()),
            pa.field("reviewed", pa.bool_()),
            pa.field("comment", pa.utf8()),
        ]
    )


def _columns(
    entries: Sequence[Entry],
    flags: dict[str, Flag],
    photos: Mapping[str, Any],
) -> dict[str, list[Any]]:
    said = [flags.get(entry.name, Flag()) for entry in entries]
    return {
        "id": [recording_id(entry.name) for entry in entries],
        "name": [shown_in_viewer(shortened(entry.name)) for entry in entries],
        "photo": [photos[entry.name].segment_url(recording_id(entry.name)) for entry in entries],
        "a_err": [_rounded(one.verdict.a_err) for one in entries],
        "worst": [_worst(entry) for entry in entries],
        "difference": [_rounded(one.difference) for one in entries],
        "other_a_err": [_rounded(one.other_a_err) for one in entries],
        "change": [_rounded(one.change) for one in entries],
        "outcome": [outcome(one) for one in entries],
        "parts_at": [shown_in_viewer(one.parts_at) or "nowhere" for one in entries],
        "turned_by": [shown_in_viewer(one.turned_by) or "-" for one in entries],
        "method": [shown_in_viewer(shortened(one.method)) for one in entries],
        "seen": [one.seen or "no" for one in entries],
        "margin": [round(entry.verdict.margin, 2) for entry in entries],
        "confidence": [_rounded(one.confidence) for one in entries],
        "shows": [one.shows for one in entries],
        "wrong": [entry.wrong or "none" for entry in entries],
        "cause": [_cause(one) for one in entries],
        "causes": [None if one.causes is None else "; ".join(one.titles) for one in entries],
        "reviewed": [flag.reviewed for flag in said],
        "comment": [shown_in_viewer(flag.comment) for flag in said],
    }


def _worst(entry: Entry) -> str:
    verdict = entry.verdict
    if verdict.worst_error is None:
        return f"least sure at {verdict.unsure_column}"
    return f"{verdict.worst_error:.0f} px at {verdict.worst_column}"


def _cause(entry: Entry) -> str | None:
    """The main cause; nothing without a truth."""
    if entry.causes is None:
        return None
    return next(iter(entry.titles), "none")


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 2)


def _cards(
    tables: Any,  # noqa: ANN401
    truth: bool,
    cause: str,
    compared: str,
    told: bool,
    seen: bool,
) -> TableBlueprint:
    lines = (entities.PATH, entities.TRUTH, *([entities.ALTERNATIVE] if compared else []))
    thumbnail = rrb.Spatial2DView(
        origin="/",
        contents=[f"+ /{entities.PHOTO}", *(f"+ /{line}/**" for line in lines)],
        name="skyline",
    )
    errors = [
        *([] if compared else [tables.Column("a_err", name="A_err (px)")]),
        tables.Column("cause", name="cause"),
        tables.Column("worst", name="worst"),
        tables.Column("wrong", name="wrong"),
    ]
    against = _against(tables, truth, compared) if compared else []
    shown = [
        tables.Column("shows", name="shows"),
    ]
    first = [
        tables.Column("photo", name="skyline", column_type=tables.PreviewCell(thumbnail)),
        *against,
    ]
    rest = [
        *(errors if truth else []),
        tables.Column("confidence", name="confidence"),
        tables.Column("margin", name="margin"),
        *(shown if told else []),
        tables.Column("method", name="by"),
        *([tables.Column("seen", name="seen in training")] if seen else []),
    ]
    last = [
        tables.Column("reviewed", name="reviewed", column_type=rr.components.Flag),
        tables.Column("comment", name="comment"),
    ]
    columns = [*first, *rest, *last]
    on_cards = [*first, *last] if compared else columns  # the table has the rest
    in_table = [tables.Column("name"), *columns]
    if truth:
        in_table.append(tables.Column("causes"))  # for filters; too long for cards
    order = tables.SortBy("a_err", direction="descending")
    if not truth:
        order = tables.SortBy("confidence", direction="ascending")
    if compared:
        order = tables.SortBy("change" if truth else "difference", direction="descending")
    blueprint: TableBlueprint = tables.TableBlueprint(
        card_layout=tables.CardLayout(title="name", link="photo", fields=on_cards),
        table_layout=tables.TableLayout(columns=in_table),
        default_layout="cards",
        filters=[tables.col("causes").str.contains(cause)] if cause else [],
        sort_by=order,
    )
    return blueprint


def _against(tables: Any, truth: bool, compared: str) -> list[Any]:  # noqa: ANN401
    """The columns about a second method."""
    name = shown_in_viewer(f"yellow is {shortened(compared)}, apart (px)")
    apart = tables.Column("difference", name=name)
    parting = [
        tables.Column("parts_at", name="they part at"),
        tables.Column("turned_by", name="turned by"),
    ]
    if not truth:
        return [apart, *parting]
    errors = {
        "a_err": "A_err (px)",
        "other_a_err": "with the yellow line (px)",
        "change": "change (px)",
        "outcome": "so it is",
    }
    return [apart, *(tables.Column(one, name=name) for one, name in errors.items()), *parting]
