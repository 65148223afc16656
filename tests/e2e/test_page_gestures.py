"""Strokes along a ridge, other ridges, explanations, spans, and several photos at once."""

import numpy as np
import pytest

from annotate.engine.live_wire import LiveWire
from skyline_viz.photo import write_photo
from testing.labelling import DETECTOR, served, write_hills
from testing.programs.browser import Page

HEIGHT, WIDTH = 240, 400
PHONE = {"width": 390, "height": 844}


def ridges():
    """Two ridges, of which the upper one is faint; and the rows of both."""
    columns = np.arange(WIDTH)
    upper = np.floor(70 + 12 * np.sin(columns / 45)).astype(int)
    lower = np.floor(150 + 10 * np.sin(columns / 30)).astype(int)
    photo = np.full((HEIGHT, WIDTH, 3), 205.0)
    rows = np.arange(HEIGHT)[:, None]
    photo[rows >= upper] = 165
    photo[rows >= lower] = 50
    photo += np.random.default_rng(3).normal(0, 2, photo.shape)
    return photo.clip(0, 255).astype(np.uint8), upper, lower


@pytest.fixture(scope="module", autouse=True)
def _compiled():
    """What follows a guide is compiled once, which takes longer than a browser waits."""
    LiveWire(ridges()[0], DETECTOR).preview_guide([(10, 100), (200, 100)])


@pytest.fixture
def folder(tmp_path):
    folder = write_hills(tmp_path / "alps", height=HEIGHT, width=WIDTH)
    write_photo(folder / "a-ridges.png", ridges()[0])
    return folder


@pytest.fixture
def client(folder):
    with served(folder) as client:
        yield client


@pytest.fixture
def page(browser, client):
    page = Page(browser, client)
    yield page
    page.close()


def rows_of(page):
    return np.array(page.document()["rows"])


def other_ridge(page):
    """The ridge that the proposal does not follow, and a rough stroke along it."""
    _, upper, lower = ridges()
    now = rows_of(page)
    ridge = max((upper, lower), key=lambda one: np.abs(one - now).mean())
    return ridge, [(column, int(ridge[column]) + 3) for column in (*range(2, WIDTH, 30), WIDTH - 2)]


def test_a_stroke_along_a_ridge_is_shown_while_it_is_drawn_and_kept_where_it_ends(page):
    ridge, stroke = other_ridge(page)
    places = [page.at(*pixel) for pixel in stroke]
    with page.page.expect_response("**/guide"):
        page.page.mouse.move(*places[0])
        page.page.mouse.down()
        for place in places[1:]:
            page.page.mouse.move(*place, steps=3)
    assert page.document()["guides"] == []  # nothing is kept yet
    page.page.mouse.up()
    page.saved()
    page.says("The line follows the guide.")
    assert len(page.document()["guides"]) == 1
    assert np.abs(rows_of(page) - ridge)[10:-10].mean() < 2
    page.keys("u")
    assert page.document()["guides"] == []


def test_escape_drops_a_stroke_on_the_way(page):
    page.page.mouse.move(*page.at(50, 100))
    page.page.mouse.down()
    page.page.mouse.move(*page.at(150, 110), steps=5)
    page.page.keyboard.press("Escape")
    page.page.mouse.move(*page.at(250, 110), steps=5)
    page.page.mouse.up()
    page.saved()
    assert page.document()["revision"] == 0


def test_a_guide_is_made_corner_by_corner_with_clicks_or_keys(page):
    ridge, _ = other_ridge(page)
    page.keys("i")
    corners = [(column, int(ridge[column])) for column in range(4, WIDTH, 49)]
    for corner in [*corners, corners[-1]]:  # the last one once more ends it
        page.page.mouse.click(*page.at(*corner))
    page.saved()
    assert len(page.document()["guides"]) == 1
    assert np.abs(rows_of(page) - ridge)[14:-14].mean() < 3
    page.keys("u")
    page.page.locator("#lines").focus()
    page.keys("ArrowLeft", "j", "Control+ArrowRight", "j", "Enter")
    ((first, last),) = page.document()["guides"]
    assert last - first >= 100


def test_a_finger_draws_a_guide(browser, client):
    page = Page(browser, client, has_touch=True, viewport={"width": 1024, "height": 768})
    ridge, stroke = other_ridge(page)
    session = page.context.new_cdp_session(page.page)
    for at, pixel in enumerate(stroke):
        x, y = page.at(*pixel)
        kind = "touchMove" if at else "touchStart"
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y}]})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    page.says("The line follows the guide.")
    page.saved()
    assert np.abs(rows_of(page) - ridge)[14:-14].mean() < 3
    page.close()


def test_lines_along_other_ridges_are_shown_before_one_is_taken(page):
    offered = page.client.get("/api/photos/1/alternatives").json()["alternatives"]
    before = page.document()
    page.keys("2")
    page.says("along other ridges")
    buttons = page.page.locator("#choices button")
    assert buttons.count() == len(offered) + 1
    assert page.document() == before
    page.keys("Escape")
    assert not page.page.locator("#choices").is_visible()
    page.page.locator("#others").click()
    buttons.first.hover()
    buttons.first.click()
    page.saved()
    assert page.document()["guides"] == [[0, WIDTH - 1]]
    assert np.abs(rows_of(page) - offered[0]["rows"]).max() <= 5
    assert page.page.locator("#lines:focus").count() == 1
    page.keys("u")
    assert page.document()["rows"] == before["rows"]


def test_a_click_explains_a_pixel(page):
    _, upper, _ = ridges()
    row = int(upper[200])
    page.keys("e")
    page.page.mouse.click(*page.at(200, row))
    panel = page.page.locator("#explained")
    panel.wait_for()
    told = page.client.get(f"/api/photos/1/pixels/200/{row}").json()
    words = panel.inner_text()
    assert f"Column 200, row {row}" in words
    for name, paid in told["terms"].items():
        assert name in words
        assert f"{paid:.3f}" in words
    assert f"{told['cost']:.3f}" in words
    assert panel.locator("canvas").count() == 4
    assert page.document()["revision"] == 0
    page.keys("Escape")
    assert not panel.is_visible()


def test_uncertain_spans_are_counted_and_looked_at_closely(page):
    page.page.locator("#lines").focus()
    page.keys("n")
    page.says("uncertain")
    margins = page.client.get("/api/photos/1/margins").json()["margins"]
    counted = min(one for one in margins if one is not None) < 0.5
    said = page.page.locator("#said").inner_text()
    assert said.startswith("Uncertain span") == counted


def test_strips_lie_under_the_photos_own_columns(page):
    page.click(100, 80)
    page.page.wait_for_timeout(600)
    column = page.page.evaluate(
        """() => {
          const strip = document.getElementById("strip");
          const {width, height} = strip;
          const pixels = strip.getContext("2d").getImageData(0, 3, width, 1).data;
          const there = [];
          for (let x = 0; x < width; x++) if (pixels[4 * x + 3]) there.push(x);
          return [there[0] / width, there.at(-1) / width];
        }"""
    )
    box = page.page.locator("#lines").bounding_box()
    sides = [(page.at(at, 0)[0] - box["x"]) / box["width"] for at in (0, WIDTH - 1)]
    np.testing.assert_allclose(column, sides, atol=0.01)
    page.page.locator("#strip").click(position={"x": sides[0] * box["width"] + 30, "y": 20})
    page.page.locator("#lines:focus").wait_for()


def test_several_photos_are_chosen_tagged_accepted_and_taken_back(page):
    items = page.page.locator(".item")
    items.nth(1).click(modifiers=["Control"])
    items.nth(3).click(modifiers=["Shift"])
    count = page.page.locator("#chosen-count")
    assert count.inner_text() == "3 photos chosen"
    page.page.locator("#search").fill("hill-1")  # what is decided about is still told
    assert count.inner_text() == "3 photos chosen, 2 not listed"
    page.page.locator("#search").fill("")
    assert count.inner_text() == "3 photos chosen"
    page.page.locator("#chosen-tags").click()
    page.page.keyboard.press("1")
    page.page.keyboard.press("Escape")
    page.saved()
    page.page.locator("#chosen-accept").click()
    page.says("3 photos are accepted.")
    assert page.page.locator("#lines:focus").count() == 1  # the button that had the keys is gone
    listed = page.client.get("/api/photos").json()["photos"]
    assert [one["status"] for one in listed] == ["to do", *["accepted"] * 3]
    assert [len(one["tags"]) for one in listed] == [0, 1, 1, 1]
    page.page.locator("#filter").select_option(f"tag:{listed[1]['tags'][0]}")
    assert items.count() == 3
    page.page.locator("#said-undo").click()
    page.saved()
    listed = page.client.get("/api/photos").json()["photos"]
    assert [one["status"] for one in listed] == ["to do"] * 4


def test_why_a_photo_is_rejected_is_a_tag(page):
    page.keys("q")
    page.says("is rejected")
    page.page.locator("#said-choices button", has_text="no visible skyline").click()
    page.saved()
    assert page.document(1)["tags"] == ["no visible skyline"]
    assert page.page.locator("#lines:focus").count() == 1


def test_the_tour_leads_around_and_can_be_skipped(browser, client):
    page = Page(browser, client)
    page.page.evaluate("localStorage.clear()")
    page.open()
    page.page.locator("#tour-begin").click()
    tour = page.page.locator("#tour")
    tour.wait_for()
    assert "1 of 6" in tour.inner_text()
    page.page.keyboard.press("Enter")
    assert "2 of 6" in tour.inner_text()
    page.page.mouse.click(*page.at(WIDTH // 2, 200))
    page.saved()
    assert page.page.locator("#lines:focus").count() == 1
    before = page.document()
    page.page.keyboard.press(" ")  # the keys of the page rest, wherever they would go
    page.page.keyboard.press("Escape")
    assert not tour.is_visible()
    assert page.page.locator("#lines:focus").count() == 1
    page.saved()
    assert page.document() == before
    page.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_on_a_phone_everything_is_within_reach(browser, client, scheme):
    page = Page(browser, client, has_touch=True, viewport=PHONE, color_scheme=scheme)
    for one in page.page.locator("header button:visible, .tools button:visible").all():
        box = one.bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= PHONE["width"]
        assert box["y"] + box["height"] <= PHONE["height"]
    stage = page.page.locator("#stage").bounding_box()
    assert stage["height"] > 250
    page.page.locator("#list-toggle").tap()
    page.page.locator(".item").nth(1).tap()
    page.shows("hill-0.png")
    assert not page.page.locator("#side").is_visible()
    page.page.locator("#accept").tap()
    page.says("is accepted")
    page.close()
