"""The labelling page while network and server fail: nothing is lost, or doubled."""

import re

import pytest

from benchmarks.reliability.page import worked
from skyline_viz.photo import write_photo
from testing.labelling import hills, served, write_hills
from testing.programs.browser import Page, hold
from testing.programs.restarts import Restarted, kept_anchors

SIZE = {"height": 240, "width": 400}


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps", **SIZE)


@pytest.fixture
def page(browser, folder):
    with served(folder) as client:
        page = Page(browser, client)
        yield page
        page.errors.clear()  # of faults that were made on purpose
        page.close()


def anchors(page, photo=1):
    return [column for column, _ in page.document(photo)["anchors"]]


def lose_answer(route):
    route.fetch()
    route.abort()


def break_off(route):
    said = route.fetch()
    headers = {**said.headers, "content-length": str(len(said.body()))}
    route.fulfill(status=200, headers=headers, body=said.body()[:40])


def another_page(route):
    route.fetch()
    route.fulfill(status=200, content_type="text/html", body="<html>A proxy.</html>")


def full_disk(route):
    said = route.fetch()
    headers = {"content-type": "application/json", "x-skyline-pass": said.headers["x-skyline-pass"]}
    route.fulfill(status=507, headers=headers, body='{"detail": "the disk is full."}')


@pytest.mark.parametrize("fault", [lose_answer, break_off, another_page, full_disk])
def test_an_edit_whose_answer_is_spoiled_is_kept_once(page, fault):
    for column in (60, 200):
        page.page.route("**/operations", fault, times=2)
        x, y = page.at(column, 90)
        page.page.mouse.click(x, y)
        before = page.page.locator("#lines").bounding_box()
        page.page.locator("#trouble", has_text="1 edit waits").wait_for()
        assert page.page.locator("#saving").text_content() == "1 not saved"
        assert page.page.locator("#lines").bounding_box() == before  # nothing moves under the hand
        page.saved()
        assert page.page.locator("#trouble").is_hidden()
    assert anchors(page) == [60, 200]
    page.keys("u")
    assert anchors(page) == [60]


def test_sending_never_freezes(page):
    page.page.clock.install()
    hold(page.page, "**/operations")  # is never answered
    x, y = page.at(60, 90)
    page.page.mouse.click(x, y)
    page.page.locator("#saving[data-state=unsaved]").wait_for()
    page.page.clock.run_for(11_000)
    page.page.locator("#trouble", has_text="does not answer").wait_for()
    page.page.clock.run_for(1000)
    page.saved()
    assert anchors(page) == [60]


def test_what_waits_outlives_a_reload(page):
    page.page.route("**/operations", lambda route: route.abort())
    for column in (60, 200):
        page.page.mouse.click(*page.at(column, 90))
    page.page.locator("#saving", has_text="2 not saved").wait_for()
    page.page.on("dialog", lambda dialog: dialog.accept())
    page.page.reload()
    page.page.unroute("**/operations")
    page.wait_for_photo()
    page.page.locator("#saving", has_text=re.compile("^saved$")).wait_for()
    page.page.wait_for_function(
        "() => !Object.keys(localStorage).some(key => key.startsWith('skyline-queue'))"
    )
    assert anchors(page) == [60, 200]
    assert "token" not in page.page.url


def around(page, column, row):
    """What is drawn over the photo around a pixel."""
    x, y = page.at(column, row)
    box = page.page.locator("#lines").bounding_box()
    return page.page.evaluate(
        """([x, y]) => Array.from(document.getElementById("lines").getContext("2d").getImageData(
            (x - 20) * devicePixelRatio, (y - 20) * devicePixelRatio, 40, 40).data)""",
        [x - box["x"], y - box["y"]],
    )


def test_what_waits_is_drawn_and_the_page_says_that_the_line_follows(page):
    before = around(page, 60, 20)
    assert not any(before)  # far above the line
    page.page.route("**/api/**", lambda route: route.abort())
    x, y = page.place(60, 20, SIZE)
    page.page.mouse.click(x, y)
    page.page.mouse.move(x + 300, y)
    said = "does not answer. 1 edit waits and is sent as soon as it can be; the line follows then."
    page.page.locator("#trouble", has_text=said).wait_for()
    page.page.keyboard.press("]")
    page.says("The server does not answer.")
    page.page.unroute("**/api/**")
    page.page.route("**/operations", lambda route: route.abort())
    waiting = around(page, 60, 20)
    centre = 4 * (20 * 40 + 20) + 3
    assert any(waiting)
    assert waiting[centre] == 0  # hollow
    page.page.unroute("**/operations")
    page.saved()
    page.page.mouse.move(x + 300, y + 1)
    assert anchors(page) == [60]
    assert around(page, 60, 20)[centre] == 255


def test_leaving_while_something_waits_is_asked_about(page):
    page.page.route("**/operations", lambda route: route.abort())
    page.page.mouse.click(*page.at(60, 90))
    page.page.locator("#trouble", has_text="1 edit waits").wait_for()
    with page.page.expect_event("dialog") as asked:
        page.page.evaluate("setTimeout(() => location.reload())")
    assert asked.value.type == "beforeunload"
    asked.value.dismiss()
    page.page.unroute("**/operations")
    page.saved()
    assert anchors(page) == [60]


def test_edits_are_sent_for_the_photo_they_were_made_on(page):
    page.page.route("**/photos/1/operations", lambda route: route.abort())
    page.page.mouse.click(*page.at(60, 90))
    page.page.locator("#trouble", has_text="1 edit waits").wait_for()
    page.page.locator(".item", has_text="hill-1.png").click()
    page.shows("hill-1.png")
    page.page.mouse.click(*page.at(120, 90))
    page.page.locator("#saving", has_text="2 not saved").wait_for()
    page.page.unroute("**/photos/1/operations")
    page.saved()
    assert (anchors(page, 1), anchors(page, 2)) == ([60], [120])


def test_edits_of_a_photo_that_was_replaced_are_named(page, folder):
    page.click(60, 90)
    write_photo(folder / "hill-0.png", hills(9, **SIZE))
    page.page.mouse.click(*page.at(200, 90))
    page.says("is not kept")
    page.page.locator("#lost", has_text="1 not kept").click()
    page.page.locator("#lost-list li", has_text="hill-0.png: the anchor at column 200").wait_for()
    page.page.reload()
    page.page.locator("#lost", has_text="1 not kept").click()
    page.page.get_by_role("button", name="Clear the list").click()
    assert page.page.locator("#lost").is_hidden()


def test_two_tabs_on_one_photo_lose_nothing(page):
    other = page.context.new_page()
    other.goto(page.address)
    other.locator("#name", has_text="hill-0.png").wait_for()
    page.click(100, 80)
    other.locator("#lines").focus()
    other.keyboard.press("ArrowRight")
    other.keyboard.press("Enter")
    other.locator("#said", has_text="changed in another tab").wait_for()
    other.locator("#saving[data-state=saved]").wait_for()
    assert len(page.document()["anchors"]) == 2
    other.keyboard.press("u")
    other.wait_for_timeout(500)
    ((column, row),) = page.document()["anchors"]  # it snaps to an edge beside it
    assert column == 100
    assert abs(row - 80) <= 4


def test_two_tabs_do_not_take_from_one_another(page):
    page.page.route("**/operations", lambda route: route.abort())
    page.page.mouse.click(*page.at(60, 90))
    page.page.locator("#trouble", has_text="1 edit waits").wait_for()
    other = page.context.new_page()
    other.goto(page.address)
    other.locator("#accept:enabled").wait_for()
    other.wait_for_timeout(500)
    assert anchors(page) == []
    page.page.unroute("**/operations")
    page.saved()
    assert anchors(page) == [60]
    other.close()


def test_a_page_goes_on_by_itself_when_its_server_was_killed(browser, folder):
    with Restarted(folder) as server:
        page = Page(browser, server)
        page.click(60, 90)
        server.kill()
        page.page.mouse.click(*page.place(200, 90, SIZE))
        page.page.locator("#trouble", has_text="1 edit waits").wait_for()
        server.start()
        page.saved()
        page.errors.clear()
        assert anchors(page) == [60, 200]
        page.page.reload()
        page.wait_for_photo()
        page.close()
    assert kept_anchors(folder, 1) == [60, 200]


def test_another_folder_at_the_same_address_gets_nothing(browser, folder, tmp_path):
    with Restarted(folder) as server:
        page = Page(browser, server)
        server.kill()
        page.page.mouse.click(*page.place(60, 90, SIZE))
        page.page.locator("#trouble", has_text="does not answer").wait_for()
        other = write_hills(tmp_path / "andes", **SIZE)
        with Restarted(other, port=server.port):
            page.page.locator("#trouble", has_text="another folder").wait_for(timeout=20_000)
        server.start()
        page.saved()
        page.errors.clear()
        assert anchors(page) == [60]
        page.close()
    assert kept_anchors(other, 1) == []


def test_operations_while_server_and_network_come_and_go(browser, folder):
    work = worked(browser, folder, operations=40, kills=3, offline=3, seed=5)
    assert (work.clicked, work.kills, work.offline) == (40, 3, 3)
    assert (work.lost, work.doubled, work.named) == ([], [], [])
    assert work.in_order
