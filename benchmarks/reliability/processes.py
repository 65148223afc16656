"""Commands that are ended, killed, or meet a full disk, in the middle of their work."""

from __future__ import annotations

import csv
import random
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from time import sleep

from benchmarks.reliability import Trial
from skyline_viz.running.resume import FOLDER
from testing import until
from testing.programs.ends import CASES, SERVING, ended, started, write_set
from testing.programs.full import COMMANDS, fault_of

_HUNG_UP = ("detect", "evaluate", "gallery", "open")
_RUNS, _KILLS = 2, 4


def measured() -> list[Trial]:
    """End, fill, interrupt."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        large = write_set(place / "large" / "hills", photos=100)
        small = write_set(place / "small" / "hills", photos=4, size=(160, 120))
        return [
            _endings("a command is asked to end", signal.SIGTERM, tuple(CASES), large, place),
            _endings("a terminal closes", signal.SIGHUP, _HUNG_UP, large, place),
            _endings("a command is killed", signal.SIGKILL, tuple(CASES), large, place),
            _disks(small, place),
            _resumes(large, place),
        ]


def _endings(
    fault: str, ending: signal.Signals, names: tuple[str, ...], data: Path, place: Path
) -> Trial:
    left = []
    for name in names:
        found = ended(name, ending, data, place / f"{ending.name} {name}")
        if found:
            left.append(f"{name}: {found.processes + found.files}")
        elif ending != signal.SIGKILL:
            wanted = 0 if name in SERVING else 128 + ending
            if found.status != wanted:
                left.append(f"{name}: status {found.status}")
    tried = f"{ending.name} at work, to {', '.join(names)}; processes and temporary files counted"
    return Trial(fault, tried, len(names), _or(left))


def _disks(data: Path, place: Path) -> Trial:
    bad = []
    for name in COMMANDS:
        folder = place / f"full {name}"
        folder.mkdir()
        if fault := fault_of(name, data, folder):
            bad.append(f"{name}: {fault}")
    tried = (
        f"files may not grow any more, in {', '.join(COMMANDS)}; status, sentence and files read"
    )
    return Trial("the disk is full", tried, len(COMMANDS), _or(bad))


def _resumes(data: Path, place: Path) -> Trial:
    """Kill evaluations again and again, let them finish, and compare with one left alone."""
    draw, bad = random.Random(4), []
    words = ["skyline_viz", "evaluate", str(data), "--workers", "2", "--out"]
    whole = place / "whole"
    subprocess.run([sys.executable, "-m", *words, str(whole)], check=True, capture_output=True)
    for number in range(_RUNS):
        out = place / f"killed {number}"
        out.mkdir()
        for _ in range(_KILLS):
            process = started([*words, str(out)], out)
            before = len(list((out / FOLDER).glob("*.json")))
            until(lambda out=out, before=before: _done(out) > before, process)
            sleep(draw.random() / 5)
            process.kill()
            process.communicate()
        kept = _done(out)
        done = subprocess.run(
            [sys.executable, "-m", *words, str(out)], capture_output=True, text=True, check=False
        )
        if f"{kept} of 100 photos were done already" not in done.stderr:
            bad.append(f"{kept} kept, and said: {done.stderr.strip()}")
        if _rows(out) != _rows(whole):
            bad.append("other results")
    tried = (
        f"kill -9 {_KILLS} times in a run over 100 photos, then on to the end; "
        "compared with one that ran through"
    )
    return Trial("an evaluation is killed", tried, _RUNS * _KILLS, _or(bad))


def _done(out: Path) -> int:
    return len(list((out / FOLDER).glob("[!.]*.json")))


def _rows(out: Path) -> list[dict[str, str]]:
    """What was found, without the times."""
    rows = list(csv.DictReader((out / "photos.csv").read_text().splitlines()))
    return [{key: row[key] for key in row if key != "seconds"} for row in rows]


def _or(bad: list[str]) -> str:
    return "; ".join(bad) or "nothing"
