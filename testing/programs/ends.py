"""Commands as real processes that are ended in the middle of their work, and what they leave."""

import os
import shutil
import signal
import subprocess
import sys
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import psutil

import skyline_viz as sv
from skyline_viz.rendering import render
from testing import PATIENCE, until


def write_set(folder: Path, photos: int, size: tuple[int, int] = (480, 360)) -> Path:
    """A plain data set: photos of one scene, each of another brightness, and their truth."""
    for part in ("images", "masks"):
        (folder / part).mkdir(parents=True)
    scene = render("desert", 50, *size)
    mask = (~scene.truth.to_mask(size[1])).astype(np.uint8) * np.uint8(255)
    for number in range(photos):
        darker = (scene.photo * (1 - number / (4 * photos))).astype(np.uint8)
        sv.write_photo(folder / "images" / f"hill-{number:03}.png", darker)
        sv.write_photo(folder / "masks" / f"hill-{number:03}.png", mask)
    return folder


@dataclass(frozen=True)
class Case:
    """A command, and how to see that it is at work."""

    words: tuple[str, ...]
    """The command line; ``DATA`` and ``OUT`` stand for folders."""

    sign: str
    """What it prints then, or a pattern of files in ``OUT`` (with a star), or ``workers``."""

    program: str = "skyline_viz"
    """The module that is run."""


CASES = {
    "detect": Case(("detect", "DATA", "--out", "OUT", "--workers", "2"), "*.csv"),
    "detect --cluster": Case(
        ("detect", "DATA", "--out", "OUT/all.parquet", "--cluster", "local:2"), "workers"
    ),
    "evaluate": Case(("evaluate", "DATA", "--out", "OUT", "--workers", "2"), "unfinished/*/*.json"),
    "diagnose": Case(("diagnose", "DATA", "--out", "OUT", "--workers", "2"), "unfinished/*/*.json"),
    "tables": Case(
        ("tables", "DATA", "--out", "OUT", "--workers", "2", "--method", "paper", "edges"),
        "unfinished/*/*.json",
    ),
    "gallery": Case(("gallery", "DATA", "--out", "OUT", "--workers", "2", "--serve"), "*/*.rrd"),
    "train": Case(("train", "DATA", "--out", "OUT/bank.npz", "--workers", "2"), "workers"),
    "inspect --save": Case(("inspect", "DATA", "--save", "OUT/photos.rrd"), ".*.rrd"),
    "inspect --serve": Case(("inspect", "PHOTO", "--serve"), "Open http"),
    "inspect --screenshot": Case(("inspect", "PHOTO", "--screenshot", "OUT/a.png"), "a-*.png"),
    "gallery --serve": Case(("gallery", "FEW", "--out", "OUT", "--serve"), "Ctrl-C ends"),
    "open": Case(("open", "FEW", "--no-browser"), "Ctrl-C ends", "annotate"),
}
"""All commands that start processes or write for long."""

SERVING = ("inspect --serve", "gallery --serve", "open")
"""Those that go on until they are asked to end."""


@dataclass(frozen=True)
class Left:
    """What a command left behind."""

    status: int
    """Its exit status."""

    said: str
    """What it printed on stderr."""

    processes: list[str]
    """Processes that live on."""

    files: list[str]
    """Temporary files and folders."""

    def __bool__(self) -> bool:
        """Whether anything was."""
        return bool(self.processes or self.files)


def ended(name: str, ending: signal.Signals, data: Path, folder: Path) -> Left:
    """Start a command, wait until it is at work, send a signal, and see what is left.

    Args:
        name: One of `CASES`.
        ending: The signal.
        data: A large data set.
        folder: An empty folder.
    """
    case = CASES[name]
    out, passing, few = folder / "out", folder / "tmp", folder / "few"
    for one in (out, passing, few):
        one.mkdir(parents=True)
    for photo in sorted((data / "images").iterdir())[:2]:
        shutil.copy(photo, few)
    places = {"DATA": data, "OUT": out, "FEW": few, "PHOTO": next(few.iterdir())}
    words = [_placed(word, places) for word in case.words]
    process = started([case.program, *words], folder, TMPDIR=str(passing))
    log = folder / "stdout"
    until(lambda: _at_work(case.sign, out, log, process), process)
    family = psutil.Process(process.pid).children(recursive=True)
    process.send_signal(ending)
    _, errors = process.communicate(timeout=PATIENCE)  # ends when nobody holds the pipe any more
    with suppress(AssertionError):  # then it is what is left
        until(lambda: not _living(family) and not list(passing.iterdir()))
    hidden = [path for path in out.rglob(".*") if not path.name.startswith(".skyline")]
    files = [str(path) for path in (*passing.iterdir(), *hidden)]
    return Left(process.returncode, errors.decode(), _living(family), files)


def started(words: list[str], folder: Path, **more: str) -> subprocess.Popen[bytes]:
    """A command of ours as a process, whose output goes into ``folder/stdout``."""
    environment = {**os.environ, "PYTHONUNBUFFERED": "1", "CI": "1", **more}
    with (folder / "stdout").open("wb") as log:
        return subprocess.Popen(
            [sys.executable, "-m", *words], stdout=log, stderr=subprocess.PIPE, env=environment
        )


def _placed(word: str, places: dict[str, Path]) -> str:
    for name, place in places.items():
        if word == name or word.startswith(f"{name}/"):
            return str(place) + word[len(name) :]
    return word


def _at_work(sign: str, out: Path, log: Path, process: subprocess.Popen[bytes]) -> bool:
    if sign == "workers":
        with suppress(psutil.Error):
            family = psutil.Process(process.pid).children()
            busy = [one for one in family if one.cpu_times().user > 1]
            return len(busy) >= 2
        return False
    if "*" in sign:
        return next(out.glob(sign), None) is not None
    return sign in log.read_text()


def _living(family: list[psutil.Process]) -> list[str]:
    """Those that still run; nobody may have taken note of those that are dead."""
    living = []
    for one in family:
        with suppress(psutil.Error):
            if one.is_running() and one.status() != psutil.STATUS_ZOMBIE:
                living.append(" ".join(one.cmdline()[:4]))
    return living
