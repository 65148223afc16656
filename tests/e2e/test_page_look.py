"""What is seen of the labelling page: brush, veils, themes, legends, help, the sheet's photos."""

import pytest

from testing.labelling import served, write_hills
from testing.programs.browser import Page


@pytest.fixture
def client(tmp_path):
    with served(write_hills(tmp_path / "alps", height=240, width=400)) as client:
        yield client


@pytest.fixture
def page(browser, client):
    page = Page(browser, client)
    yield page
    page.close()


def pixel(page, canvas, x, y):
    """A pixel of a canvas, as red, green, blue and opacity."""
    reads = "(one, [x, y]) => [...one.getContext('2d').getImageData(x, y, 1, 1).data]"
    return page.page.locator(canvas).evaluate(reads, [x, y])


def on_canvas(page, column, row):
    box = page.page.locator("#lines").bounding_box()
    x, y = page.at(column, row)
    return x - box["x"], y - box["y"]


def settled(page):
    page.page.evaluate("() => new Promise((done) => requestAnimationFrame(() => setTimeout(done)))")


def test_the_brush_is_as_wide_as_its_ring(page):
    page.keys("b", ".", ".", ".")
    page.says("screen pixels wide")
    radius = int(page.page.locator("#brush").input_value())
    assert radius > 12
    x, y = page.at(200, 40)
    page.page.mouse.move(x, y)
    settled(page)
    at = on_canvas(page, 200, 40)
    assert pixel(page, "#lines", at[0] + radius, at[1])[3] > 0
    assert pixel(page, "#lines", at[0], at[1])[3] == 0
    page.page.mouse.click(x, y)
    page.saved()
    page.says("The line stays out of there.")
    scale = (page.at(300, 0)[0] - page.at(200, 0)[0]) / 100
    assert page.document()["forbidden"][0]["radius"] == round(radius / scale)
    page.keys("a")
    assert not page.page.locator("#brush-size").is_visible()


def test_hidden_columns_lie_under_a_veil(page):
    far = on_canvas(page, 365, 230)
    assert pixel(page, "#lines", *far)[3] == 0
    page.keys("h")
    page.drag((350, 120), (380, 120))
    settled(page)
    assert pixel(page, "#lines", *far)[3] > 0
    assert pixel(page, "#lines", *on_canvas(page, 330, 230))[3] == 0


def test_what_a_tool_did_is_said(page):
    page.keys("d")
    page.drag((90, 100), (110, 100))
    page.says("The line lies as drawn from column 90 to 110.")
    page.keys("s")
    page.drag((20, 160), (60, 140))
    page.says("The line is straight from column 20 to 60.")
    page.keys("a")
    page.page.keyboard.down("Shift")
    page.click(200, 80)
    page.page.keyboard.up("Shift")
    page.page.mouse.click(*page.at(200, 80))
    page.says("The anchor at column 200 has the cursor")
    assert page.document()["anchors"] == [[200, 80]]


def test_a_theme_changes_as_a_whole(page):
    corner = (3, 3)  # beside the photo
    light = pixel(page, "#photo", *corner)
    page.page.emulate_media(color_scheme="dark")
    page.page.wait_for_function(
        """(before) => {
          const pen = document.getElementById('photo').getContext('2d');
          return String([...pen.getImageData(3, 3, 1, 1).data]) !== String(before);
        }""",
        arg=light,
    )
    assert sum(pixel(page, "#photo", *corner)[:3]) < sum(light[:3])


def test_an_overlay_says_how_it_reads_and_only_then_has_an_opacity(page):
    assert not page.page.locator("#opacity").is_visible()
    page.page.locator("#overlay").select_option("score")
    page.page.locator("#legend", has_text="Score: red like skyline").wait_for()
    assert page.page.locator("#opacity").is_visible()
    page.page.locator("#overlay").select_option("none")
    page.page.locator("#legend").wait_for(state="hidden")


def test_the_sheet_shows_each_photo_with_its_line(page):
    page.keys("w")
    page.page.locator(".card .whole[src]").nth(2).wait_for()
    assert page.page.locator(".card img[src]").count() == 6


def test_help_has_gestures(page):
    page.keys("?")
    words = page.page.locator("#help-dialog").inner_text()
    for part in (
        "Guideline",
        "Mouse and fingers",
        "Drag along a ridge",
        "Right or middle",
    ):
        assert part in words
    assert page.page.locator("#help-dialog").evaluate("one => one.scrollTop") == 0


def test_a_digit_ticks_a_tag(page):
    page.keys("t", "1", "3", "1", "Escape")
    assert page.document()["tags"] == ["needs terrain data"]


def test_what_is_under_the_mouse_is_magnified_while_z_is_held(page):
    page.page.mouse.move(*page.at(200, 120))
    settled(page)
    beside = on_canvas(page, 200, 120)
    beside = beside[0] - 94, beside[1] - 84
    assert pixel(page, "#lines", *beside)[3] == 0
    page.page.keyboard.down("z")
    settled(page)
    assert pixel(page, "#lines", *beside)[3] > 0
    page.page.keyboard.up("z")
    settled(page)
    assert pixel(page, "#lines", *beside)[3] == 0


def test_at_1024_names_are_whole_and_nothing_is_cut_off(browser, tmp_path):
    folder = write_hills(tmp_path / "alps", count=1, height=240, width=400)
    (folder / "hill-0.png").rename(folder / "IMG_2195.png")
    with served(folder) as client:
        page = Page(browser, client, viewport={"width": 1024, "height": 768})
        for place in ("#name", ".item .title"):
            wide = page.page.locator(place).evaluate("one => one.scrollWidth - one.clientWidth")
            assert wide == 0
        header = page.page.locator("header").evaluate("one => one.scrollWidth - one.clientWidth")
        assert header == 0
        assert page.page.locator("#help").bounding_box()["x"] < 1024 - 20
        page.close()


def test_a_card_that_waits_for_its_pictures_says_so(page):
    page.page.route("**/strip?*", lambda route: None)
    page.keys("w")
    card = page.page.locator(".card .both").first
    card.wait_for()
    said = "one => getComputedStyle(one, '::after').content"
    assert "is being read" in card.evaluate(said)
    page.page.unroute("**/strip?*")


def test_both_strips_say_what_they_are(page):
    for strip, words in (("#strip", "an error is a bump"), ("#margin", "The taller a bar")):
        box = page.page.locator(strip).bounding_box()
        x, y = box["x"] + 30, box["y"] + 12  # over the caption, too
        told = "([x, y]) => document.elementFromPoint(x, y).title"
        assert words in page.page.evaluate(told, [x, y])
