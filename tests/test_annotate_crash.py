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

from annotate.database import NAME
from annotate.security import TOKEN_HEADER
from annotate.store import Store
from tests.labelling import asked, write_hills

KILLS = 12
OPERATIONS = 1000


def started(folder):
    """A server in a process of its own, and a client for it."""
    words = [sys.executable, "-m", "annotate", "open", folder, "--no-browser", "--annotator", "ann"]
    process = subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    for line in process.stdout:
        if found := re.search(r"(http://127\.0\.0\.1:\d+)/\?token=(\S+)", line):
            client = httpx.Client(base_url=found[1], headers={TOKEN_HEADER: found[2]}, timeout=20)
            return process, client
    raise AssertionError(process.stderr.read())


def test_nothing_acknowledged_is_lost_when_the_server_is_killed(tmp_path):
    folder = write_hills(tmp_path, count=2)
    chance = random.Random(7)
    acknowledged = []
    while len(acknowledged) < OPERATIONS:
        process, client = started(folder)
        stop_after = chance.randint(20, 2 * OPERATIONS // KILLS)
        with client, suppress(httpx.HTTPError):
            for number in range(stop_after + 200):
                if number == stop_after:  # at any moment of one of the next requests
                    moment = chance.uniform(0, 0.02)
                    killer = threading.Timer(moment, os.kill, (process.pid, signal.SIGKILL))
                    killer.start()
                column, row = chance.randrange(70), chance.randrange(48)
                kind = chance.choice(["anchor", "anchor", "tag", "undo"])
                if kind == "undo":
                    said = client.post("/api/photos/1/undo", json=asked())
                else:
                    operation = {"kind": "anchor", "column": column, "row": row}
                    if kind == "tag":
                        operation = {"kind": "tag", "tag": f"t{column}", "on": bool(row % 2)}
                    body = asked(operation=operation)
                    said = client.post("/api/photos/1/operations", json=body)
                if said.status_code == 200:
                    acknowledged.append((said.json()["revision"], said.json()["rows"]))
        killer.join()
        process.communicate(timeout=20)
        with closing(sqlite3.connect(folder / NAME)) as database:
            kept = {row[0] for row in database.execute("SELECT id FROM operations")}
            assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        assert {revision for revision, _ in acknowledged} <= kept
    process, client = started(folder)
    with client:
        found = client.get("/api/photos/1").json()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=20)
    store = Store(folder)
    assert found["rows"] == store.state(1).line.skyline.rows.tolist()
    if found["revision"] == acknowledged[-1][0]:
        assert found["rows"] == acknowledged[-1][1]
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
