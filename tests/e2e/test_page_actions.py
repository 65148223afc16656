"""Which photo buttons and keys of the labelling page act on, and how it is taken back."""

import re

import pytest

from testing.labelling import asked, served, write_hills
from testing.programs.browser import Page, hold

SIZE = {"height": 240, "width": 400}


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps", count=4, **SIZE)


@pytest.fixture
def page(browser, folder):
    with served(folder) as client:
        page = Page(browser, client)
        yield page
        page.close()


def statuses(page):
    return [photo["status"] for photo in page.client.get("/api/photos").json()["photos"]]


def name(page):
    return page.page.locator("#name").text_content()


@pytest.mark.parametrize(
    ("key", "status"), [("Space", "accepted"), ("r", "needs review"), ("q", "rejected")]
)
@pytest.mark.parametrize("how", ["key", "button", "message"])
def test_a_status_is_taken_back_from_the_next_photo(page, key, status, how):
    page.keys(key)
    page.says(f"hill-0.png is {status}.")
    page.shows("hill-1.png")
    page.page.locator(f"#undo[title='Undo: hill-0.png {status} ( U )']").wait_for()
    if how == "key":
        page.keys("u")
    else:
        page.page.locator("#undo" if how == "button" else "#said-undo").click()
    page.says("hill-0.png is to do again.")
    page.shows("hill-0.png")
    assert statuses(page) == ["to do"] * 4
    page.keys("y")
    assert statuses(page)[0] == status


def test_undo_stays_on_the_next_photo_once_something_is_done_there(page):
    page.keys("Space")
    page.shows("hill-1.png")
    page.says("accepted")
    page.click(100, 90)
    page.keys("u", "u")
    assert statuses(page)[0] == "accepted"
    assert page.document(2)["anchors"] == []
    page.says("nothing to undo")
    page.keys("[")
    page.shows("hill-0.png")
    page.page.locator("#undo[title='Undo: accepted ( U )']").click()
    page.says("hill-0.png is to do again.")
    assert statuses(page)[0] == "to do"


def test_editing_an_accepted_photo_says_what_it_does(page):
    page.keys("Space")
    page.shows("hill-1.png")
    page.keys("[")
    page.shows("hill-0.png")
    page.saved()
    page.click(100, 90)
    page.says("hill-0.png is no longer accepted: it was changed. Undo takes that back.")
    assert page.page.locator("#status").input_value() == "in progress"
    page.page.locator("#said-undo").click()
    page.says("hill-0.png is accepted again.")
    assert statuses(page)[0] == "accepted"


def test_a_photo_is_set_back_to_to_do(page):
    page.keys("Space")
    page.shows("hill-1.png")
    page.keys("[")
    page.shows("hill-0.png")
    page.saved()
    page.page.locator("#status").select_option("to do")
    page.says("hill-0.png is to do.")
    page.keys("u")
    page.says("hill-0.png is accepted again.")
    page.keys("c")
    page.says("hill-0.png is to do.")
    assert statuses(page)[0] == "to do"


def test_a_second_press_of_space_accepts_nothing_else(page):
    page.page.locator("#lines").focus()
    page.page.route("**/operations", lambda route: route.abort(), times=1)
    page.page.keyboard.press("Space")
    page.page.keyboard.press("Space")
    page.page.locator("#saving", has_text="1 not saved").wait_for()
    page.says("hill-0.png is accepted")
    assert statuses(page) == ["accepted", "to do", "to do", "to do"]


def hold_first(page):
    """Keep the next operation on the first photo on its way."""
    return hold(page.page, "**/photos/1/operations")


@pytest.mark.parametrize("elsewhere", [False, True])
def test_an_edit_behind_an_accept_is_what_is_said(page, elsewhere):
    held = hold_first(page)
    page.page.locator("#lines").focus()
    page.page.keyboard.press("Space")
    page.page.mouse.click(*page.at(100, 90))
    if elsewhere:
        page.page.keyboard.press("]")
        page.shows("hill-1.png")
    page.page.locator("#saving", has_text="2 not saved").wait_for()
    held[0].continue_()
    page.says("hill-0.png is no longer accepted: it was changed.")
    page.saved()
    assert statuses(page)[0] == "in progress"
    if elsewhere:
        assert page.page.locator("#undo").is_disabled()
        page.keys("[")
    page.shows("hill-0.png")
    page.saved()
    page.page.locator("#undo[title='Undo: the anchor ( U )']").wait_for()
    page.keys("u")
    assert (statuses(page)[0], page.document()["anchors"]) == ("accepted", [])


def test_a_tag_behind_an_accept_leaves_its_undo_in_place(page):
    page.page.locator("#lines").focus()
    page.page.keyboard.press("t")
    held = hold_first(page)
    page.page.evaluate("document.getElementById('accept').click()")
    page.page.get_by_label("needs terrain data").check()
    page.page.locator("#saving", has_text="2 not saved").wait_for()
    held[0].continue_()
    page.says("hill-0.png is accepted.")
    page.shows("hill-1.png")
    page.keys("Escape", "u")
    page.says("hill-0.png is to do again.")
    assert page.page.locator("#lost").is_hidden()
    assert statuses(page)[0] == "to do"


def test_an_acceptance_is_not_taken_back_from_the_next_photo_once_something_came_after_it(page):
    page.keys("Space")
    page.shows("hill-1.png")
    page.says("hill-0.png is accepted.")
    other = {"kind": "anchor", "column": 300, "row": 90}
    page.client.post("/api/photos/1/operations", json=asked(operation=other))
    page.keys("u")
    page.page.locator("#lost", has_text="1 not kept").wait_for()
    assert [column for column, _ in page.document()["anchors"]] == [300]
    page.errors.clear()


def test_a_status_that_holds_already_is_said_and_undo_takes_back_the_edit_before_it(page):
    page.keys("r")
    page.shows("hill-1.png")
    page.keys("[")
    page.shows("hill-0.png")
    page.saved()
    page.click(100, 90)
    page.keys("r")
    page.says("hill-0.png is needs review already.")
    page.shows("hill-1.png")
    assert page.page.locator("#said-undo").is_hidden()
    page.keys("u")
    page.says("nothing to undo")
    assert len(page.document()["anchors"]) == 1
    page.keys("w")
    page.page.locator(".card", has_text="hill-2.png").click()
    page.keys("c")
    page.says("hill-2.png is to do already.")
    page.keys("u")
    page.says("Nothing was done on this page")
    assert page.page.locator("#lost").is_hidden()


def test_in_the_sheet_undo_takes_back_what_is_still_on_its_way(page):
    page.keys("w")
    first = page.page.locator(".card").first
    first.click()
    page.keys("r")
    page.says("hill-0.png is needs review.")
    first.click()
    held = hold_first(page)
    page.page.keyboard.press("d")
    page.page.keyboard.press("u")
    page.page.locator("#saving", has_text="2 not saved").wait_for()
    held[0].continue_()
    page.says("hill-0.png is needs review again.")
    page.saved()
    page.page.locator("#undo[title='Undo: hill-0.png needs review ( U )']").click()
    page.says("hill-0.png is to do again.")
    assert statuses(page)[0] == "to do"


def test_a_blind_photo_without_a_line_is_accepted_nowhere(browser, folder):
    with served(folder, blind=1.0) as client:
        page = Page(browser, client)
        page.page.locator("#lines").focus()
        page.keys("Space")
        page.says("hill-0.png has no line yet, so there is nothing to accept.")
        page.keys("w")
        page.page.locator(".card", has_text="hill-1.png").click()
        page.keys("a")
        page.says("hill-1.png has no line yet, so there is nothing to accept.")
        assert statuses(page) == ["to do"] * 4
        page.keys("d", "Escape")
        page.close()


def test_everything_acts_on_the_card_of_the_sheet(page):
    page.keys("w")
    cards = page.page.locator(".card")
    cards.nth(1).click()
    assert name(page) == "hill-1.png"
    page.page.locator("#accept").click()
    page.says("hill-1.png is accepted.")
    assert statuses(page) == ["to do", "accepted", "to do", "to do"]
    assert name(page) == "hill-2.png"
    page.keys("r")
    page.says("hill-2.png is needs review.")
    page.keys("d")
    page.says("hill-3.png is rejected.")
    cards.first.click()
    page.page.locator("#tags").click()
    page.page.locator("#tags-title", has_text="Tags of hill-0.png").wait_for()
    page.page.get_by_label("needs terrain data").check()
    page.page.keyboard.press("Escape")
    page.saved()
    photos = page.client.get("/api/photos").json()["photos"]
    assert [photo["tags"] for photo in photos] == [["needs terrain data"], [], [], []]
    assert page.page.locator("#next").is_disabled()
    for key in ("b", "1", "Delete", "k", "n", "]"):
        page.keys(key)
    assert statuses(page) == ["to do", "accepted", "needs review", "rejected"]
    page.page.locator("#undo[title='Undo: hill-3.png rejected ( U )']").click()
    page.says("hill-3.png is to do again.")
    page.keys("u", "u")
    page.says("hill-1.png is to do again.")
    assert statuses(page) == ["to do"] * 4
    assert name(page) == "hill-1.png"
    page.keys("u")
    page.says("Nothing was done on this page")
    page.keys("a")
    page.says("hill-1.png is accepted.")
    page.page.locator("#said-undo").click()
    page.says("hill-1.png is to do again.")
    assert all(page.document(photo)["anchors"] == [] for photo in (1, 2, 3, 4))


def test_a_photo_chosen_from_the_list_has_the_keys(page):
    page.keys("/")
    page.page.keyboard.type("hill-2")
    page.page.locator(".item").click()
    page.shows("hill-2.png")
    page.page.locator("#accept:enabled").wait_for()
    page.keys("t")
    page.page.locator("#tags-dialog[open]").wait_for()
    page.page.keyboard.press("Escape")
    assert page.page.locator("#search").input_value() == "hill-2"
    page.page.locator("#search").fill("no such photo")
    page.page.get_by_text("No photo matches.").wait_for()


def test_messages_of_another_photo_are_cleared(page):
    page.keys("Space")
    page.says("hill-0.png is accepted.")
    page.page.locator(".item", has_text="hill-3").click()
    page.shows("hill-3.png")
    assert page.page.locator("#said").text_content() == ""
    assert page.page.locator("#said-undo").is_hidden()


def test_nothing_acts_before_a_photo_is_there(browser, folder):
    with served(folder) as client:
        page = Page(browser, client)
        page.page.route("**/api/photos/1", lambda route: None)  # not answered for now
        page.page.reload()
        page.page.get_by_text("hill-0.png is being read").wait_for()
        for button in ("accept", "review", "reject", "tags", "undo", "redo", "status"):
            assert page.page.locator(f"#{button}").is_disabled()
        keys = "Enter Space Delete ArrowLeft ArrowUp m k f 1 u t g"
        for key in keys.split():
            page.page.keyboard.press(key)
        page.page.unroute("**/api/photos/1")  # which lets them go on
        page.wait_for_photo()
        assert page.document()["revision"] == 0
        assert statuses(page) == ["to do"] * 4
        page.close()


def test_a_page_without_the_token_says_what_to_do(page):
    other = page.context.new_page()
    other.goto(str(page.client.base_url))
    other.get_by_text("open the address that it printed").wait_for()
    other.goto(page.address)
    other.locator("#accept:enabled").wait_for()
    assert other.url == f"{page.client.base_url}/"
    other.reload()
    other.locator("#accept:enabled").wait_for()
    other.close()
    page.errors.clear()


def test_undo_and_accept_leave_alone_what_another_tab_did(page):
    page.click(100, 90)
    other = {"kind": "anchor", "column": 300, "row": 90}
    page.client.post("/api/photos/1/operations", json=asked(operation=other))
    page.keys("u")
    page.page.locator("#lost", has_text="1 not kept").wait_for()
    page.says("changed in another tab")
    assert [column for column, _ in page.document()["anchors"]] == [100, 300]
    page.client.post("/api/photos/1/operations", json=asked(operation={**other, "column": 350}))
    page.page.keyboard.press("Space")
    page.page.locator("#lost", has_text=re.compile("2 not kept")).wait_for()
    assert statuses(page)[0] == "in progress"
    assert name(page) == "hill-0.png"
    page.errors.clear()
