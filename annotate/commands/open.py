"""``skyline-annotate open``: label the photos of a folder in the browser."""

from __future__ import annotations

import socket
import webbrowser
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import tyro

from annotate.commands.options import (
    PROGRAM,
    Annotator,
    PhotoFolder,
    check_folder,
    locked,
    whoever,
)
from annotate.store.labels import MOST_PASSES
from skyline_viz.command_line.messages import GOOD, UsageError, counted, say, tell
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.settings import Switch
from skyline_viz.command_line.sizes import MaxMegapixels, say_too_large
from skyline_viz.diagnosis.causes import DOUBTFUL, Cause, Place, Preferring
from skyline_viz.system.endings import told_by_signals
from skyline_viz.system.memory import MAX_MEGAPIXELS

if TYPE_CHECKING:
    from annotate.store.store import Store
    from annotate.work.workbench import Workbench
    from skyline_viz.method import Method


@dataclass(frozen=True)
class Open:
    """Label the photos of a folder in the browser: the detector proposes, a few clicks correct."""

    folder: PhotoFolder
    """Folder of photos; labels are kept in it, in skyline-labels.sqlite."""

    annotator: Annotator = ""
    """Who labels; the user's name unless given."""

    pass_number: int = 1
    """1 for the first pass over the photos, 2 to label them a second time."""

    reviewer: Annotated[str, tyro.conf.arg(metavar="NAME")] = ""
    """Who looks the pass of somebody else through, and says what is wrong there."""

    order: Literal["name", "confidence", "random"] = "name"
    """In which order: by name, the least certain proposal first, or shuffled."""

    blind: float = 0.0
    """Share of the photos, 0 to 1, that are labelled without a proposal, to measure its bias."""

    seed: int = 0
    """Seed of the shuffled order, and of which photos are blind."""

    from_diagnosis: Annotated[Path | None, tyro.conf.arg(metavar="FILE")] = None
    """diagnosis.json of skyline-viz diagnose: only photos whose truth is doubtful, where it is."""

    cause: Annotated[Cause | Place | Preferring, tyro.conf.arg(metavar="CAUSE")] = DOUBTFUL
    """With --from-diagnosis: photos with another cause, place or term of the cost, as skyline-viz
    gallery --cause takes it."""

    methods: MethodOptions = field(default_factory=Methods)
    """Another method to propose with than ours."""

    host: Annotated[str, tyro.conf.arg(metavar="ADDRESS")] = "127.0.0.1"
    """Address to listen on; any other than the default lets other machines in."""

    port: int = 0
    """Port to listen on; 0 takes the one that the folder had last, or a free one."""

    no_browser: Switch = False
    """Print the address, and do not open it."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Serve until Ctrl-C; return the exit status."""
        self._check()
        with locked(self.folder):
            return self._serve()

    def _check(self) -> None:
        check_folder(self.folder)
        if self.cause != DOUBTFUL and not self.from_diagnosis:
            raise UsageError("--cause is that of a diagnosis; --from-diagnosis FILE names it.")
        if not 0 <= self.blind <= 1:
            raise UsageError(f"--blind is a share from 0 to 1, not {self.blind}.")
        if not 1 <= self.pass_number <= MOST_PASSES:
            raise UsageError(
                f"passes are numbered from 1 to {MOST_PASSES:,}, so there is no pass "
                f"{self.pass_number}."
            )
        if not 0 <= self.port < 2**16:
            raise UsageError(f"ports are numbered up to 65535, so there is no port {self.port}.")

    def _unread(self) -> list[str]:
        """A sentence about pictures in the folder that cannot be read, where there are any."""
        from annotate.store.folder import unread_below

        return [unread] if (unread := unread_below(self.folder)) else []

    def _serve(self) -> int:
        from annotate.store.store import Store
        from annotate.work.doubts import read_doubts
        from annotate.work.workbench import Assignment, Workbench

        who = Assignment(
            whoever(self.annotator),
            self.pass_number,
            self.order,
            self.blind,
            self.seed,
            reviewer=whoever(self.reviewer) if self.reviewer else "",
        )
        doubts = None
        if self.from_diagnosis:
            doubts = read_doubts(self.from_diagnosis, self.cause)
        detector: Method
        detector = self.methods.one()
        bench = Workbench(Store(self.folder), detector, who, doubts)
        if doubts is not None and not bench.photos:
            raise UsageError(
                f"{self.from_diagnosis} has the cause {self.cause} of no photo in {self.folder}."
            )
        if not bench.photos:
            raise UsageError(" ".join([f"{self.folder} holds no photograph.", *self._unread()]))
        for problem in bench.store.problems:
            say(problem, PROGRAM)
        for unread in self._unread():
            say(unread, PROGRAM)
        most = self.max_megapixels * 1e6
        every = bench.photos.values()
        say_too_large([one.name for one in every if one.height * one.width > most], PROGRAM)
        if self.order == "confidence":
            propose_all(bench)
        progress = bench.progress(bench.cards())
        left = progress.total - progress.done
        tell(f"{counted(progress.total, 'photo')} in {self.folder}, {left} to label.")
        serve(bench, self.host, self.port, browser=not self.no_browser)
        tell(f"Labels are in {self.folder}.")
        return GOOD


def propose_all(bench: Workbench) -> None:
    """Make all proposals that are missing, so that they can be compared."""
    from skyline_viz.running.batch import sentence
    from skyline_viz.running.progress import ProgressBar

    waiting = [one for one in bench.cards() if one.confidence is None and one.status == "to do"]
    with ProgressBar(len(waiting), "proposing") as bar:
        for card in waiting:
            try:
                bench.session(card.photo.id)
            except Exception as error:  # the page shows it, too
                say(sentence(error), PROGRAM)
            bar.advance()


def serve(bench: Workbench, host: str, port: int, *, browser: bool) -> None:
    """Serve the page until Ctrl-C, and print its address."""
    import uvicorn

    from annotate.server.app import make_app
    from skyline_viz.system.loopback import allowed_hosts
    from skyline_viz.viewer.program.process import has_display

    listener, token = found_again(bench.store, host, port)
    port = listener.getsockname()[1]
    app = make_app(bench, token, allowed_hosts(host, port))
    name = "127.0.0.1" if host in ("0.0.0.0", "::") else host  # noqa: S104
    address = f"http://{f'[{name}]' if ':' in name else name}:{port}/?token={token}"
    tell(f"Label at {address}")
    if host not in ("127.0.0.1", "::1", "localhost"):
        say(f"{host} lets other machines in; whoever knows the address can change labels.", PROGRAM)
    tell("Ctrl-C ends.")
    if browser and has_display():
        webbrowser.open(address)
    config = uvicorn.Config(
        app, log_level="warning", access_log=False, server_header=False, lifespan="on"
    )
    server = uvicorn.Server(config)

    def stop() -> None:
        server.should_exit = True

    with told_by_signals(stop):
        server.run(sockets=[listener])


def found_again(store: Store, host: str, port: int) -> tuple[socket.socket, str]:
    """A socket and a token: those that the folder had last, as far as they are still to be had.

    Raises:
        UsageError: As `bound` does.
    """
    from annotate.server.address import Address, folder_id, keep_address, kept_address, new_address

    folder = folder_id(store)
    address = kept_address(folder) or new_address()
    try:
        listener = bound(host, port or address.port)
    except UsageError:
        if port:
            raise
        # a page that is open still tells its token to whoever listens there now
        address, listener = new_address(), bound(host, 0)
    try:
        keep_address(folder, Address(address.token, listener.getsockname()[1]))
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        say(f"the address cannot be kept for the next time: {reason}.", PROGRAM)
    return listener, address.token


def bound(host: str, port: int) -> socket.socket:
    """A socket that listens on an address.

    Raises:
        UsageError: The address is taken, or not one of this machine.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    # said to be TCP, or answers would wait 40 ms for the other side's acknowledgement
    listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen()  # before the address is told: whoever comes now waits, and is served
    except OSError as error:
        listener.close()
        reason = (error.strerror or str(error)).lower()
        raise UsageError(f"cannot listen on {host}, port {port}: {reason}.") from error
    return listener
