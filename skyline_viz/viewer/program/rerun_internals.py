"""Every use of a part of rerun-sdk that is private, experimental or called unstable by its makers.

Such a part may be gone with the next version. So nothing else of this project touches one. Each is
looked up here when it is first needed; where it is missing, one sentence says what does not work,
and everything else goes on.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from skyline_viz.system.notes import note

if TYPE_CHECKING:
    from rerun.experimental import ViewerClient


class ViewerError(OSError):
    """The viewer could not be started or did not do its work; the message says why."""


@dataclass(frozen=True)
class Part:
    """A part of rerun-sdk that may be missing."""

    module: str
    """Its module."""

    name: str
    """Its name there; nothing for the module itself."""

    without: str
    """What does not work without it: the end of a sentence."""

    def take(self) -> Any:  # noqa: ANN401
        """The part itself.

        Raises:
            ViewerError: This version of rerun-sdk has no such part.
        """
        try:
            module = import_module(self.module)
            return getattr(module, self.name) if self.name else module
        except (ImportError, AttributeError) as error:
            raise ViewerError(self.lacking) from error

    @property
    def lacking(self) -> str:
        """A sentence for when it is missing."""
        whole = ".".join(filter(None, (self.module, self.name)))
        return f"rerun-sdk {_version()} has no {whole}: {self.without}."


ORPHANS = Part(
    "rerun_bindings",
    "flush_and_cleanup_orphaned_recordings",
    "each recording keeps up to 2 MB of memory until the command ends",
)
PROGRAM = Part(
    "rerun_cli", "__file__", "no viewer opens and no picture is drawn; inspect --save works"
)
CLIENT = Part(
    "rerun.experimental", "ViewerClient", "--screenshot and --connect do not work; windows do"
)
TABLES = Part(
    "rerun.blueprint.table", "", "there are no cards; inspect shows photos one after another"
)
SERVER = Part("rerun", "server", TABLES.without)
TABLE_INDEX = Part("rerun", "SORBET_IS_TABLE_INDEX", TABLES.without)
WIDGET = Part(
    "rerun.notebook", "_Viewer", "notebooks show no viewer; inspect --serve shows one in a browser"
)
PARTS = (ORPHANS, PROGRAM, CLIENT, TABLES, SERVER, TABLE_INDEX, WIDGET)
"""All of them."""

_IN_BROWSERS = (b"class WebHandle", b"open_channel(", b"send_rrd_to_channel(", b"close_channel(")
"""What `viewer_page/start.js` calls of the viewer's program for browsers."""


def let_go_of_orphans() -> None:
    """Free what recordings hold that nobody uses any more; Rerun keeps it until it is told to."""
    try:
        release = ORPHANS.take()
    except ViewerError as error:
        note(str(error))
        return
    release()


@cache
def program() -> Path:
    """The viewer's program, which lies in its Python package.

    Raises:
        ViewerError: It is not where this version is known to have it.
    """
    folder = Path(str(PROGRAM.take())).parent
    places = ("rerun", "rerun.exe", "Rerun.app/Contents/MacOS/Rerun")
    for place in places[1:2] if os.name == "nt" else places:
        if (folder / place).is_file():
            return folder / place
    raise ViewerError(f"rerun-sdk {_version()} has no program in {folder}: {PROGRAM.without}.")


def viewer_client() -> type[ViewerClient]:
    """The class that drives a viewer: asks what it shows, takes pictures, sets times and layouts.

    Raises:
        ViewerError: There is none.
    """
    client: type[ViewerClient] = CLIENT.take()
    return client


def notebook_widget(viewer: Any) -> Any:  # noqa: ANN401
    """The widget of a viewer in a notebook, to lay others beside it.

    Args:
        viewer: A `rerun.notebook.Viewer`.

    Raises:
        ViewerError: It has none.
    """
    kind = WIDGET.take()
    for held in vars(viewer).values():
        if isinstance(held, kind):
            return held
    raise ViewerError(WIDGET.lacking)


@dataclass(frozen=True)
class CardParts:
    """What a gallery of cards is made of."""

    tables: Any
    """The module that lays tables and cards out."""

    server: Any
    """The module with the server of data sets."""

    index: str
    """Metadata key of the column that tells rows apart."""


def card_parts() -> CardParts:
    """What a gallery of cards is made of.

    Raises:
        ViewerError: A part of it is missing.
    """
    return CardParts(TABLES.take(), SERVER.take(), TABLE_INDEX.take())


def check_program_for_browsers(script: bytes) -> None:
    """Make sure that our page can start the viewer's program.

    Args:
        script: Its JavaScript.

    Raises:
        ViewerError: It has another interface.
    """
    if missing := list(_missing(script)):
        raise ViewerError(
            f"the viewer for browsers of rerun-sdk {_version()} has no {' and no '.join(missing)}: "
            "no stages are shown in a browser; windows work."
        )


def _missing(script: bytes) -> Iterable[str]:
    return (one.decode().rstrip("(") for one in _IN_BROWSERS if one not in script)


def _version() -> str:
    try:
        return version("rerun-sdk")
    except PackageNotFoundError:
        return "of this version"
