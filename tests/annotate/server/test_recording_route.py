"""Stages from the labelling server: behind every check, the line as it is, nothing left."""

import http.client
import threading

import numpy as np
import pytest

from annotate.server.security import TOKEN_HEADER
from annotate.store.operations import SetAnchor
from skyline_viz.viewer import entities
from skyline_viz.viewer.program import in_memory
from skyline_viz.viewer.program.web_viewer import POLICY
from testing.labelling import TOKEN, served, workbench, write_hills
from testing.recordings import Read

RECORDING = "/api/photos/1/recording"
PAGE = "/static/stages/"


@pytest.fixture(scope="module")
def client(tmp_path_factory):
    with served(write_hills(tmp_path_factory.mktemp("photos"), count=2)) as client:
        yield client


def ask(client, path, host, headers):
    port = client.base_url.port
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
    try:
        connection.putrequest("GET", path, skip_host=True)
        connection.putheader("Host", host.format(port=port))
        for name, value in headers.items():
            connection.putheader(name, value.format(port=port))
        connection.endheaders()
        answer = connection.getresponse()
        return answer.status, answer.read()
    finally:
        connection.close()


OURS = "127.0.0.1:{port}"
KNOWS = {TOKEN_HEADER: TOKEN}
REFUSED = [
    (401, OURS, {}),
    (401, OURS, {TOKEN_HEADER: ""}),
    (401, OURS, {TOKEN_HEADER: TOKEN[:-1]}),
    (401, OURS, {TOKEN_HEADER: TOKEN + "x"}),
    (401, "localhost:{port}", {"Cookie": f"token={TOKEN}"}),
    (421, "evil.example", KNOWS),
    (421, "evil.example:{port}", KNOWS),
    (421, "127.0.0.2", KNOWS),
    (421, "localhost.:{port}", KNOWS),
    (403, OURS, KNOWS | {"Origin": "http://evil.example"}),
    (403, OURS, KNOWS | {"Origin": "http://evil.example:{port}"}),
    (403, OURS, KNOWS | {"Origin": "null"}),
]


@pytest.mark.parametrize(("status", "host", "headers"), REFUSED)
@pytest.mark.parametrize("path", [RECORDING, f"{RECORDING}?token={TOKEN}"])
def test_a_recording_is_behind_every_check(client, path, status, host, headers):
    found, body = ask(client, path, host, headers)
    assert found == status
    assert len(body) < 200


@pytest.mark.parametrize("host", [OURS, "localhost:{port}", "[::1]:{port}"])
def test_the_page_works_under_every_name_of_this_machine(client, host):
    origin = {"Origin": f"http://{host}"}
    assert ask(client, PAGE, host, origin)[0] == 200
    status, body = ask(client, RECORDING, host, KNOWS | origin)
    assert status == 200
    assert body[:4] == b"RRF2"


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.2:1"])
@pytest.mark.parametrize("name", ["", "start.js", "re_viewer_bg.wasm"])
def test_even_the_code_of_the_page_is_not_for_other_names(client, host, name):
    assert ask(client, PAGE + name, host, KNOWS)[0] == 421


def test_the_page_has_a_policy_of_its_own_and_other_pages_keep_theirs(client):
    assert client.get(PAGE).headers["Content-Security-Policy"] == POLICY
    for path in ("/static/index.html", RECORDING, "/api/photos"):
        assert "wasm" not in client.get(path).headers["Content-Security-Policy"]


def test_there_is_no_other_file(client):
    assert client.get(f"{PAGE}nothing").status_code == 404
    assert client.get(f"{PAGE}../main.js").status_code == 200  # which is one of the page's


def test_the_truth_is_the_line_as_it_is_labelled_now(tmp_path):
    folder = write_hills(tmp_path / "photos", count=1)
    bench = workbench(folder)
    bench.session(1).apply(SetAnchor(column=30, row=7), -1)
    bench.close()
    file = tmp_path / "now.rrd"
    with served(folder) as client:
        rows = client.get("/api/photos/1").json()["rows"]
        file.write_bytes(client.get(RECORDING).content)
    assert rows[30] == 7
    strip = np.array(Read(file).last(entities.TRUTH, "strips").as_py()[0])
    assert [30.5, 7.0] in strip.tolist()
    assert set(strip[:, 1]) <= {float(row) for row in rows}


def test_a_blind_photo_shows_nothing_of_the_detector(tmp_path):
    with served(write_hills(tmp_path / "photos", count=1), blind=1.0) as client:
        answer = client.get(RECORDING)
    assert answer.status_code == 403
    assert "blind" in answer.json()["detail"]


def test_nothing_is_left_on_the_disk_and_nothing_is_started(tmp_path, monkeypatch):
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(folder))
    with served(write_hills(tmp_path / "photos", count=1)) as client:
        assert client.get(RECORDING).status_code == 200
        assert list(folder.iterdir()) == []


def test_large_photos_are_kept_lean(client, monkeypatch):
    full = len(client.get(RECORDING).content)
    monkeypatch.setattr(in_memory, "fidelity_of", lambda pixels: "lean")
    lean = client.get(RECORDING)
    assert lean.status_code == 200
    assert len(lean.content) < full


def test_several_recordings_at_once_are_all_whole(client):
    found = []

    def work():
        found.append(client.get("/api/photos/2/recording"))

    threads = [threading.Thread(target=work) for _ in range(6)]
    for one in threads:
        one.start()
    for one in threads:
        one.join()
    assert {answer.status_code for answer in found} == {200}
    assert all(answer.content[:4] == b"RRF2" for answer in found)
