"""In the labelling page: deciding where passes differ, and saying what is wrong."""

import pytest

from testing.labelling import served, write_hills
from testing.labels import label_named, run
from testing.programs.browser import Page


@pytest.fixture
def folder(tmp_path):
    folder = write_hills(tmp_path / "alps")
    for who, row in (("ann", 10), ("bob", 30)):
        label_named(folder, ["hill-0.png", "hill-1.png"], row, who)
    return folder


def test_somebody_decides_between_the_lines_of_two_passes(browser, folder):
    assert run("consensus", folder) == 0
    with served(folder, annotator="consensus") as client:
        page = Page(browser, client)
        page.says("consensus: ann and bob differ by up to 20 px in columns 0 to 69")
        page.keys("n")
        page.says("Passes differ in span 1 of 1: columns 0 to 69. 1 shows their lines.")
        page.keys("1")
        page.page.locator("#choices button", has_text="2: bob").click()
        page.says("The line of bob is taken in columns 0 to 69.")
        page.saved()
        assert set(page.document()["rows"]) == {30}
        page.keys("Space")
        page.says("Of this one says consensus: ann and bob differ")
        assert [page.document(number)["status"] for number in (1, 2)] == [
            "accepted",
            "needs review",
        ]
        page.close()


@pytest.mark.parametrize("how", ["key", "mouse"])
def test_a_photo_is_sent_back_with_a_sentence(browser, folder, how):
    with served(folder, annotator="ann", reviewer="eve") as client:
        page = Page(browser, client)
        page.page.locator("#list .item", has_text="hill-0.png").click()
        page.shows("hill-0.png")
        page.wait_for_photo()
        if how == "key":
            page.keys("Shift+R")
        else:
            page.page.locator("#tags").click()
            page.page.locator("#comment-open").click()
        page.page.locator("#comment").fill("the hut is cut off")
        page.page.keyboard.press("Enter")
        page.says("hill-0.png is needs review.")
        assert page.document()["comment"] == {"text": "the hut is cut off", "by": "eve"}
        item = page.page.locator("#list .item", has_text="hill-0.png")
        item.locator(".sub", has_text="eve: the hut is cut off").wait_for()
        page.keys("u")
        page.says("hill-0.png is accepted again.")
        assert page.document()["comment"] is None
        page.close()
