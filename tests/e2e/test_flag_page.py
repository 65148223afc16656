"""The page for flags in a real browser: what is said is kept, by keyboard too, and never undone."""

import pytest
from axe_playwright_python.sync_playwright import Axe

from skyline_viz.cli import main
from skyline_viz.command_line.inputs import collect
from skyline_viz.commands.gallery import build
from skyline_viz.gallery.flag_page import flag_page
from skyline_viz.gallery.flags import Change, Flag, change_flags, read_flags
from skyline_viz.gallery.store import Gallery
from testing import SAMPLES
from testing.detections import WITHOUT_SKY
from testing.programs.browser import chromium, hold

NAMES = ["hazy-1", "spires-5", "rover-2"]  # the worst first


@pytest.fixture(scope="module")
def browser():
    with chromium() as browser:
        yield browser


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    folder = tmp_path_factory.mktemp("photos")
    for kind, ending in (("images", ".jpg"), ("masks", ".png")):
        (folder / kind).mkdir()
        for name in NAMES:
            source = SAMPLES / kind / f"{name}{ending}"
            (folder / kind / source.name).write_bytes(source.read_bytes())
    gallery = folder / "gallery"
    detector = WITHOUT_SKY  # whose worst photos no other sky model changes
    return gallery, build(gallery, collect([folder]), detector, workers=1)[0]


@pytest.fixture
def gallery(built):
    (built[0] / "flags.json").unlink(missing_ok=True)
    return built[0]


@pytest.fixture
def address(built, gallery):
    with flag_page(Gallery(gallery), built[1]) as address:
        yield address


@pytest.fixture
def window(browser, address):
    """Opens windows; none of them may have logged an error or contacted another server."""
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    errors, asked = [], []
    context.on("request", lambda request: asked.append(request.url))

    def opened():
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on("console", lambda one: one.type == "error" and heard(one.text))
        page.goto(address)
        saved(page)
        return page

    def heard(text):
        if "Failed to load resource" not in text:  # of requests that are refused
            errors.append(text)

    yield opened
    context.close()
    assert errors == []
    assert {url for url in asked if not url.startswith((address, "data:"))} == set()


def saved(page):
    page.locator("#saving[data-state=saved]").wait_for()


def card(page, name):
    return page.locator("article", has=page.locator("h2", has_text=name))


def test_the_worst_come_first_with_a_picture_and_a_verdict(window, built):
    page, entries = window(), built[1]
    assert page.locator("h2").all_inner_texts() == NAMES
    said = f"A_err {entries[0].verdict.a_err:.2f} px · {entries[0].cause}"
    assert card(page, "hazy-1").locator(".verdict").inner_text() == said
    assert page.evaluate("[...document.images].every((one) => one.complete && one.naturalWidth)")
    assert page.locator("#count").inner_text() == "0 of 3 reviewed"


def test_a_flag_and_a_comment_are_kept_and_listed(window, gallery, capsys):
    page = window()
    card(page, "spires-5").locator("input").check()
    card(page, "rover-2").locator("textarea").fill("föhn & <b>haze</b>")
    card(page, "rover-2").locator("textarea").press("Enter")
    saved(page)
    assert read_flags(gallery) == {
        "spires-5": Flag(True),
        "rover-2": Flag(comment="föhn & <b>haze</b>"),
    }
    page.reload()
    saved(page)
    assert card(page, "spires-5").locator("input").is_checked()
    assert card(page, "rover-2").locator("textarea").input_value() == "föhn & <b>haze</b>"
    assert page.locator("#count").inner_text() == "1 of 3 reviewed"
    capsys.readouterr()
    assert main(["gallery", "--out", str(gallery), "--list-flags"]) == 0
    assert capsys.readouterr().out == "rover-2\t0\tföhn & <b>haze</b>\nspires-5\t1\t\n"
    card(page, "spires-5").locator("input").uncheck()
    card(page, "rover-2").locator("textarea").fill("")  # nothing ends it but time
    page.locator("#saving[data-state=saving]").wait_for()
    saved(page)
    assert read_flags(gallery) == {}


def test_keys_do_everything(window, gallery):
    page = window()
    for key in ("j", "j", "r", "c"):
        page.keyboard.press(key)
    page.keyboard.type("jrk")  # are letters now
    page.keyboard.press("Shift+Enter")
    page.keyboard.type("two")
    for key in ("Enter", "k", "r", "r", "r"):
        page.keyboard.press(key)
    saved(page)
    assert read_flags(gallery) == {"spires-5": Flag(True, "jrk\ntwo"), "hazy-1": Flag(True)}


def test_two_windows_do_not_overwrite_each_other(window, gallery):
    one, two = window(), window()
    field = card(one, "hazy-1").locator("textarea")
    field.fill("first")
    field.press("Enter")
    saved(one)
    other = card(two, "hazy-1").locator("textarea")
    other.fill("second")
    other.press("Enter")
    two.locator("#saving[data-state=unsaved]").wait_for()
    assert "says “first” now" in card(two, "hazy-1").locator(".trouble").inner_text()
    assert read_flags(gallery)["hazy-1"].comment == "first"
    other.press("Enter")
    saved(two)
    assert card(two, "hazy-1").locator(".trouble").is_hidden()
    assert read_flags(gallery)["hazy-1"].comment == "second"
    card(two, "rover-2").locator("input").check()
    saved(two)
    one.evaluate("window.dispatchEvent(new Event('focus'))")
    one.locator("#count", has_text="1 of 3").wait_for()
    assert field.input_value() == "second"


def test_what_is_said_while_the_server_is_away_is_sent_when_it_is_back(window, gallery):
    page = window()
    page.route("**/flags/**", lambda route: route.abort())
    card(page, "hazy-1").locator("input").check()
    page.locator("#saving", has_text="Not saved: the server does not answer").wait_for()
    assert read_flags(gallery) == {}
    page.unroute("**/flags/**")
    saved(page)
    assert read_flags(gallery) == {"hazy-1": Flag(True)}


def test_an_answer_that_was_lost_is_asked_for_again(window, gallery):
    page = window()
    lost = []

    def lose(route):
        route.fetch()  # it is done, and nobody hears of it
        lost.append(route.abort())

    page.route("**/flags/**", lose, times=1)
    field = card(page, "hazy-1").locator("textarea")
    field.fill("heard once")
    field.press("Enter")
    saved(page)
    assert len(lost) == 1
    assert read_flags(gallery) == {"hazy-1": Flag(comment="heard once")}


def test_all_is_saved_only_when_nothing_is_on_its_way(window, gallery):
    page = window()
    held = hold(page, "**/flags/hazy-1")
    card(page, "hazy-1").locator("input").check()
    card(page, "hazy-1").locator("input").uncheck()  # taken back, and yet on its way
    with page.expect_response("**/flags/rover-2"):
        card(page, "rover-2").locator("input").check()
    page.evaluate("fetch('photos').then((answer) => answer.json())")  # the answer is dealt with
    assert page.locator("#saving").get_attribute("data-state") == "saving"
    held[0].continue_()
    saved(page)
    assert read_flags(gallery) == {"rover-2": Flag(True)}


def test_what_cannot_be_saved_is_said(window, gallery):
    page = window()
    (gallery / "flags.json").write_text("damaged")
    card(page, "hazy-1").locator("input").check()
    page.locator("#saving", has_text="Not all is saved").wait_for()
    assert "flags.json is damaged" in card(page, "hazy-1").locator(".trouble").inner_text()
    assert (gallery / "flags.json").read_text() == "damaged"


def test_photos_are_chosen_by_what_was_said(window, gallery):
    change_flags(gallery, {"hazy-1": Change(True), "rover-2": Change(comment="x")})
    page = window()
    for shown, expected in (
        ("open", ["spires-5", "rover-2"]),
        ("reviewed", ["hazy-1"]),
        ("commented", ["rover-2"]),
        ("all", NAMES),
    ):
        page.locator("#shown").select_option(shown)
        visible = page.locator("article:visible h2").all_text_contents()
        assert visible == expected
    change_flags(gallery, {"rover-2": Change(comment="")})
    page.reload()
    saved(page)
    page.locator("#shown").select_option("commented")
    assert page.locator("#nothing").is_visible()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing(window, gallery, scheme):
    change_flags(gallery, {"hazy-1": Change(True, "x")})
    page = window()
    page.emulate_media(color_scheme=scheme)
    card(page, "rover-2").locator("input").focus()
    found = Axe().run(page).response["violations"]
    assert [(one["id"], [node["target"] for node in one["nodes"]]) for one in found] == []
