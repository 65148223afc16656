"""Hidden columns and what hides them, the guideline, filters, and fingers that choose."""

import io
import zipfile

import pytest

from testing import until
from testing.labelling import done, served, write_hills
from testing.labels import label
from testing.programs.browser import Page

HEIGHT, WIDTH = 240, 400
PHONE = {"width": 390, "height": 844}


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps", count=4, height=HEIGHT, width=WIDTH)


@pytest.fixture
def client(folder):
    with served(folder) as client:
        yield client


@pytest.fixture
def page(browser, client):
    page = Page(browser, client)
    yield page
    page.close()


def seen(page, selector):
    """What is drawn on a canvas, as text."""
    return page.page.locator(selector).evaluate("one => one.toDataURL()")


def test_reasons_belong_to_the_hidden_columns_and_one_undo_takes_one_back(page):
    page.keys("h")
    page.drag((300, 120), (380, 120))
    page.says("Columns 300 to 380 are not visible.")
    page.page.locator("#said-choices button", has_text="fog").click()
    page.saved()
    page.says("Columns 300 to 380 are not visible: fog.")
    assert page.document()["hidden"] == [[300, 380, "fog"]]
    assert page.document()["tags"] == []
    assert page.page.locator("#lines:focus").count() == 1
    page.keys("u")
    assert page.document()["hidden"] == [[300, 380, ""]]
    page.keys("u")
    assert page.document()["hidden"] == []


def test_hidden_columns_are_listed_explained_and_shown_again(page):
    opens = page.page.locator("#hidden-open")
    assert opens.is_disabled()
    place = opens.bounding_box()
    page.keys("h")
    page.drag((300, 120), (380, 120))
    page.drag((20, 120), (60, 120))
    assert opens.inner_text() == "Hidden 2"
    assert opens.bounding_box() == place  # nothing may move while somebody works
    page.keys("Shift+K")
    rows = page.page.locator("#hidden-list li")
    assert rows.count() == 2
    rows.nth(1).locator("select").focus()
    rows.nth(1).locator("select").select_option("cloud")
    page.saved()
    assert page.document()["hidden"] == [[20, 60, ""], [300, 380, "cloud"]]
    assert rows.nth(1).locator("select").evaluate("one => one === document.activeElement")
    rows.nth(0).locator("button", has_text="Show again").click()
    page.saved()
    assert page.document()["hidden"] == [[300, 380, "cloud"]]
    rows.nth(0).locator("button", has_text="Columns 300").click()
    assert not page.page.locator("#hidden-dialog").is_visible()
    page.keys("ArrowRight")
    page.says("Column 341")


def test_bands_say_what_hides_their_columns(page):
    done(page.client, 1, {"kind": "hidden", "first": 100, "last": 300})
    page.open()
    page.page.wait_for_timeout(400)
    before = seen(page, "#lines"), seen(page, "#strip")
    done(page.client, 1, {"kind": "hidden", "first": 100, "last": 300, "why": "fog"})
    page.open()
    page.page.wait_for_timeout(400)
    after = seen(page, "#lines"), seen(page, "#strip")
    assert before[0] != after[0]
    assert before[1] != after[1]


def test_a_photo_without_a_visible_skyline_is_veiled_and_exports_nothing_visible(page):
    before = seen(page, "#lines")
    page.keys("t", "1", "t")  # the key that opens the dialog closes it
    assert page.document()["tags"] == ["no visible skyline"]
    assert page.document()["nothing_visible"]
    page.page.wait_for_timeout(200)
    assert seen(page, "#lines") != before
    page.keys("n")
    page.says("No span is uncertain.")
    page.keys(" ")
    page.says("hill-0.png is accepted, with no visible skyline: its line does not count.")
    said = page.client.get("/api/exports/csv")
    with zipfile.ZipFile(io.BytesIO(said.content)) as archive:
        _, *lines = archive.read("hill-0.csv").decode().splitlines()
    assert {line.split(",")[2] for line in lines} == {"0"}


def test_the_guideline_has_pictures_and_a_key(page):
    page.keys("Shift+G")
    dialog = page.page.locator("#guideline-dialog")
    words = dialog.inner_text()
    for part in ("Trees", "Houses", "People", "Masts", "Cloud", "fog", "Water", "Frames"):
        assert part in words
    for picture in dialog.locator("img").all():
        picture.scroll_into_view_if_needed()
        picture.evaluate("one => one.decode()")
    page.keys("Escape")
    assert page.page.locator("#lines:focus").count() == 1
    page.keys("?")
    assert "Guideline: what the skyline is" in page.page.locator("#help-dialog").inner_text()


def test_a_folders_own_guideline_takes_its_place_as_text(page, folder):
    own = "# Our rules\n<img src=x onerror=\"document.title='run'\"><b>Huts</b> do not count.\n"
    (folder / "GUIDELINE.md").write_text(own, encoding="utf-8")
    page.page.locator("#guideline").click()
    text = page.page.locator("#guideline-own")
    text.wait_for()
    assert text.text_content() == own
    assert text.locator("*").count() == 0
    assert not page.page.locator("#guideline-ours").is_visible()
    page.keys("Escape")
    (folder / "GUIDELINE.md").write_bytes(b"\xff\xfe\x00")
    page.keys("Shift+G")
    page.page.locator("#guideline-trouble", has_text="is no text in UTF-8.").wait_for()
    page.keys("Escape")


def test_list_and_sheet_are_filtered_by_confidence_and_by_what_others_have_finished(
    browser, folder
):
    label(folder, annotator="bob", photos=2)
    with served(folder) as client:
        page = Page(browser, client)
        items, cards = page.page.locator(".item"), page.page.locator(".card")
        page.page.locator("#filter").select_option("by:bob")
        assert items.count() == 2
        page.page.locator("#filter").select_option("not:bob")
        assert items.count() == 2
        assert "bob" not in page.page.locator("#list").inner_text()
        page.page.locator("#sheet-open").click()
        cards.first.wait_for()
        page.page.locator("#sheet-filter").select_option("by:bob")
        page.page.locator("#sheet-cards .card", has_text="hill-1.png").wait_for()
        assert cards.count() == 2
        page.page.locator("#sheet-filter").select_option("is:rejected")
        page.page.locator("#sheet-cards", has_text="No photo matches “rejected”.").wait_for()
        page.close()


def test_in_the_sheet_digits_tick_tags(page):
    page.keys("w")
    page.page.locator(".card.current").wait_for()
    page.keys("ArrowRight", "2")
    page.says("hill-1.png has the tag “not left to right”.")
    page.saved()
    assert page.document(2)["tags"] == ["not left to right"]
    page.keys("2")
    page.saved()
    assert page.document(2)["tags"] == []


def rest(page, element):
    """Let a finger rest on something."""
    box = until(element.bounding_box)  # none while the list is laid out anew
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    session = page.context.new_cdp_session(page.page)
    touch = {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]}
    session.send("Input.dispatchTouchEvent", touch)
    page.page.wait_for_timeout(700)
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    session.detach()


@pytest.mark.parametrize("where", ["list", "sheet"])
def test_a_finger_that_rests_chooses_and_taps_choose_more(browser, client, where):
    page = Page(browser, client, has_touch=True, viewport={"width": 1024, "height": 768})
    if where == "sheet":
        page.page.locator("#sheet-open").tap()
        page.page.locator(".card").first.wait_for()
    found = page.page.locator(".item" if where == "list" else ".card")
    count = page.page.locator("#chosen-count")
    rest(page, found.nth(1))
    assert count.inner_text() == "1 photo chosen"
    page.shows("hill-0.png" if where == "list" else "hill-1.png")  # and nothing was opened
    found.nth(2).tap()
    assert count.inner_text() == "2 photos chosen"
    found.nth(1).tap()
    assert count.inner_text() == "1 photo chosen"
    page.page.locator("#chosen-accept").tap()
    page.says("1 photo is accepted.")
    page.saved()
    statuses = [one["status"] for one in page.client.get("/api/photos").json()["photos"]]
    assert statuses == ["to do", "to do", "accepted", "to do"]
    if where == "list":
        found.nth(1).tap()  # none is chosen any more: a tap opens again
        page.shows("hill-1.png")
    page.close()


def test_on_a_phone_the_list_leaves_what_is_said_and_its_undo_in_sight(browser, client):
    page = Page(browser, client, has_touch=True, viewport=PHONE)
    page.page.locator("#list-toggle").tap()
    rest(page, page.page.locator(".item").nth(1))
    page.page.locator("#chosen-accept").tap()
    page.says("1 photo is accepted.")
    page.page.locator("#said-undo").tap()
    page.says("hill-1.png is to do again.")
    page.close()


def test_the_header_undoes_a_corner_of_a_guide(page):
    undo = page.page.locator("#undo")
    assert undo.is_disabled()
    page.keys("i")
    page.page.mouse.click(*page.at(50, 100))
    assert undo.is_enabled()
    assert "the last corner of the guide" in undo.get_attribute("title")
    undo.click()
    assert undo.is_disabled()


def test_in_the_tour_no_key_of_the_sheet_works(browser, client):
    page = Page(browser, client)
    page.page.evaluate("localStorage.clear()")
    page.open()
    page.page.locator("#tour-begin").click()
    page.page.locator("#tour").wait_for()
    page.page.locator("#sheet-open").click(force=True)
    page.page.locator(".card").first.wait_for()
    page.page.locator(".card").first.focus()
    page.keys("a", "d", "x", "1")
    statuses = [one["status"] for one in page.client.get("/api/photos").json()["photos"]]
    assert statuses == ["to do"] * 4
    assert not page.page.locator("#chosen").is_visible()
    page.close()
