"""Label skylines in the browser: the detector proposes, a few clicks correct, nothing is lost.

The engine works without any server:

    wire = LiveWire(photo, Detector())
    wire.anchor(column, row)
    wire.skyline.rows
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from annotate.labels import Label
    from annotate.live_wire import LiveWire

__all__ = ["Label", "LiveWire"]


def __getattr__(name: str) -> object:
    """Import what is asked for only then, so that ``skyline-annotate --help`` is quick."""
    if name == "LiveWire":
        from annotate.live_wire import LiveWire  # noqa: PLC0415

        return LiveWire
    if name == "Label":
        from annotate.labels import Label  # noqa: PLC0415

        return Label
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
