"""Pictures of a photo: whole, reduced, in tiles, as a strip."""

import cv2
import numpy as np
import pytest

from annotate.server.security import TOKEN_HEADER
from skyline_viz.photo import read_photo
from testing.labelling import hills, served, write_hills


def picture(response):
    assert response.status_code == 200
    return cv2.imdecode(np.frombuffer(response.content, np.uint8), cv2.IMREAD_UNCHANGED)


def test_pictures_show_the_photo(client, folder):
    photo = read_photo(folder / "hill-1.png")
    whole = picture(client.get("/api/photos/2/image"))
    np.testing.assert_array_equal(whole[..., ::-1], photo)
    part = picture(client.get("/api/photos/2/tiles/0/0"))
    np.testing.assert_array_equal(part[..., ::-1], photo)
    assert client.get("/api/photos/2/tiles/1/0").status_code == 404
    strip = picture(client.get("/api/photos/2/strip?width=70"))
    rows = client.get("/api/photos/2").json()["rows"]
    assert strip.shape[:2] == (81, 70)
    for column in (0, 33, 69):
        np.testing.assert_array_equal(strip[40, column, 2::-1], photo[rows[column], column])
    assert picture(client.get("/api/photos/2/overview")).shape == (48, 70, 3)
    for stage in ("edges", "strength", "coherence", "orientation", "bin", "score", "cost"):
        layer = picture(client.get(f"/api/photos/2/stages/{stage}"))
        assert layer.shape == (48, 70, 4)
        assert layer[..., 3].any()


def test_large_photos_are_seen_reduced_and_in_exact_tiles(tmp_path):
    folder = write_hills(tmp_path, count=1, height=1400, width=2400)
    with served(folder) as client:
        assert picture(client.get("/api/photos/1/image")).shape == (1195, 2048, 3)
        part = picture(client.get("/api/photos/1/tiles/4/2"))
        expected = hills(0, 1400, 2400)[1024:, 2048:]
        np.testing.assert_array_equal(part[..., ::-1], expected)


@pytest.mark.parametrize(
    "name", ["image", "thumbnail", "tiles/0/0", "stages/cost", "strip?width=64"]
)
def test_a_browser_that_has_a_picture_is_told_so(client, name):
    first = client.get(f"/api/photos/2/{name}")
    tag = first.headers["etag"]
    assert first.headers["cache-control"] == "private, no-cache"  # not in caches that are shared
    for asked in (tag, f"W/{tag}", f'"other", {tag}', "*"):
        again = client.get(f"/api/photos/2/{name}", headers={"If-None-Match": asked})
        assert (again.status_code, again.content) == (304, b"")
        assert again.headers["etag"] == tag
        assert again.headers["x-skyline-pass"] == first.headers["x-skyline-pass"]
        assert again.headers["cache-control"] == "private, no-cache"
    other = client.get(f"/api/photos/2/{name}", headers={"If-None-Match": '"other"'})
    assert (other.status_code, other.content) == (200, first.content)
    assert client.get(f"/api/photos/3/{name}").headers["etag"] != tag


def test_a_tag_opens_nothing_to_a_stranger(client):
    tag = client.get("/api/photos/2/image").headers["etag"]
    wrong = {"If-None-Match": tag, TOKEN_HEADER: "wrong"}
    said = client.get("/api/photos/2/image", headers=wrong)
    assert said.status_code == 401
    assert said.headers["cache-control"] == "no-store"
    assert client.get("/api/photos/2/image/x", headers={"If-None-Match": "*"}).status_code == 404
