"""A gallery as a table of cards in the viewer, served on this machine alone.

The only module that uses ``rerun.blueprint.table``, which Rerun calls unstable.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import pyarrow as pa
import rerun as rr
import rerun.blueprint as rrb
import rerun.blueprint.table as rrt

from skyline_viz.diagnosis.causes import Cause
from skyline_viz.gallery.store import Entry, Flag, Gallery
from skyline_viz.system.aftermath import passing_temporaries
from skyline_viz.system.names import recording_id, shortened, shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.blueprints import Contents, detection_blueprint
from skyline_viz.viewer.process import LOOPBACK, free_port
from skyline_viz.viewer.recording import APPLICATION

_DATASET = "photos"
_TABLE = "gallery"


@dataclass
class ServedGallery:
    """A gallery that is being served."""

    address: str
    """What to open in the viewer: the cards."""

    gallery: Gallery
    """Its files."""

    table: Any
    """The table on the server."""

    flags: dict[str, Flag]
    """What is on disk about reviews and comments."""

    names: dict[str, str]
    """Name of each photo in it, by its identifier."""

    _client: Any = field(repr=False)  # the server forgets its tables when it is dropped

    reviewed: int = 0
    """How many of its photos are reviewed, as far as the viewer has said."""

    def save_edits(self) -> bool:
        """Write what people edited in the viewer since; return whether there was anything."""
        rows = self.table.reader().to_arrow_table().to_pylist()
        said = {}
        for row in rows:
            name, comment = self.names[row["id"]], row["comment"] or ""
            before = self.flags.get(name, Flag()).comment
            if comment == shown_in_viewer(before):  # nobody has edited it
                comment = before
            said[name] = Flag(bool(row["reviewed"]), comment)
        self.reviewed = sum(flag.reviewed for flag in said.values())
        merged = self.flags | {
            name: flag for name, flag in said.items() if flag != Flag() or name in self.flags
        }
        if merged == self.flags:
            return False
        self.gallery.save_flags(merged)
        self.flags = merged
        return True


@contextmanager
def served(
    gallery: Gallery, entries: Sequence[Entry], truth: bool, cause: Cause | None = None
) -> Iterator[ServedGallery]:
    """Serve a gallery for as long as the block lasts.

    Args:
        gallery: Its files.
        entries: Its photos, in the order in which to show them.
        truth: Whether there is a truth for any of them.
        cause: Show only those with this cause, by a filter that can be changed in the viewer.
    """
    files = [gallery.recording(entry.name) for entry in entries]
    flags = gallery.flags()
    names = {recording_id(entry.name): entry.name for entry in entries}
    with (
        passing_temporaries() as folder,
        rr.server.Server(host=LOOPBACK, port=free_port(), datasets={_DATASET: files}) as server,
    ):
        client = server.client()
        photos = client.get_dataset(_DATASET)
        layout = folder / "stages.rbl"
        compared = next((entry.compared for entry in entries), "")
        contents = Contents(
            height=519,
            width=1388,  # most photos are wider than high
            truth=truth,
            bank=False,
            filters=entries[0].filters,
            compared=compared,
            diagnosed=any(entry.causes for entry in entries),
            stacked_costs=False,
        )
        detection_blueprint(contents).save(APPLICATION, layout)
        photos.register_blueprint(layout.as_uri())
        table = client.create_table(_TABLE, _SCHEMA)
        table.append(**_columns(entries, flags, photos))
        cards = folder / "cards.rbl"
        _cards(truth, cause, compared).save(_TABLE, cards)
        table.register_blueprint(cards.as_uri())
        address = f"{server.url()}/entry/{table.id}"
        one = ServedGallery(address, gallery, table, flags, names, client)
        one.save_edits()  # nothing yet, but counts what is reviewed
        try:
            yield one
        finally:
            one.save_edits()


_INDEX = {rr.SORBET_IS_TABLE_INDEX: "true"}
_SCHEMA = pa.schema(
    [
        pa.field("id", pa.utf8(), metadata=_INDEX),
        pa.field("name", pa.utf8()),
        pa.field("photo", pa.utf8()),
        pa.field("a_err", pa.float32()),
        pa.field("worst", pa.utf8()),
        pa.field("difference", pa.float32()),
        pa.field("other_a_err", pa.float32()),
        pa.field("margin", pa.float32()),
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
    photos: Any,  # noqa: ANN401
) -> dict[str, list[Any]]:
    said = [flags.get(entry.name, Flag()) for entry in entries]
    return {
        "id": [recording_id(entry.name) for entry in entries],
        "name": [shown_in_viewer(shortened(entry.name)) for entry in entries],
        "photo": [photos.segment_url(recording_id(entry.name)) for entry in entries],
        "a_err": [_rounded(one.a_err) for one in entries],
        "worst": [_worst(entry) for entry in entries],
        "difference": [_rounded(one.difference) for one in entries],
        "other_a_err": [_rounded(one.other_a_err) for one in entries],
        "margin": [round(entry.margin, 2) for entry in entries],
        "wrong": [entry.wrong or "none" for entry in entries],
        "cause": [None if one.causes is None else one.cause or "none" for one in entries],
        "causes": [None if one.causes is None else ", ".join(one.causes) for one in entries],
        "reviewed": [flag.reviewed for flag in said],
        "comment": [shown_in_viewer(flag.comment) for flag in said],
    }


def _worst(entry: Entry) -> str:
    if entry.worst_error is None:
        return f"least sure at {entry.unsure_column}"
    return f"{entry.worst_error:.0f} px at {entry.worst_column}"


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 2)


def _cards(truth: bool, cause: Cause | None, compared: str) -> rrt.TableBlueprint:
    lines = (entities.PATH, entities.TRUTH, *([entities.ALTERNATIVE] if compared else []))
    thumbnail = rrb.Spatial2DView(
        origin="/",
        contents=[f"+ /{entities.PHOTO}", *(f"+ /{line}/**" for line in lines)],
        name="skyline",
    )
    errors = [
        rrt.Column("a_err", name="A_err (px)"),
        rrt.Column("cause", name="cause"),
        rrt.Column("worst", name="worst"),
        rrt.Column("wrong", name="wrong"),
    ]
    against = (
        [rrt.Column("difference", name=shown_in_viewer(f"yellow is {compared}, apart (px)"))]
        if compared
        else []
    )
    if compared and truth:
        against.append(rrt.Column("other_a_err", name="its A_err (px)"))
    columns = [
        rrt.Column("photo", name="skyline", column_type=rrt.PreviewCell(thumbnail)),
        *against,
        *(errors if truth else []),
        rrt.Column("margin", name="margin"),
        rrt.Column("reviewed", name="reviewed", column_type=rr.components.Flag, editable=True),
        rrt.Column("comment", name="comment", editable=True),
    ]
    in_table = [rrt.Column("name"), *columns]
    if truth:
        in_table.append(rrt.Column("causes"))  # for filters; too long for cards
    order = rrt.SortBy("a_err", direction="descending")
    if not truth:
        order = rrt.SortBy("margin", direction="ascending")
    if compared:
        order = rrt.SortBy("difference", direction="descending")
    return rrt.TableBlueprint(
        card_layout=rrt.CardLayout(title="name", link="photo", fields=columns),
        table_layout=rrt.TableLayout(columns=in_table),
        default_layout="cards",
        filters=[rrt.col("causes").str.contains(cause)] if cause else [],
        sort_by=order,
    )
