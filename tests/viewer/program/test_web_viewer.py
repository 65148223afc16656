"""Rerun's viewer in a browser: what its page is made of, and whom its server answers."""

import http.client
import socket
from urllib.parse import urlsplit

import pytest

from skyline_viz.viewer.program import process as viewer
from skyline_viz.viewer.program.rerun_internals import ViewerError
from skyline_viz.viewer.program.web_viewer import POLICY, page_file, served, viewer_program

RECORDINGS = {"one.rrd": b"the first recording", "Z\udcfcrich <b>%.rrd": bytes(300_000)}


@pytest.fixture(scope="module")
def program():
    return viewer_program()


@pytest.fixture(scope="module")
def server(tmp_path_factory, program):
    folder = tmp_path_factory.mktemp("recordings")
    for name, content in RECORDINGS.items():
        (folder / name).write_bytes(content)
    with served([folder / name for name in RECORDINGS]) as address:
        yield urlsplit(address)


def ask(server, path, host=None, method="GET", **headers):
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=10)
    try:
        connection.putrequest(method, path, skip_host=True)
        for name in [host] if host is None or isinstance(host, str) else host:
            connection.putheader("Host", name or f"127.0.0.1:{server.port}")
        for name, value in headers.items():
            connection.putheader(name, value)
        connection.endheaders()
        answer = connection.getresponse()
        return answer.status, answer.read(), answer.headers
    finally:
        connection.close()


def test_the_program_is_the_viewer_for_browsers(program):
    assert program["re_viewer_bg.wasm"][:4] == b"\0asm"
    assert b"class WebHandle" in program["re_viewer.js"]


def test_the_page_is_code_of_ours_without_inline_script_or_style():
    page, kind = page_file("")
    assert kind.startswith("text/html")
    for line in page.splitlines():
        assert b"<script" not in line or b"src=" in line
    assert b"<style" not in page
    assert b"http:" not in page + page_file("start.js")[0]
    assert b"https:" not in page + page_file("start.js")[0]


def test_the_policy_lets_the_browser_contact_nobody_else():
    words = dict(part.split(" ", 1) for part in POLICY.split("; "))
    assert words["default-src"] == "'none'"
    assert words["connect-src"] == "'self'"
    assert "unsafe-inline" not in POLICY
    assert "'unsafe-eval'" not in POLICY


@pytest.mark.parametrize("name", ["../viewer.py", "index.html", "re_viewer.js/", "START.JS", "/"])
def test_nothing_else_is_a_file_of_the_page(name):
    assert page_file(name) is None


@pytest.mark.parametrize("name", ["", "style.css", "start.js", "re_viewer.js", "re_viewer_bg.wasm"])
def test_the_page_is_served_at_its_secret_address(server, name):
    status, body, headers = ask(server, server.path + name)
    assert (status, body, headers["Content-Type"]) == (200, *page_file(name))
    assert headers["Content-Security-Policy"] == POLICY
    assert headers["X-Frame-Options"] == "DENY"


def test_recordings_are_served_as_they_are(server):
    paths = [part.partition("=")[2] for part in server.fragment.split("&")]
    assert [ask(server, server.path + path)[:2] for path in paths] == [
        (200, content) for content in RECORDINGS.values()
    ]


def test_a_recording_that_is_gone_is_a_sentence(tmp_path, program):
    file = tmp_path / "gone.rrd"
    file.write_bytes(b"something")
    with served([file]) as address:
        file.unlink()
        where = urlsplit(address)
        status, body, _ = ask(where, f"{where.path}0.rrd")
    assert (status, body) == (410, b'{"detail": "the file is not there any more."}')


@pytest.mark.parametrize("path", ["", "re_viewer.js", "0.rrd"])
@pytest.mark.parametrize(
    ("status", "host", "headers"),
    [
        (421, "evil.example", {}),
        (421, "evil.example:{port}", {}),
        (421, "127.0.0.2", {}),
        (421, ["127.0.0.1:{port}", "evil.example"], {}),
        (421, [], {}),
        (403, None, {"Origin": "http://evil.example"}),
        (403, None, {"Origin": "null"}),
        (200, "localhost:{port}", {}),
        (200, "[::1]:{port}", {}),
        (403, None, {"Origin": "http://localhost:{port}"}),
        (200, "localhost:{port}", {"Origin": "http://localhost:{port}"}),
    ],
)
def test_it_is_called_by_a_name_of_this_machine_and_by_its_own_page(
    server, path, status, host, headers
):
    filled = {name: value.format(port=server.port) for name, value in headers.items()}
    if isinstance(host, list):
        host = [one.format(port=server.port) for one in host]
    elif host:
        host = host.format(port=server.port)
    found, body, _ = ask(server, server.path + path, host, **filled)
    assert found == status
    assert status == 200 or len(body) < 100


@pytest.mark.parametrize("path", ["/", "/0.rrd", "/no/0.rrd", "/re_viewer.js", "//", "*"])
def test_who_does_not_know_the_address_is_answered_nothing(server, path):
    assert ask(server, path)[:2] == (404, b'{"detail": "there is nothing at this address."}')


@pytest.mark.parametrize("end", ["0.rrd/..", "2.rrd", "../", "%2e%2e/", "0.rrd/../../one.rrd"])
def test_there_is_nothing_but_the_recordings_at_the_address(server, end):
    assert ask(server, server.path + end)[0] == 404


def test_nothing_is_ever_changed(server):
    assert ask(server, server.path, method="POST")[0] == 501


def test_addresses_differ_from_time_to_time(tmp_path, program):
    with served([]) as one, served([]) as other:
        assert len(urlsplit(one).path) > 30
        assert urlsplit(one).path != urlsplit(other).path


def test_nothing_listens_any_more_afterwards(program):
    with served([]) as address:
        port = urlsplit(address).port
    with socket.socket() as one:
        assert one.connect_ex(("127.0.0.1", port)) != 0


def test_a_viewer_that_does_not_start_is_a_sentence(monkeypatch, tmp_path):
    monkeypatch.setattr(viewer, "program", lambda: tmp_path / "nothing")
    viewer_program.cache_clear()
    try:
        with pytest.raises(ViewerError, match="cannot be started"):
            page_file("re_viewer.js")
    finally:
        viewer_program.cache_clear()


def test_viewers_that_we_start_have_a_way_out_that_leads_nowhere(monkeypatch, tmp_path):
    program, said = tmp_path / "viewer", tmp_path / "environment"
    program.write_text(f"#!/bin/sh\nenv > {said}\n")
    program.chmod(0o755)
    monkeypatch.setattr(viewer, "program", lambda: program)
    monkeypatch.setenv("HTTPS_PROXY", "http://proxy.example")
    assert viewer.open_viewer([]).wait(10) == 0
    told = dict(line.split("=", 1) for line in said.read_text().splitlines() if "=" in line)
    for name in ("HTTPS_PROXY", "https_proxy", "HTTP_PROXY", "all_proxy"):
        assert told[name] == "http://127.0.0.1:9"
    assert "127.0.0.1" in told["NO_PROXY"]
