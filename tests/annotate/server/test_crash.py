"""The server is killed at random moments: what it acknowledged is there afterwards."""

import os
import random
import re
import signal
import sqlite3
import subprocess
import sys
import threading
from contextlib import closing, suppress

import httpx

from annotate.engine.edits import Edits
from annotate.store.database import NAME
from annotate.store.history import State, folded
from annotate.store.store import Store
from testing.labelling import asked, started, write_hills

KILLS = 8
OPERATIONS = 650


def drawn(chance):
    """A change: its route, and what is sent."""
    column, row = chance.randrange(70), chance.randrange(48)
    kind = chance.choice(["anchor", "anchor", "tag", "status", "undo"])
    if kind == "undo":
        return "undo", asked()
    operations = {
        "anchor": {"kind": "anchor", "column": column, "row": row},
        "tag": {"kind": "tag", "tag": f"t{column}", "on": bool(row % 2)},
        "status": {"kind": "status", "status": ("accepted", "rejected")[row % 2]},
    }
    return "operations", asked(operation=operations[kind])


def test_nothing_is_lost_or_done_twice_when_the_server_is_killed(tmp_path):
    folder = write_hills(tmp_path, count=2)
    chance = random.Random(7)
    acknowledged, bodies, waiting = {}, {}, None
    while len(acknowledged) < OPERATIONS:
        process, client = started(folder)
        stop_after = chance.randint(20, 2 * OPERATIONS // KILLS)
        with client, suppress(httpx.HTTPError):
            for number in range(stop_after + 200):
                if number == stop_after:  # at any moment of one of the next requests
                    moment = chance.uniform(0, 0.02)
                    killer = threading.Timer(moment, os.kill, (process.pid, signal.SIGKILL))
                    killer.start()
                if waiting is None and bodies and chance.random() < 0.1:
                    what, body = chance.choice(list(bodies.values()))  # once more
                else:  # the one without an answer comes first
                    what, body = waiting = waiting or drawn(chance)
                said = client.post(f"/api/photos/1/{what}", json=body)
                waiting = None
                if said.status_code == 200:
                    found = said.json()
                    first = acknowledged.setdefault(body["id"], (found["kept"], found["rows"]))
                    assert first[0] == found["kept"]
                    bodies[body["id"]] = what, body
                else:
                    refused = (
                        r"there is nothing to undo\.|hill-0\.png is (accepted|rejected) already\."
                    )
                    assert re.fullmatch(refused, said.json()["detail"])
        killer.join()
        process.communicate(timeout=20)
        with closing(sqlite3.connect(folder / NAME)) as database:
            rows = "SELECT id, request FROM operations"
            kept = {request: revision for revision, request in database.execute(rows)}
            assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        assert {
            one: revision for one, (revision, _) in acknowledged.items()
        }.items() <= kept.items()
        unanswered = set(kept) - set(acknowledged)
        assert unanswered <= {waiting[1]["id"] if waiting else None}
    process, client = started(folder)
    with client:
        found = client.get("/api/photos/1").json()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=20)
    with closing(sqlite3.connect(folder / NAME)) as database:
        log = database.execute("SELECT id, at, kind, body FROM operations").fetchall()
    store = Store(folder)
    assert store.state(1) == folded(State(Edits(48, 70)), log)
    assert found["rows"] == store.state(1).line.skyline.rows.tolist()
    last, lines = max(acknowledged.values(), key=lambda one: one[0])
    if found["revision"] == last:
        assert found["rows"] == lines
    store.close()


def test_a_second_server_on_the_folder_is_refused(tmp_path):
    folder = write_hills(tmp_path, count=1)
    process, client = started(folder)
    with client:
        second = subprocess.run(
            [sys.executable, "-m", "annotate", "open", folder, "--no-browser"],
            capture_output=True,
            text=True,
            check=False,
        )
        assert second.returncode == 2
        assert second.stderr.count("\n") == 1
        assert "open in another skyline-annotate" in second.stderr
        assert client.get("/api/photos").status_code == 200
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=20)
    assert "Labels are in" in out
