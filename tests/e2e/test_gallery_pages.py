"""Pages of a data set in a real browser: opened as files, without a network, by keyboard too."""

import pytest
from axe_playwright_python.sync_playwright import Axe

from skyline_viz.cli import main
from skyline_viz.skyline import Skyline
from testing.detections import write_slanting
from testing.programs.browser import windows_on


@pytest.fixture(scope="module")
def index(tmp_path_factory):
    """Five photos, one of them with a wrong segment, in two folders."""
    folder = tmp_path_factory.mktemp("pages")
    items = write_slanting(folder / "hills")
    rows = items[1].truth().rows.copy()
    rows[30:60] -= 12
    Skyline(rows).write_csv(items[1].truth_path)
    write_slanting(folder / "more")
    photos = [str(folder / "hills"), str(folder / "more" / "images" / "p0.png")]
    assert main(["gallery", *photos, "--html", str(folder / "out")]) == 0
    return folder / "out" / "index.html"


@pytest.fixture
def window(browser, index):
    """Opens the cards; they may ask for nothing outside their folder."""
    home = index.parent.as_uri() + "/"
    with windows_on(browser, index, lambda url: url.startswith(home)) as opened:
        yield opened


def cards(page):
    return page.locator("article:visible .name").all_inner_texts()


def test_pictures_show_as_files(window):
    page = window()
    assert len(cards(page)) == 6
    for picture in page.locator("article img").all():
        picture.scroll_into_view_if_needed()
        picture.evaluate("(one) => one.decode()")
        assert picture.evaluate("(one) => one.naturalWidth") > 0


def test_photos_are_chosen_by_tag_and_confidence(window):
    page = window()
    page.locator("#order").select_option("confidence")
    sure = page.locator("article").evaluate_all("all => all.map((one) => +one.dataset.confidence)")
    assert sure == sorted(sure)
    page.locator("#confidence").fill(str(sure[0]))
    assert len(cards(page)) == sure.count(sure[0])
    page.locator("#confidence").fill("")
    page.locator("#tag").select_option("more/images")
    assert len(cards(page)) == 1


def test_the_keyboard_opens_the_stages_and_comes_back_to_what_was_chosen(window):
    page = window()
    page.locator("#name").fill("p2")
    assert cards(page) == ["p2"]
    page.locator("#margin").focus()
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    page.locator(".stages figure").first.wait_for()
    assert page.locator("h1").inner_text() == "p2"
    page.go_back()
    page.locator("#count", has_text="1 of 6").wait_for()
    assert cards(page) == ["p2"]


def test_a_click_on_a_photo_opens_it_and_a_link_leads_back(window):
    page = window()
    page.locator("#order").select_option("name")
    page.locator("article .picture").first.click()
    page.locator(".stages figure").first.wait_for()
    page.get_by_role("link", name="All photos").click()
    page.locator("#controls").wait_for()


def test_without_its_script_all_can_be_read(window):
    page = window(java_script_enabled=False)
    assert len(cards(page)) == 6
    page.locator(".name a").first.click()
    assert page.locator(".stages").is_visible()


@pytest.mark.parametrize("width", [390, 1440])
def test_nothing_is_wider_than_the_window(window, width):
    page = window()
    page.set_viewport_size({"width": width, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing(window, scheme):
    page = window(color_scheme=scheme, bypass_csp=True)  # axe itself is another script
    assert violations(page) == []
    page.locator(".name a").first.click()
    page.get_by_role("link", name="All photos").wait_for()
    assert violations(page) == []


def violations(page):
    found = Axe().run(page).response["violations"]
    return [(one["id"], [node["target"] for node in one["nodes"]]) for one in found]
