"""Two people label the same folder at the same time, each in a browser of their own."""

import pytest

from testing.labelling import served_to, write_hills
from testing.programs.browser import Page

SIZE = {"height": 240, "width": 400}


@pytest.fixture
def people(browser, tmp_path):
    folder = write_hills(tmp_path / "alps", **SIZE)
    with served_to(folder, "ann", "bob") as clients:
        pages = [Page(browser, client) for client in clients]
        yield pages
        for page in pages:
            page.close()


def anchors(page, photo=1):
    return page.document(photo)["anchors"]


def click(page, column, row):
    """Set an anchor exactly here."""
    page.page.keyboard.down("Shift")
    page.click(column, row)
    page.page.keyboard.up("Shift")


def test_two_people_finish_the_same_photo_and_neither_sees_the_other(people):
    ann, bob = people
    before = bob.document()["rows"]
    click(ann, 60, 90)
    bob.page.reload()
    bob.wait_for_photo()
    assert bob.document()["rows"] == before
    assert bob.page.locator("#undo").is_disabled()
    click(bob, 200, 40)
    for page in people:  # both at once: neither waits for the other
        page.page.keyboard.press("Space")
    for page in people:
        page.says("hill-0.png is accepted")
        page.saved()
        page.shows("hill-1.png")
        assert page.page.locator("#progress-words").text_content().startswith("1 of 3")
    assert anchors(ann) == [[60, 90]]
    assert anchors(bob) == [[200, 40]]
    ann.keys("u")
    ann.shows("hill-0.png")
    ann.wait_for_photo()
    ann.keys("u")
    assert anchors(ann) == []
    assert (anchors(bob), bob.document()["status"]) == ([[200, 40]], "accepted")
    for page, name in zip(people, ("ann", "bob"), strict=True):
        page.page.locator("#more").click()
        assert name in page.page.locator("#who").text_content()
        assert "token" not in page.page.url


def test_an_old_link_and_no_link_say_what_to_do(browser, people):
    ann, bob = people
    bob.page.goto(bob.address + "x")
    bob.page.locator("p", has_text="open the address that was printed.").wait_for()
    stranger = browser.new_context().new_page()
    stranger.goto(ann.address.partition("?")[0])
    stranger.locator("#empty", has_text="open the address that it printed").wait_for()
    stranger.context.close()
