"""Who may ask the labelling server for what: hosts, tokens, origins, passes, sizes."""

import asyncio

import httpx
import pytest
from starlette.responses import JSONResponse

from annotate.server.security import PASS_HEADER, TOKEN_HEADER, Guard
from skyline_viz.system.loopback import allowed_hosts
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
        for host in ("evil.example", "127.0.0.1.evil.example", "127.0.0.2:1", "0.0.0.0", ""):
            said = client.request(method, route, headers={"Host": host}, params={"token": TOKEN})
            assert said.status_code in (400, 421)
            assert "hill" not in said.text

    def test_no_token(self, client, method, route):
        code_of_the_page = route == "/" or route.startswith("/static")  # is no secret
        for token in ("", "wrong", TOKEN + "x"):
            said = client.request(
                method, route, headers={"X-Skyline-Token": token}, params={"token": token}
            )
            told = route == "/" and token  # by an address that is out of date
            assert said.status_code == (200 if code_of_the_page and not told else 401)
            assert said.status_code == 200 or "token" in said.json()["detail"]

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

    guard = Guard(app, {}, frozenset())
    for kind in ("websocket", "something else"):
        asyncio.run(guard({"type": kind, "path": "/api/photos"}, None, send))
    assert [message["type"] for message in said] == ["websocket.close"] * 2


@pytest.mark.parametrize(
    ("path", "headers", "status", "sentence"),
    [
        (
            "/",
            {"Host": "lab.example"},
            421,
            "not called lab.example; --allow-host lab.example lets",
        ),
        ("/", {"Host": "[fe80::1]:80"}, 421, "not called [fe80::1]; --allow-host [fe80::1] lets"),
        ("/", {"Host": "<b>"}, 421, "This server is not called by that name."),
        (
            "/?token=old",
            {TOKEN_HEADER: ""},
            401,
            "The token is missing or wrong; open the address that was printed.",
        ),
        ("/api/exports/csv", {TOKEN_HEADER: ""}, 401, "The token is missing or wrong"),
    ],
)
def test_who_follows_a_wrong_link_reads_a_sentence(client, path, headers, status, sentence):
    accept = {"Accept": "text/html,application/xhtml+xml,*/*;q=0.8"}
    said = client.get(path, headers=headers | accept)
    assert said.status_code == status
    assert said.headers["content-type"] == "text/html; charset=utf-8"
    assert sentence in said.text
    assert "<b>" not in said.text
    assert said.text.count("<p>") == 1


def test_the_address_at_which_a_request_arrives_is_answered():
    async def app(scope, receive, send):
        await JSONResponse("let through")(scope, receive, send)

    async def ask(host, server):
        guard = Guard(app, {}, allowed_hosts())
        transport = httpx.ASGITransport(
            lambda scope, *rest: guard({**scope, "server": server}, *rest)
        )
        async with httpx.AsyncClient(transport=transport) as client:
            return await client.get("http://here/", headers={"Host": host})

    for server, status in ((("192.0.2.7", 8000), 200), (("192.0.2.8", 8000), 421)):
        assert asyncio.run(ask("192.0.2.7:8000", server)).status_code == status


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
