"""The stages in a real browser: they are seen, and the browser contacts nobody but the server."""

import io
from urllib.parse import urlsplit

import numpy as np
import pytest
from PIL import Image

from annotate.store.operations import SetAnchor
from skyline_viz.cli import main
from skyline_viz.colours import PATH, TRUTH
from skyline_viz.viewer.program.web_viewer import served as served_recordings
from testing.labelling import TOKEN, served, workbench, write_hills
from testing.programs.browser import chromium

PATIENCE = 120_000  # milliseconds: the viewer draws without a graphics card


@pytest.fixture(scope="module")
def browser():
    with chromium(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]) as browser:
        yield browser


@pytest.fixture
def context(browser):
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.asked = []
    context.on("request", lambda request: context.asked.append(request.url))
    yield context
    context.close()


def is_near(picture, colour):
    return (np.abs(picture.astype(int) - colour) < 40).all(axis=2)


def looked_at(page):
    """Wait until the viewer shows a path, and return its picture."""
    page.locator("#said").wait_for(state="hidden", timeout=PATIENCE)
    for _ in range(PATIENCE // 500):
        picture = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))
        if is_near(picture, PATH).sum() > 100:
            return picture
        page.wait_for_timeout(500)
    raise AssertionError(f"no path is to be seen; the page says {page.inner_text('body')!r}")


def hosts_of(asked):
    own = ("data:", "blob:", "about:")  # what never leaves the browser
    return {urlsplit(address).netloc for address in asked if not address.startswith(own)}


@pytest.mark.parametrize("name", ["127.0.0.1", "localhost"])
def test_g_opens_the_stages_beside_the_page(context, tmp_path, name):
    folder = write_hills(tmp_path / "photos", count=1, height=200, width=320)
    bench = workbench(folder)
    bench.session(1).apply(SetAnchor(column=160, row=20), -1)
    bench.close()
    with served(folder) as client:
        here = f"{name}:{client.base_url.port}"
        page = context.new_page()
        page.goto(f"http://{here}/?token={TOKEN}")
        page.locator("#first-dialog button.primary").click()
        page.locator("#name", has_text="hill-0.png").wait_for()
        with context.expect_page() as opened:
            page.keyboard.press("g")
        viewer = opened.value
        picture = looked_at(viewer)
        assert is_near(picture, TRUTH).sum() > 100  # the line with the anchor
        assert TOKEN not in viewer.url
        viewer.reload()  # which keeps what is shown
        looked_at(viewer)
        assert hosts_of(context.asked) == {here}


def test_serve_shows_a_recording(context, tmp_path):
    photos = write_hills(tmp_path / "photos", count=1, height=200, width=320)
    file = tmp_path / "hill.rrd"
    assert main(["inspect", str(photos / "hill-0.png"), "--save", str(file)]) == 0
    with served_recordings([file]) as address:
        page = context.new_page()
        page.goto(address)
        looked_at(page)
        assert hosts_of(context.asked) == {urlsplit(address).netloc}


@pytest.mark.parametrize(
    ("fragment", "sentence"),
    [
        ("", "This address names no recording"),
        ("recording=https://evil.example/a.rrd", "A recording of another server is not shown"),
        ("recording=../../api/photos/1/recording", "the token is missing or wrong"),
        (f"recording=../../api/photos/9/recording&token={TOKEN}", "there is no photo number 9"),
    ],
)
def test_what_is_wrong_is_a_sentence_on_the_page(context, tmp_path, fragment, sentence):
    with served(write_hills(tmp_path / "photos", count=1)) as client:
        page = context.new_page()
        page.goto(f"{client.base_url}/static/stages/#{fragment}")
        page.locator("#said", has_text=sentence).wait_for(timeout=PATIENCE)
        assert hosts_of(context.asked) == {f"127.0.0.1:{client.base_url.port}"}
