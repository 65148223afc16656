"""The store: a server that is killed, changes that come again, disks that fill, damaged help."""

import json
import os
import random
import signal
import sqlite3
import subprocess
import tempfile
import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path

import httpx
import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from annotate.engine.edits import EditError, Edits
from annotate.store import checkpoints
from annotate.store.database import NAME, StoreError
from annotate.store.history import State, folded
from annotate.store.lines import Line
from annotate.store.store import Store
from benchmarks.reliability import Trial
from skyline_viz.skyline import Skyline
from testing.labelling import asked, started, write_hills
from testing.logs import EMPTY, edits, known_to_version_1, logs, new_moves, old_moves, others

_KILLS = 25
_DISKS = 12
_LOGS = 2000
_SENT = 4000
_DAMAGED = 1000
_LINE = Line(Skyline(rows=[5] * 70), np.zeros(70, np.uint8))


def measured() -> list[Trial]:
    """Try it all."""
    return [killed(), sent_again(), full(), checkpointed(), old(), damaged()]


def killed() -> Trial:
    """Kill a real server at random moments; send what was not answered again, and old ones, too."""
    chance = random.Random(3)
    waiting: tuple[str, dict] | None = None
    answered: dict[str, int] = {}
    bodies: dict[str, tuple[str, dict]] = {}
    with tempfile.TemporaryDirectory() as scratch:
        folder = write_hills(Path(scratch), count=1)
        for _ in range(_KILLS):
            process, client = started(folder)
            moment = chance.uniform(0, 0.02)
            killer = threading.Timer(moment, os.kill, (process.pid, signal.SIGKILL))
            left = chance.randint(1, 80)
            with client, suppress(httpx.HTTPError):
                while True:
                    if left == 0:  # at any moment of one of the next requests, or between them
                        killer.start()
                    left -= 1
                    if answered and waiting is None and chance.random() < 0.2:
                        what, body = bodies[chance.choice(list(bodies))]
                    else:
                        what, body = waiting or _change(chance)
                        waiting = what, body
                    said = client.post(f"/api/photos/1/{what}", json=body)
                    if said.status_code == 200:
                        kept = said.json()["kept"]
                        assert answered.setdefault(body["id"], kept) == kept
                        bodies[body["id"]] = what, body
                    if waiting and waiting[1] is body:
                        waiting = None
            killer.join()
            process.communicate(timeout=30)
        lost, doubled, wrong = _compared(folder, list(answered))
    return Trial(
        "the server is killed (SIGKILL)",
        f"{len(answered):,} changes over HTTP; after each kill the one without an answer is sent "
        "again with its id, and at random those before it; then the log is folded anew",
        _KILLS,
        _told(lost, "acknowledged changes lost", doubled, "done twice", wrong, "states wrong"),
    )


def sent_again() -> Trial:
    """Send changes many times, in any order, to the store itself."""
    chance = random.Random(4)
    wrong = sent = 0
    with tempfile.TemporaryDirectory() as scratch:
        store = Store(write_hills(Path(scratch), count=1))
        label = store.begin(store.find()[0].id, "ann", 1)
        done: dict[str, tuple[str, dict, int]] = {}
        while sent < _SENT:
            what, body = _change(chance)
            kind, rest = _logged(what, body)
            with suppress(EditError):
                revision = store.append(label, -1, kind, rest, _LINE, body["id"])
                done[body["id"]] = kind, rest, revision
            for known in chance.choices(list(done), k=min(3, len(done))):
                kind, rest, revision = done[known]
                wrong += store.append(label, -1, kind, rest, _LINE, known) != revision
                sent += 1
        store.close()
        lost, doubled, other = _compared(Path(scratch), list(done))
    return Trial(
        "answers are lost and changes come again",
        f"{len(done):,} changes, each sent again at random later moments with its id",
        sent,
        _told(lost, "lost", doubled, "done twice", wrong + other, "answered wrongly"),
    )


def full() -> Trial:
    """Let a small disk fill up while changes are made, make room, and go on."""
    chance = random.Random(5)
    refused = lost = doubled = wrong = tried = 0
    for _ in range(_DISKS):
        with small_disk() as disk:
            if disk is None:
                break
            tried += 1
            store = Store(write_hills(disk, count=1))
            label = store.begin(store.find()[0].id, "ann", 1)
            ballast, done, unsaid = disk / "ballast", [], None
            ballast.write_bytes(bytes(200_000))
            for _ in range(4000):
                what, body = unsaid or _change(chance)
                kind, rest = _logged(what, body)
                try:
                    store.append(label, -1, kind, rest, _LINE, body["id"])
                except StoreError:
                    refused += 1
                    if not ballast.exists():
                        break
                    unsaid = what, body
                    ballast.unlink()
                    continue
                except EditError:
                    continue
                unsaid = None
                done.append(body["id"])
            store.close()
            counts = _compared(disk, done)
            lost, doubled, wrong = lost + counts[0], doubled + counts[1], wrong + counts[2]
    if not tried:
        return Trial("the disk is full", "needs the right to mount one", 0, "not run")
    return Trial(
        "the disk is full",
        "a file system of 1 MB fills up twice while changes are made; "
        f"{refused} of them were refused with a sentence",
        tried,
        _told(lost, "acknowledged changes lost", doubled, "done twice", wrong, "states wrong"),
    )


def checkpointed() -> Trial:
    """Fold random logs whole, and from a checkpoint at a random place."""

    @settings(max_examples=_LOGS, deadline=None, database=None, suppress_health_check=HealthCheck)
    @given(logs(edits, others, old_moves, new_moves), st.integers(0, 60))
    def check(kept: list, cut: int) -> None:
        data = checkpoints.packed(folded(EMPTY, kept[:cut]), 1)
        start = checkpoints.unpacked(data, 1, EMPTY.edits)
        assert start is not None
        assert folded(start, kept[cut:]) == folded(EMPTY, kept)

    said = _nothing_unless(check)
    tried = "random logs, folded whole and from a checkpoint at a random place"
    return Trial("a state is taken up from a checkpoint", tried, _LOGS, said)


def old() -> Trial:
    """Read random logs of version 1."""

    @settings(max_examples=_LOGS, deadline=None, database=None, suppress_health_check=HealthCheck)
    @given(logs(edits, others, old_moves))
    def check(kept: list) -> None:
        state = folded(EMPTY, kept)
        told = (state.done, state.undone, state.status, state.tags, state.seconds)
        assert told == known_to_version_1(kept)

    said = _nothing_unless(check)
    tried = "random logs as version 1 wrote them, read as version 1 read them"
    return Trial("labels of an older version", tried, _LOGS, said)


def damaged() -> Trial:
    """Damage checkpoints at random, and open the label."""
    chance = random.Random(6)
    wrong = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = write_hills(Path(scratch), count=1)
        store = Store(folder)
        label = store.begin(store.find()[0].id, "ann", 1)
        for number in range(checkpoints.EVERY + 20):
            store.append(label, -1, "anchor", {"column": number % 70, "row": number % 40}, _LINE)
        whole = store.state(label)
        with closing(sqlite3.connect(folder / NAME)) as other, closing(Store(folder)) as fresh:
            (good,) = other.execute("SELECT state FROM checkpoints").fetchone()
            for _ in range(_DAMAGED):
                data = bytearray(good)
                for _ in range(chance.randint(1, 5)):
                    data[chance.randrange(len(data))] = chance.randrange(256)
                if chance.random() < 0.2:
                    del data[chance.randrange(len(data)) :]
                with other:
                    other.execute("UPDATE checkpoints SET state = ?", (bytes(data),))
                fresh._states._states.clear()
                wrong += fresh.state(label) != whole
        store.close()
    tried = "random bytes of the checkpoint of a label changed, or its end cut off"
    return Trial("a checkpoint is damaged", tried, _DAMAGED, _told(wrong, "states wrong"))


@contextmanager
def small_disk() -> Iterator[Path | None]:
    """A file system of 1 MB; None where none can be mounted."""
    with tempfile.TemporaryDirectory() as scratch:
        words = ["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", scratch]
        try:
            mounted = subprocess.run(words, capture_output=True, check=False).returncode == 0
        except OSError:
            mounted = False
        try:
            yield Path(scratch) if mounted else None
        finally:
            if mounted:
                subprocess.run(["umount", scratch], check=True)


def _change(chance: random.Random) -> tuple[str, dict]:
    """A change as the page sends it."""
    kind = chance.choice(["anchor", "anchor", "hidden", "tag", "status", "undo", "undo", "redo"])
    if kind in ("undo", "redo"):
        return kind, asked()
    column = chance.randrange(70)
    operation = {
        "anchor": {"kind": "anchor", "column": column, "row": chance.randrange(48)},
        "hidden": {"kind": "hidden", "first": column, "last": column, "hidden": column % 2 == 0},
        "tag": {"kind": "tag", "tag": f"t{column}", "on": chance.random() < 0.5},
        "status": {"kind": "status", "status": chance.choice(["accepted", "rejected"])},
    }[kind]
    return "operations", asked(operation=operation)


def _logged(what: str, body: dict) -> tuple[str, dict]:
    """Kind and body of a change for the log."""
    if what != "operations":
        return what, {"status": True}
    rest = dict(body["operation"])
    return rest.pop("kind"), rest


def _compared(folder: Path, acknowledged: list[str]) -> tuple[int, int, int]:
    """Changes that were lost, changes done twice, and whether the state differs from its log."""
    with closing(sqlite3.connect(folder / NAME)) as database:
        log = database.execute("SELECT id, at, kind, body, request FROM operations").fetchall()
        kept = database.execute("SELECT last, status, tags, seconds FROM standings").fetchone()
        sound = database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    ids = [row[4] for row in log]
    whole = folded(State(Edits(48, 70)), [row[:4] for row in log])
    standing = (whole.last, whole.status, whole.tags, whole.seconds)
    told = (kept[0], kept[1], tuple(json.loads(kept[2])), kept[3])
    store = Store(folder)
    same = sound and store.state(1) == whole and standing == told
    store.close()
    return len(set(acknowledged) - set(ids)), len(ids) - len(set(ids)), int(not same)


def _told(*counts_and_words: int | str) -> str:
    pairs = zip(counts_and_words[::2], counts_and_words[1::2], strict=True)
    return ", ".join(f"{count} {words}" for count, words in pairs if count) or "nothing"


def _nothing_unless(check) -> str:
    try:
        check()
    except AssertionError as error:
        return f"a state: {str(error).splitlines()[0]}"
    return "nothing"
