"""Our own small server: whom it answers, and what it takes."""

import http.client
import json
import socket
from urllib.parse import urlsplit

import pytest

from skyline_viz.system.local_server import MOST_BYTES, Answer, refused, served, told

POLICY = "default-src 'none'"


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    file = tmp_path_factory.mktemp("files") / "large"
    file.write_bytes(bytes(300_000))

    def answer(request):
        if request.name == "file":
            return Answer(file, "application/octet-stream")
        if request.name == "gone":
            return Answer(file.with_name("gone"), "text/plain")
        if request.name == "no":
            return refused(409, "not now.", more=1)
        if request.name == "said":
            return told({"name": request.name, "body": (request.body or b"").decode()})
        return None

    with served(answer, POLICY) as address:
        yield urlsplit(address)


def ask(server, name, body=None, path=None, **headers):
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=10)
    try:
        where = f"{server.path}{name}" if path is None else path
        connection.putrequest("GET" if body is None else "PUT", where, skip_host=True)
        connection.putheader("Host", headers.pop("host", f"127.0.0.1:{server.port}"))
        if body is not None:
            kind = {"Content-Type": "application/json", "Content-Length": str(len(body))}
            headers = {key: value for key, value in (kind | headers).items() if value is not None}
        for key, value in headers.items():
            connection.putheader(key, value)
        connection.endheaders(body)
        answer = connection.getresponse()
        return answer.status, answer.read(), answer.headers
    finally:
        connection.close()


def test_reading_and_changing(server):
    status, body, headers = ask(server, "said?more")
    assert (status, json.loads(body)) == (200, {"name": "said", "body": ""})
    assert headers["Content-Security-Policy"] == POLICY
    assert headers["X-Frame-Options"] == "DENY"
    assert json.loads(ask(server, "said", b"{}")[1])["body"] == "{}"


def test_files_are_sent_as_they_are_or_named_as_gone(server):
    assert ask(server, "file")[:2] == (200, bytes(300_000))
    assert ask(server, "gone")[:2] == (410, b'{"detail": "the file is not there any more."}')


def test_what_is_wrong_is_a_sentence(server):
    assert ask(server, "no")[:2] == (409, b'{"detail": "not now.", "more": 1}')


@pytest.mark.parametrize("body", [None, b"{}"])
@pytest.mark.parametrize(
    ("status", "how"),
    [
        (404, {"path": "/said"}),
        (404, {"path": "/"}),
        (404, {"path": "*"}),
        (421, {"host": "evil.example"}),
        (403, {"Origin": "http://evil.example"}),
    ],
)
def test_others_are_answered_nothing(server, body, status, how):
    assert ask(server, "said", body, **how)[0] == status


@pytest.mark.parametrize(
    ("status", "headers"),
    [
        (415, {"Content-Type": None}),
        (415, {"Content-Type": "text/plain"}),
        (413, {"Content-Length": str(MOST_BYTES + 1)}),
        (413, {"Content-Length": "-1"}),
        (413, {"Content-Length": "9" * 5000}),
        (413, {"Content-Length": None}),
        (200, {"Content-Type": "Application/JSON; charset=utf-8"}),
    ],
)
def test_changes_are_json_of_a_limited_size(server, status, headers):
    assert ask(server, "said", b"{}", **headers)[0] == status


def test_it_is_gone_afterwards_and_its_address_is_never_the_same():
    with served(lambda request: None, POLICY) as one, served(lambda request: None, POLICY) as two:
        assert urlsplit(one).path != urlsplit(two).path
        assert len(urlsplit(one).path) > 30
    with socket.socket() as probe:
        assert probe.connect_ex(("127.0.0.1", urlsplit(one).port)) != 0
