"""Who may ask the labelling server for what: hosts, tokens, origins, passes, sizes."""

import asyncio

import pytest

from annotate.server.security import PASS_HEADER, Guard
from testing.labelling import TOKEN

ROUTES = [
    ("GET", "/"),
    ("GET", "/api/photos"),
    ("GET", "/api/photos/1"),
    ("GET", "/api/photos/1/margins"),
    ("GET", "/api/photos/1/image"),
    ("GET", "/api/photos/1/thumbnail"),
    ("GET", "/api/photos/1/tiles/0/0"),
    ("GET", "/api/photos/1/stages/edges"),
    ("GET", "/api/photos/1/strip"),
    ("GET", "/api/photos/1/alternatives"),
    ("GET", "/api/guideline"),
    ("GET", "/api/learn"),
    ("GET", "/api/exports/csv"),
    ("GET", "/api/openapi.json"),
    ("POST", "/api/photos/1/preview"),
    ("POST", "/api/photos/1/operations"),
    ("POST", "/api/photos/1/undo"),
    ("POST", "/api/photos/1/redo"),
    ("GET", "/api/photos/1/recording"),
    ("POST", "/api/learn"),
    ("GET", "/api/nothing"),
    ("GET", "/static/index.html"),
]


PICTURES = [f"/api/photos/1/{name}" for name in ("image", "thumbnail", "tiles/0/0", "strip")]
PICTURES.append("/api/photos/1/stages/edges")
PAGES = ("/", "/static/index.html")


@pytest.mark.parametrize(("method", "route"), ROUTES)
class TestRefusals:
    def test_another_host(self, client, method, route):
        for host in ("evil.example", "127.0.0.1", "127.0.0.1:1", ""):
            said = client.request(method, route, headers={"Host": host}, params={"token": TOKEN})
            assert said.status_code in (400, 421)
            assert "hill" not in said.text

    def test_no_token(self, client, method, route):
        code_of_the_page = route == "/" or route.startswith("/static")  # is no secret
        for token in ("", "wrong", TOKEN + "x"):
            said = client.request(
                method, route, headers={"X-Skyline-Token": token}, params={"token": token}
            )
            assert said.status_code == (200 if code_of_the_page else 401)
            assert code_of_the_page or "token" in said.json()["detail"]

    def test_another_origin(self, client, method, route):
        here = str(client.base_url).removeprefix("http://").rstrip("/")
        for origin in (
            "http://evil.example",
            "null",
            "https://127.0.0.1",
            "file://",
            f"https://{here}",
            f"ws://{here}",
            here,
        ):
            said = client.request(method, route, headers={"Origin": origin})
            assert said.status_code == 403

    def test_another_pass(self, client, method, route):
        shown = client.request(method, route).headers[PASS_HEADER]
        said = client.request(method, route, headers={PASS_HEADER: "another"})
        assert said.status_code == 412
        assert said.headers[PASS_HEADER] == shown
        assert client.request(method, route, headers={PASS_HEADER: shown}).status_code != 412

    def test_headers_of_every_answer(self, client, method, route):
        headers = client.request(method, route).headers
        assert headers["x-content-type-options"] == "nosniff"
        assert "default-src 'none'" in headers["content-security-policy"]
        assert "unsafe" not in headers["content-security-policy"]
        kept = "private, no-cache" if route in PICTURES else "no-store"
        assert headers["cache-control"] == kept
        assert ("etag" in headers) == (route in PICTURES or route in PAGES)


def test_web_sockets_are_closed_before_anything_sees_them():
    async def app(scope, receive, send):
        raise AssertionError("it was let through")

    said = []

    async def send(message):
        said.append(message)

    guard = Guard(app, TOKEN, frozenset())
    for kind in ("websocket", "something else"):
        asyncio.run(guard({"type": kind, "path": "/api/photos"}, None, send))
    assert [message["type"] for message in said] == ["websocket.close"] * 2


@pytest.mark.parametrize("route", [route for method, route in ROUTES if method == "POST"])
def test_changes_need_json_of_a_limited_size(client, route):
    form = {"Content-Type": "application/x-www-form-urlencoded"}
    assert client.post(route, content=b"revision=0", headers=form).status_code == 415
    assert client.post(route, content=b"{}").status_code == 415
    json = {"Content-Type": "application/json"}
    large = b"[" * 3_000_000
    assert client.post(route, content=large, headers=json).status_code == 413

    def slowly():
        for _ in range(30):
            yield b" " * 100_000

    assert client.post(route, content=slowly(), headers=json).status_code == 413
