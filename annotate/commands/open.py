"""``skyline-annotate open``: label the photos of a folder in the browser."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import tyro

from annotate.commands.options import (
    PROGRAM,
    Annotators,
    HostNames,
    PhotoFolder,
    check_folder,
    locked,
    whoever,
)
from annotate.commands.serving import serve
from annotate.store.labels import MOST_PASSES
from skyline_viz.command_line.messages import GOOD, UsageError, say, tell
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.settings import Switch
from skyline_viz.command_line.sizes import MaxMegapixels, say_too_large
from skyline_viz.diagnosis.causes import DOUBTFUL, Cause, Place, Preferring
from skyline_viz.system.memory import MAX_MEGAPIXELS

if TYPE_CHECKING:
    from annotate.store.store import Store
    from annotate.work.workbench import Workbench
    from skyline_viz.method import Method


@dataclass(frozen=True)
class Open:
    """Label the photos of a folder in the browser: the detector proposes, a few clicks correct.

    Examples:
        skyline-annotate open photos
        skyline-annotate open photos --order confidence
        skyline-annotate open photos --annotator ada --pass-number 2 --blind 0.2
    """

    folder: PhotoFolder
    """Folder of photos; labels are kept in it, in skyline-labels.sqlite."""

    annotator: Annotators = ()
    """Who labels; the user's name unless given. Given several times, all of them do at the same
    time, each in an own pass, by an address of their own. They are remembered."""

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
    """Address to listen on; any other than the default lets other machines in. 0.0.0.0 stands for
    all addresses of this machine."""

    allow_host: HostNames = ()
    """A name by which other machines call this one, besides its own, as behind a proxy."""

    port: int = 0
    """Port to listen on; 0 takes the one that the folder had last, or a free one."""

    no_browser: Switch = False
    """Print the address, and do not open it. Addresses of several people are printed only."""

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
        from annotate.server.hosts import is_name

        for name in self.allow_host:
            if not is_name(name):
                raise UsageError(
                    "--allow-host takes the name of a machine, such as lab.example.org, "
                    f"not {name}."
                )
        if not 0 <= self.port < 2**16:
            raise UsageError(f"ports are numbered up to 65535, so there is no port {self.port}.")

    def _not_taken(self) -> list[str]:
        """Sentences about pictures in the folder that are no photos to label."""
        from skyline_viz.datasets.tree import Tree

        return [*Tree.of(self.folder).said()]

    def _people(self, store: Store) -> list[str]:
        """Who labels: as said, or those of the last time where they were several."""
        from annotate.server.address import folder_id, kept_address

        if not self.annotator:
            kept = kept_address(folder_id(store))
            return list(kept.people) if kept and len(kept.people) > 1 else [whoever("")]
        people = [whoever(name) for name in self.annotator]
        for name in people:
            if people.count(name) > 1:
                raise UsageError(f"{name} is named twice.")
        return people

    def _serve(self) -> int:
        from annotate.store.store import Store
        from annotate.work.doubts import read_doubts
        from annotate.work.shared_photos import SharedPhotos
        from annotate.work.workbench import Assignment, Workbench

        doubts = None
        if self.from_diagnosis:
            doubts = read_doubts(self.from_diagnosis, self.cause)
        detector: Method
        detector = self.methods.one()
        store = Store(self.folder)
        people = self._people(store)
        reviewer = whoever(self.reviewer) if self.reviewer else ""
        shared = SharedPhotos(store, doubts)
        benches = [
            Workbench(
                shared,
                detector,
                Assignment(
                    name, self.pass_number, self.order, self.blind, self.seed, reviewer=reviewer
                ),
            )
            for name in people
        ]
        if doubts is not None and not shared.by_id:
            raise UsageError(
                f"{self.from_diagnosis} has the cause {self.cause} of no photo in {self.folder}."
            )
        if not shared.by_id:
            raise UsageError(" ".join([f"{self.folder} holds no photograph.", *self._not_taken()]))
        for problem in store.problems:
            say(problem, PROGRAM)
        for unread in self._not_taken():
            say(unread, PROGRAM)
        most = self.max_megapixels * 1e6
        every = shared.by_id.values()
        say_too_large([one.name for one in every if one.height * one.width > most], PROGRAM)
        if self.order == "confidence":
            propose_all(benches)
        serve(benches, self.host, self.port, self.allow_host, browser=not self.no_browser)
        tell(f"Labels are in {self.folder}.")
        return GOOD


def propose_all(benches: Sequence[Workbench]) -> None:
    """Make all proposals that are missing, so that they can be compared.

    Photo by photo, so that what is found for one person is found for all.
    """
    from skyline_viz.running.batch import sentence
    from skyline_viz.running.progress import ProgressBar

    waiting = sorted(
        (
            (card.photo.name, bench, card.photo.id)
            for bench in benches
            for card in bench.cards()
            if card.confidence is None and card.status == "to do"
        ),
        key=lambda one: one[0],
    )
    with ProgressBar(len(waiting), "proposing") as bar:
        for name, bench, photo in waiting:
            try:
                bench.session(photo)
            except Exception as error:  # the page shows it, too
                say(sentence(error), PROGRAM)
            bar.advance(name)
