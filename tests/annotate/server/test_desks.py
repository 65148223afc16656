"""Several people at one server: each with labels of their own, by a token of their own."""

import io
import re
import signal
import subprocess
import sys
import threading
import zipfile

import httpx
import pytest

from annotate.server.security import PASS_HEADER, TOKEN_HEADER
from testing.labelling import asked, done, served_to, write_hills


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "photos")


@pytest.fixture
def people(folder):
    with served_to(folder, "ann", "bob") as clients:
        yield clients


def anchor(column, row):
    return {"kind": "anchor", "column": column, "row": row}


def accepted(client):
    """Files of the accepted photos, as they are exported."""
    said = client.get("/api/exports/csv")
    if said.status_code == 422:  # there is none
        return []
    with zipfile.ZipFile(io.BytesIO(said.content)) as archive:
        return sorted(archive.namelist())


def test_each_has_own_lines_undo_progress_and_exports(people):
    ann, bob = people
    assert [one.get("/api/photos").json()["annotator"] for one in people] == ["ann", "bob"]
    done(ann, 1, anchor(30, 5))
    done(ann, 1, {"kind": "status", "status": "accepted"})
    before = bob.get("/api/photos/1").json()
    assert (before["revision"], before["anchors"], before["status"]) == (0, [], "to do")
    refused = bob.post("/api/photos/1/undo", json=asked())
    assert refused.status_code == 422
    done(bob, 1, anchor(30, 20))
    assert ann.get("/api/photos/1").json()["anchors"] == [[30, 5]]
    assert [one.get("/api/photos").json()["progress"]["done"] for one in people] == [1, 0]
    assert accepted(ann) == ["hill-0.csv"]
    assert accepted(bob) == []
    ann.post("/api/photos/1/undo", json=asked())
    assert bob.get("/api/photos/1").json()["anchors"] == [[30, 20]]


def test_a_token_opens_the_labels_of_its_person_alone(people):
    ann, bob = people
    shown = [one.get("/api/photos").headers[PASS_HEADER] for one in people]
    assert shown[0] != shown[1]
    said = bob.get("/api/photos", headers={PASS_HEADER: shown[0]})
    assert said.status_code == 412
    assert said.headers[PASS_HEADER] == shown[1]
    for meant, told in ((shown[1], shown[1]), ("another", "nobody")):
        said = ann.get("/api/photos", headers={TOKEN_HEADER: "old", PASS_HEADER: meant})
        assert (said.status_code, said.headers[PASS_HEADER]) == (401, told)


def test_nothing_is_lost_when_both_finish_photos_at_once(people):
    start = threading.Barrier(2)

    def work(client, row):
        start.wait()
        for photo in (1, 2, 3):
            client.get(f"/api/photos/{photo}")
            for column in range(4, 68, 8):
                assert done(client, photo, anchor(column, row)).status_code == 200
            said = done(client, photo, {"kind": "status", "status": "accepted"})
            assert said.status_code == 200

    threads = [
        threading.Thread(target=work, args=one) for one in zip(people, (10, 30), strict=True)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for client, row in zip(people, (10, 30), strict=True):
        for photo in (1, 2, 3):
            found = client.get(f"/api/photos/{photo}").json()
            assert found["status"] == "accepted"
            assert found["anchors"] == [[column, row] for column in range(4, 68, 8)]
        assert len(accepted(client)) == 3


def opened(folder, *words):
    """A server in a process of its own, and the addresses that it prints, by the person."""
    process = subprocess.Popen(
        [sys.executable, "-m", "annotate", "open", folder, "--no-browser", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    addresses = {}
    for line in process.stdout:
        if found := re.fullmatch(r"(\w+), \d to label: (http://\S+)\n", line):
            addresses[found[1]] = found[2]
        if line == "Ctrl-C ends.\n":
            return process, addresses
    raise AssertionError(process.stderr.read())


def test_the_command_prints_an_address_for_each_which_is_the_same_the_next_time(
    folder, tmp_path, monkeypatch
):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    found = []
    for words in (["--annotator", "ann", "--annotator", "bob"], []):
        process, addresses = opened(folder, *words)
        for name, address in addresses.items():
            assert httpx.get(address).status_code == 200
            place, token = address.split("?token=")
            said = httpx.get(f"{place}api/photos", headers={TOKEN_HEADER: token})
            assert said.json()["annotator"] == name
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        assert (out.startswith("Labels are in "), err) == (True, "")
        found.append(addresses)
    assert sorted(found[0]) == ["ann", "bob"]
    assert found[0] == found[1]
