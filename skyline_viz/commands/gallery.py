"""``skyline-viz gallery``: a whole data set as cards, the worst first."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import tyro

from skyline_viz.command_line.clusters import on_cluster
from skyline_viz.command_line.inputs import collect, output_folder
from skyline_viz.command_line.local import called
from skyline_viz.command_line.messages import (
    GOOD,
    SOME_FAILED,
    UsageError,
    counted,
    say,
    status_after,
    tell,
    tell_done,
    tell_row,
)
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.settings import (
    ClusterAddress,
    Folder,
    OptionalFolder,
    Switch,
    check_picture,
)
from skyline_viz.command_line.sizes import MaxMegapixels, foresee
from skyline_viz.command_line.truth_options import TruthOptions, Truths
from skyline_viz.commands.gallery_pages import write_pages
from skyline_viz.diagnosis.causes import Cause, Place, Preferring, filter_words
from skyline_viz.running.batch import Failure
from skyline_viz.system.aftermath import ended
from skyline_viz.system.endings import told_by_signals
from skyline_viz.system.memory import MAX_MEGAPIXELS, RECORDING

if TYPE_CHECKING:
    from skyline_viz.datasets.named_item import NamedItem
    from skyline_viz.gallery.entry import Entry
    from skyline_viz.gallery.table import ServedGallery
    from skyline_viz.method import Method

FlaggedPhotos: TypeAlias = Annotated[tuple[str, ...], tyro.conf.arg(metavar="PHOTO")]

LOOK_EVERY = 0.5
"""Seconds between two looks at what people said about photos, and at whether to end."""

NO_DISPLAY = (
    "there is no display to open the viewer on; --html DIR writes pages for a browser, "
    "--screenshot FILE.png draws the cards, and --serve shows them elsewhere on this machine."
)
"""What is said where no window can be opened."""

PICTURE = (1280, 840)
"""Width and height of a picture of the cards, in pixels: two rows of them are whole."""


@dataclass(frozen=True)
class GalleryCommand:
    """Detect a data set and show it as cards, the worst first: look inside, review, comment.

    Examples:
        skyline-viz gallery hills
        skyline-viz gallery hills --cause "missed edge"
        skyline-viz gallery hills --screenshot cards.png
    """

    photos: Annotated[
        tuple[str, ...],
        tyro.conf.Positional,
        tyro.conf.arg(metavar="PHOTO"),
    ] = ()
    """Photos, folders of photos, or data sets, by paths or addresses."""

    out: Folder = Path("skyline-gallery")
    """Folder of the gallery: recordings, gallery.json, flags.json. What is there is not redone."""

    cause: Annotated[Cause | Place | Preferring | None, tyro.conf.arg(metavar="CAUSE")] = None
    """Show only photos that went wrong by this cause, in any of their failing segments: truth
    doubtful, missed edge, starved bin, misjudged, too steep or cheaper path; at this place: cloud
    above, haze, wire, snow, frame or foreground ridge; or because this term of the cost prefers
    another line: score, strength, no edge, clear sky, sky or link."""

    flag: FlaggedPhotos = ()
    """Mark photos of the gallery as reviewed, by name or file, and print what is said about them;
    nothing is detected or shown."""

    unflag: FlaggedPhotos = ()
    """Take that back."""

    comment: Annotated[str | None, tyro.conf.arg(metavar="TEXT")] = None
    """Comment on the photos of --flag or --unflag; an empty text takes a comment away."""

    list_flags: Switch = False
    """Print what was reviewed and commented, a photo a line, separated by tabs; nothing else."""

    screenshot: Annotated[Path | None, tyro.conf.arg(metavar="FILE.png")] = None
    """Draw the cards into a file instead of opening the viewer; needs no screen."""

    html: OptionalFolder = None
    """Write pages for any browser into a folder instead: cards to sort and filter, a page a photo.
    No viewer, no server."""

    serve: Switch = False
    """Serve the gallery until Ctrl-C without opening a viewer."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos, their size and the free memory."""

    cluster: ClusterAddress = None
    """Work on a cluster instead: tcp://HOST:PORT, the address of a dask scheduler, or local:N for
    one of N processes on this machine. Its machines share the folders of photos and of --out."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    methods: MethodOptions = field(default_factory=Methods)
    """One method instead of ours, or two: how many photos got better and worse with the second,
    the worst first."""

    truths: TruthOptions = field(default_factory=Truths)
    """How to read masks that leave a choice."""

    def run(self) -> int:
        """Detect what is new, show, and keep what people say; return the exit status."""
        if self.comment is not None and not (self.flag or self.unflag):
            raise UsageError("on which photos? Name them with --flag or --unflag.")
        if self.flag or self.unflag:
            said = change_flags(self.out, self.flag, self.unflag, self.comment)
            return list_flags(self.out, None if self.list_flags else said)
        if self.list_flags:
            return list_flags(self.out)
        if not self.photos:
            raise UsageError("which data set? Name a folder of photos.")
        check_picture(self.screenshot)
        ways = [way for way in ("screenshot", "serve", "html") if getattr(self, way)]
        if len(ways) > 1:
            raise UsageError(f"--{ways[0]} and --{ways[1]} exclude each other.")
        if self.html and self.cause:
            raise UsageError("--cause is for the viewer; the page of --html has a filter for it.")
        inputs = collect(self.photos, self.truths)
        if self.html:
            title = called(self.photos[0])
            chosen = self.methods.chosen()
            return write_pages(
                self.html, title, inputs, chosen, self.out, self.workers, self.cluster
            )
        method, *beside = self._methods()
        if not ways and not _has_display():
            raise UsageError(NO_DISPLAY)
        output_folder(self.out, (one.item for one in inputs))
        with on_cluster(self.cluster, self.workers, self.out):
            entries, failures = build(self.out, inputs, method, self.workers, *beside)
        if not entries:
            return status_after(failures) or SOME_FAILED
        words = filter_words(self.cause) if self.cause else ""
        if words and not any(words in title for one in entries for title in one.titles):
            diagnosed = sum(one.causes is not None for one in entries)
            say(f"none of {counted(diagnosed, 'photo')} with a truth has the cause {self.cause}.")
            return status_after(failures) or SOME_FAILED
        if self.screenshot:
            show_picture(self.out, entries, self.screenshot, words)
        else:
            show(self.out, entries, window=not self.serve, cause=words)
        return status_after(failures)

    def _methods(self) -> Sequence[Method]:
        methods = self.methods.chosen()
        if len(methods) > 2:
            raise UsageError(f"a gallery shows one method or two, and {len(methods)} are named.")
        return methods


def build(
    out: Path,
    inputs: Sequence[NamedItem],
    method: Method,
    workers: int,
    beside: Method | None = None,
) -> tuple[list[Entry], list[Failure]]:
    """Bring a gallery up to date, and return its photos, the worst first, and those that failed."""
    from skyline_viz.evaluation.seen import notes as seen_notes
    from skyline_viz.gallery.better_worse import tables
    from skyline_viz.gallery.entry import by_need
    from skyline_viz.gallery.store import Gallery

    entries: list[Entry] = []
    failures: list[Failure] = []
    workers = foresee((one.item for one in inputs), workers, RECORDING)
    for outcome in Gallery(out).build(inputs, method, beside, workers):
        if isinstance(outcome, Failure):
            failures.append(outcome)
        else:
            entries.append(outcome)
    tell_done(f"{counted(len(entries), 'photo')} in {out}")
    known = {one.name: one.seen for one in entries if one.verdict.a_err is not None}
    for note in seen_notes(method.name, known, folds=True):
        say(note)
    tell(*tables(entries).splitlines())
    return by_need(entries), failures


def show(out: Path, entries: Sequence[Entry], *, window: bool, cause: str = "") -> None:
    """Serve a gallery, in a window if asked for, until that is closed or Ctrl-C."""
    from skyline_viz.gallery.flag_page import flag_page
    from skyline_viz.viewer.program.process import open_viewer

    with (
        _served(out, entries, cause) as gallery,
        flag_page(gallery.gallery, entries) as page,
        _stopped_politely() as stop,
        ExitStack() as around,
    ):
        viewer = None
        if window:
            viewer = open_viewer([gallery.address])
            around.callback(ended, viewer)
        else:
            tell(f"Look at it with: rerun {gallery.address}")
        tell(f"Review and comment in a browser: {page}")
        tell("Ctrl-C ends." if viewer is None else "Closing the viewer, or Ctrl-C, ends both.")
        while not stop.wait(LOOK_EVERY) and (viewer is None or viewer.poll() is None):
            gallery.refresh()


def show_picture(out: Path, entries: Sequence[Entry], path: Path, cause: str = "") -> None:
    """Draw the cards of a gallery into a file."""
    from skyline_viz.viewer.program.process import save_picture

    with _served(out, entries, cause) as gallery:
        save_picture(gallery.address, path, PICTURE)
    tell_done(str(path))


def change_flags(
    out: Path, flag: Sequence[str], unflag: Sequence[str], comment: str | None
) -> list[str]:
    """Review photos of a gallery, take that back, or comment on them: all of it or nothing.

    Args:
        out: Folder of the gallery.
        flag: Photos that are reviewed now.
        unflag: Photos that are not.
        comment: What to say about them all; None leaves what was said.

    Returns:
        The names of the photos.
    """
    from skyline_viz.gallery import flags
    from skyline_viz.gallery.store import Gallery

    gone = dict.fromkeys(flags.read_flags(_existing(out)), "")
    entries = Gallery(out).entries().values()
    if not entries:
        raise UsageError(
            f"{out} holds no photos, or those of an earlier version; bring it up to date first: "
            f"skyline-viz gallery PHOTO... --out {out}"
        )
    files = gone | {entry.name: entry.photo for entry in entries}
    done, undone = flags.find_names(flag, files), flags.find_names(unflag, files)
    if both := set(done) & set(undone):
        raise UsageError(f"{min(both)} cannot be both flagged and not.")
    changes = {name: flags.Change(name in done, comment) for name in (*done, *undone)}
    flags.change_flags(out, changes)
    return [*changes]


def list_flags(out: Path, names: Sequence[str] | None = None) -> int:
    """Print name, whether reviewed (1 or 0) and comment of photos.

    Args:
        out: Folder of the gallery.
        names: The photos; those that are reviewed or commented unless given.
    """
    from skyline_viz.gallery.flags import Flag, read_flags

    flags = read_flags(_existing(out))
    for name in flags if names is None else names:
        flag = flags.get(name, Flag())
        comment = " ".join(flag.comment.split())
        tell_row(name, str(int(flag.reviewed)), comment)
    return GOOD


def _has_display() -> bool:
    from skyline_viz.viewer.program.process import has_display  # the viewer is heavy

    return has_display()


def _existing(out: Path) -> Path:
    if not out.is_dir():
        raise UsageError(f"{out} is no gallery; --out names its folder.")
    return out


@contextmanager
def _served(out: Path, entries: Sequence[Entry], cause: str) -> Iterator[ServedGallery]:
    from skyline_viz.gallery.store import Gallery
    from skyline_viz.gallery.table import served

    truth = any(entry.verdict.a_err is not None for entry in entries)
    with served(Gallery(out), entries, truth, cause) as gallery:
        yield gallery


@contextmanager
def _stopped_politely() -> Iterator[threading.Event]:
    """Let Ctrl-C and a plain kill end the block, instead of cutting it short."""
    stop = threading.Event()
    with told_by_signals(stop.set):
        yield stop
