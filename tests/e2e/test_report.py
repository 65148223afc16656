"""A report in a real browser: opened as a file, without a network, sorted and filtered."""

import pytest
from axe_playwright_python.sync_playwright import Axe

from skyline_viz.cli import main
from skyline_viz.skyline import Skyline
from testing.detections import write_slanting
from testing.programs.browser import windows_on

NAMES = ["p0", "p1", "p2", "p3"]


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """Four photos, one of them with a wrong segment, and one that cannot be read."""
    folder = tmp_path_factory.mktemp("report")
    items = write_slanting(folder / "hills")
    rows = items[1].truth().rows.copy()
    rows[30:60] -= 12
    Skyline(rows).write_csv(items[1].truth_path)
    items[4].photo_path.write_bytes(b"no photo")
    file = folder / "r.html"
    words = ["--method", "default:sky_weight=0,delta=1", "--report", str(file)]
    assert main(["diagnose", str(folder / "hills"), *words]) == 1
    return file


@pytest.fixture
def window(browser, report):
    """Opens the report; it may ask for nothing but itself."""
    with windows_on(browser, report, lambda url: url == report.as_uri()) as opened:
        yield opened


def cards(page):
    return page.locator("article:visible .name").all_inner_texts()


def errors_of(page):
    return page.locator("article").evaluate_all("all => all.map((one) => +one.dataset.error)")


def test_the_worst_come_first_and_every_picture_shows(window):
    page = window()
    assert sorted(cards(page)) == NAMES
    found = errors_of(page)
    assert found == sorted(found, reverse=True)
    assert page.evaluate("[...document.images].every((one) => one.complete && one.naturalWidth)")
    assert "p4" in page.locator(".failures li").inner_text()


def test_photos_are_ordered_and_chosen(window):
    page = window()
    page.locator("#order").select_option("name")
    assert cards(page) == NAMES
    page.locator("#order").select_option("margin")
    margins = page.locator("article").evaluate_all("all => all.map((one) => +one.dataset.margin)")
    assert margins == sorted(margins)
    page.locator("#name").fill("P2")
    assert cards(page) == ["p2"]
    assert page.locator("#count").inner_text() == "1 of 4 photos"
    page.locator("#name").fill("")
    page.locator("#least").fill(str(max(errors_of(page))))
    assert len(cards(page)) == 1
    page.locator("#least").fill("9999")
    assert page.locator("#nothing").is_visible()
    page.locator("#least").fill("")
    page.locator("#margin").fill(str(margins[0]))
    assert len(cards(page)) == 1


def test_a_cause_of_the_table_chooses_its_photos(window):
    page = window()
    row = page.locator(".causes tbody tr").first
    photos = int(row.locator("td").first.inner_text())
    row.locator("button").click()
    assert len(cards(page)) == photos
    page.locator("#order").select_option("cause")
    assert len(cards(page)) == photos


def test_a_click_on_a_photo_opens_its_stages(window):
    page = window()
    first = page.locator("article").first
    assert first.locator(".stages").is_hidden()
    first.locator(".top .picture").click()
    assert first.locator(".stages figure").first.is_visible()
    assert first.locator(".plot").first.is_visible()
    first.locator(".inside > summary").click()
    assert first.locator(".stages").is_hidden()


def test_lines_can_be_hidden(window):
    page = window()
    lines = page.locator("article .top .lines").first
    assert lines.is_visible()
    page.locator("#lines").uncheck()
    assert lines.is_hidden()


def test_without_its_script_all_can_be_read(window):
    page = window(java_script_enabled=False)
    assert len(cards(page)) == len(NAMES)
    page.locator(".inside > summary").first.click()
    assert page.locator(".stages").first.is_visible()


@pytest.mark.parametrize("width", [390, 1024, 1440])
def test_nothing_is_wider_than_the_window(window, width):
    page = window()
    page.set_viewport_size({"width": width, "height": 800})
    page.locator(".inside > summary").first.click()
    assert page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing(window, scheme):
    page = window(color_scheme=scheme, bypass_csp=True)  # axe itself is another script
    page.locator(".inside > summary").first.click()
    found = Axe().run(page).response["violations"]
    assert [(one["id"], [node["target"] for node in one["nodes"]]) for one in found] == []
