"""The labelling page in a real Chromium: mouse, keyboard alone, touch, and what may go wrong."""

import base64
import io
import zipfile

import cv2
import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe

from annotate.engine.live_wire import LiveWire
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.photo import write_photo
from skyline_viz.skyline import Skyline
from testing.detections import WITHOUT_SKY
from testing.labelling import served, write_hills
from testing.programs.browser import Page

HEIGHT, WIDTH = 240, 400


def peak(faint=True):
    """A ridge with a faint peak, of which the detector takes the strong snow line below it."""
    random = np.random.default_rng(4)
    columns = np.arange(WIDTH)
    ridge = 150 + 8 * np.sin(columns / 40)
    rise = 46 * np.clip(1 - np.abs(columns - 200) / 60, 0, None)
    truth = np.floor(ridge - rise)
    photo = np.full((HEIGHT, WIDTH, 3), 215.0)
    rows = np.arange(HEIGHT)[:, None]
    photo[rows >= truth] = 190 if faint else 90
    photo[rows >= np.floor(ridge)] = 60
    photo += random.normal(0, 2, photo.shape)
    return photo.clip(0, 255).astype(np.uint8), Skyline(rows=truth)


@pytest.fixture
def folder(tmp_path):
    folder = write_hills(tmp_path / "alps", height=HEIGHT, width=WIDTH)
    write_photo(folder / "a-peak.png", peak()[0])
    return folder


@pytest.fixture
def client(folder):
    with served(folder, detector=WITHOUT_SKY) as client:  # for one with it is right at once
        yield client


@pytest.fixture
def page(browser, client):
    page = Page(browser, client)
    yield page
    page.close()


def exported(client, kind="mask", name="masks/a-peak.png"):
    with zipfile.ZipFile(io.BytesIO(client.get(f"/api/exports/{kind}").content)) as archive:
        data = np.frombuffer(archive.read(name), np.uint8)
    return cv2.imdecode(data, cv2.IMREAD_UNCHANGED)


def rows_of(page, photo=1):
    return np.array(page.document(photo)["rows"])


def test_a_wrong_proposal_is_right_after_one_click(page, client):
    photo, truth = peak()
    wire = LiveWire(photo, WITHOUT_SKY)
    before = a_err(wire.skyline, truth)
    row = int(truth.rows[200])
    page.click(200, row)
    after = a_err(Skyline(rows=rows_of(page)), truth)
    assert before > 4
    assert after < 1
    ((column, anchored),) = page.document()["anchors"]
    np.testing.assert_array_equal(rows_of(page), wire.anchor(column, anchored).rows)
    page.keys("Space")
    page.says("a-peak.png is accepted")
    np.testing.assert_array_equal(
        exported(client) == 0, Skyline(rows=rows_of(page)).to_mask(HEIGHT)
    )


def test_a_preview_shows_the_line_before_the_click(page):
    _, truth = peak()
    x, y = page.at(200, int(truth.rows[200]))
    dark = cv2.imdecode(np.frombuffer(page.page.screenshot(), np.uint8), 1)
    page.page.mouse.move(x, y)
    page.page.wait_for_timeout(400)
    shown = cv2.imdecode(np.frombuffer(page.page.screenshot(), np.uint8), 1)

    def yellow(picture):
        blue, green, red = (picture[..., at].astype(int) for at in range(3))
        return ((red > 200) & (green > 160) & (blue < 80)).sum()

    assert yellow(dark) == 0
    assert yellow(shown) > 100
    assert page.document()["revision"] == 0


def test_every_tool_by_mouse_and_undo_across_a_reload(page, client):
    _, truth = peak()
    page.click(200, int(truth.rows[200]))
    page.drag((200, int(truth.rows[200])), (210, int(truth.rows[210])))
    ((column, anchored),) = page.document()["anchors"]
    assert column == 210
    assert abs(anchored - truth.rows[210]) <= 2
    page.keys("b")
    page.drag((300, 150), (330, 150))
    (stroke,) = page.document()["forbidden"]
    inside = rows_of(page)[305:326]
    assert (np.abs(inside - 150) > stroke["radius"]).all()
    page.keys("s")
    page.drag((20, 160), (60, 140))
    page.keys("d")
    page.drag((90, 100), (110, 100), (120, 110))
    page.keys("h")
    page.drag((350, 120), (380, 120))
    now = page.document()
    assert [(span["kind"], span["first"], span["last"]) for span in now["spans"]] == [
        ("straight", 20, 60),
        ("drawn", 90, 120),
    ]
    assert now["hidden"] == [[350, 380, ""]]
    assert now["rows"][20] == 160
    assert now["rows"][60] == 140
    assert set(now["rows"][90:111]) == {100}
    assert now["rows"][120] == 110
    page.open()
    page.keys("u", "u")
    assert page.document()["hidden"] == []
    assert [span["kind"] for span in page.document()["spans"]] == ["straight"]
    page.page.locator("#redo").click()
    page.page.locator("#redo").click()
    page.saved()
    assert page.document()["rows"] == now["rows"]
    page.page.locator("#tags").click()
    page.page.get_by_label("needs terrain data").check()
    page.page.get_by_label("Own tag").fill("glacier")
    page.page.get_by_role("button", name="Add").click()
    page.page.locator("#tags-dialog").get_by_role("button", name="Close").click()
    page.saved()
    assert page.document()["tags"] == ["needs terrain data", "glacier"]
    page.page.locator("#accept").click()
    page.says("is accepted")
    line = Skyline(rows=now["rows"])
    np.testing.assert_array_equal(exported(client) == 0, line.to_mask(HEIGHT))


def test_a_click_snaps_to_the_edge_and_with_shift_lies_just_there(page):
    _, truth = peak()
    row = int(truth.rows[200])
    page.click(200, row - 1)
    ((_, snapped),) = page.document()["anchors"]
    assert abs(snapped - row) <= 1
    page.keys("u")
    assert page.document()["anchors"] == []
    page.page.keyboard.down("Shift")
    page.click(200, row - 20)
    page.page.keyboard.up("Shift")
    assert page.document()["anchors"] == [[200, row - 20]]
    page.keys("u")


def test_all_above_a_stroke_is_sky(page):
    page.keys("5")
    page.drag((100, 200), (200, 205), (300, 200))
    page.says("All above is sky there.")
    ((first, last),) = [
        (one["first"], one["first"] + len(one["rows"]) - 1) for one in page.document()["sides"]
    ]
    assert (rows_of(page)[first : last + 1] >= 199).all()
    page.keys("u")
    assert page.document()["sides"] == []


def test_right_click_removes_an_anchor(page):
    page.click(100, 80)
    assert len(page.document()["anchors"]) == 1
    page.click(100, 80, button="right")
    assert page.document()["anchors"] == []


def test_keyboard_alone_does_the_whole_job(page, client):
    _, truth = peak()
    page.page.locator("#lines").focus()
    page.keys("ArrowRight")
    column, row = 200, int(truth.rows[200])
    start = int(rows_of(page)[column])
    page.keys(*["ArrowUp"] * (start - row), "Enter")
    assert page.document()["anchors"] == [[column, row]]
    page.keys("n")
    page.says("uncertain")
    page.keys("1")
    page.page.locator("#choices").wait_for()
    assert page.document()["guides"] == []
    page.keys("1")
    assert page.document()["guides"] == [[0, WIDTH - 1]]
    page.keys("u", "Escape", "0", "ArrowLeft")
    page.keys(*["Control+ArrowRight"], "m", *["Shift+ArrowRight"] * 3, "k")
    assert page.document()["hidden"] == [[300, 330, ""]]
    page.keys("m", *["Shift+ArrowRight"] * 2, "l")
    (span,) = page.document()["spans"]
    assert (span["kind"], span["first"], span["last"]) == ("straight", 330, 350)
    page.keys("m", "Shift+ArrowRight", "f")
    assert len(page.document()["forbidden"]) == 1
    page.keys("Control+z", "Control+z")
    assert page.document()["spans"] == []
    page.keys("Control+Shift+Z", "Delete")
    assert page.document()["anchors"] == []
    page.keys("u", "t")
    page.keys("Tab", "Space", "Escape")
    page.page.wait_for_timeout(200)
    page.keys("o", "o", "?", "Escape")
    page.page.locator("#lines").focus()
    page.keys("Space")
    page.says("is accepted")
    done = page.document()
    assert done["status"] == "accepted"
    assert len(done["tags"]) == 1
    np.testing.assert_array_equal(exported(client) == 0, Skyline(rows=done["rows"]).to_mask(HEIGHT))
    assert page.page.locator("#name").text_content() == "hill-0.png"
    page.keys("[")
    page.shows("a-peak.png")


def test_touch_alone_does_the_whole_job(browser, client):
    page = Page(browser, client, has_touch=True, viewport={"width": 1024, "height": 768})
    _, truth = peak()
    session = page.context.new_cdp_session(page.page)

    def touch(kind, *places):
        points = [{"x": x, "y": y, "id": at} for at, (x, y) in enumerate(places)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        page.page.wait_for_timeout(40)

    target = page.at(200, int(truth.rows[200]))
    touch("touchStart", (target[0] - 30, target[1] + 30))
    touch("touchMove", target)
    touch("touchEnd")
    page.saved()
    ((column, row),) = page.document()["anchors"]
    assert abs(column - 200) <= 1
    assert abs(row - truth.rows[200]) <= 1
    touch("touchStart", page.at(column, row))
    touch("touchMove", page.at(column + 8, row + 4))
    touch("touchEnd")
    page.saved()
    ((moved, _),) = page.document()["anchors"]
    assert abs(moved - column - 8) <= 1
    before = page.document()
    touch("touchStart", (400, 300), (500, 300))
    touch("touchMove", (300, 300), (600, 300))
    touch("touchEnd")
    assert page.document() == before
    page.page.locator("#fit").tap()
    page.page.get_by_role("radio", name="Hide").tap()
    touch("touchStart", page.at(20, 60))
    touch("touchMove", page.at(50, 60))
    touch("touchEnd")
    page.saved()
    ((first, last, _),) = page.document()["hidden"]
    assert (abs(first - 20) <= 1, abs(last - 50) <= 1) == (True, True)
    page.page.locator("#undo").tap()
    page.saved()
    assert page.document()["hidden"] == []
    page.page.locator("#accept").tap()
    page.says("is accepted")
    np.testing.assert_array_equal(
        exported(client) == 0, Skyline(rows=rows_of(page)).to_mask(HEIGHT)
    )
    page.close()


def test_blind_photos_are_labelled_from_scratch(browser, tmp_path):
    with served(write_hills(tmp_path, height=HEIGHT, width=WIDTH), blind=1.0) as client:
        page = Page(browser, client)
        assert page.page.get_by_text("labelled blind").is_visible()
        page.click(50, 60)
        page.click(150, 100)
        rows = rows_of(page)
        assert rows[[0, 50, 100, 150, 399]].tolist() == [60, 60, 80, 100, 100]
        page.close()


def test_what_is_not_acknowledged_is_said_and_sent_again(page):
    page.context.set_offline(True)
    x, y = page.at(120, 90)
    page.page.mouse.click(x, y)
    page.page.locator("#trouble", has_text="does not answer. 1 edit waits and is sent").wait_for()
    page.page.locator("#saving", has_text="1 not saved").wait_for()
    page.page.mouse.click(x + 60, y)
    page.page.locator("#saving", has_text="2 not saved").wait_for()
    page.context.set_offline(False)
    page.saved()
    assert len(page.document()["anchors"]) == 2
    page.errors.clear()


def test_a_sheet_is_worked_through_by_key(page):
    page.keys("w")
    cards = page.page.locator(".card")
    cards.first.wait_for()
    assert cards.count() == 4
    page.keys("a", "d")
    page.page.wait_for_timeout(300)
    statuses = [photo["status"] for photo in page.client.get("/api/photos").json()["photos"]]
    assert statuses == ["accepted", "rejected", "to do", "to do"]
    page.keys("Enter")
    page.shows("hill-1.png")


def test_search_and_filter(page):
    page.keys("/")
    page.page.keyboard.type("hill-2")
    items = page.page.locator(".item")
    assert items.count() == 1
    items.first.click()
    page.shows("hill-2.png")
    page.page.locator("#search").fill("")
    page.page.locator("#filter").select_option("is:accepted")
    assert items.count() == 0


def test_zooming_in_shows_exact_pixels(browser, tmp_path):
    folder = write_hills(tmp_path, count=1, height=1200, width=2100)
    photo = cv2.imread(str(folder / "hill-0.png"))
    with served(folder) as client:
        page = Page(browser, client)
        tiles = []
        page.page.on("request", lambda asked: "tiles" in asked.url and tiles.append(asked.url))
        page.page.locator("#lines").focus()
        page.keys("Escape", *["+"] * 7)
        page.page.wait_for_timeout(1000)
        assert tiles
        page.page.locator("#lines").evaluate("canvas => canvas.hidden = true")
        picture = page.page.evaluate(
            "() => document.getElementById('photo').toDataURL('image/png').split(',')[1]"
        )
        shown = cv2.imdecode(np.frombuffer(base64.b64decode(picture), np.uint8), 1)
        colours = {tuple(one) for one in shown[::9, ::9].reshape(-1, 3).tolist()}
        whole = {tuple(one) for one in photo.reshape(-1, 3).tolist()}
        assert colours <= whole  # nothing is blended or compressed
        page.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing(browser, client, scheme):
    page = Page(browser, client, color_scheme=scheme)
    axe = Axe()

    def check():
        found = axe.run(page.page).response["violations"]
        assert [(one["id"], [n["target"] for n in one["nodes"]]) for one in found] == []

    check()
    for button, dialog in (
        ("#help", "#help-dialog"),
        ("#tags", "#tags-dialog"),
        ("#guideline", "#guideline-dialog"),
        ("#more", "#more-dialog"),
    ):
        page.page.locator(button).click()
        page.page.locator(f"{dialog}[open]").wait_for()
        check()
        page.page.keyboard.press("Escape")
    page.page.locator("#adjust").click()
    check()
    page.page.locator("#sheet-open").click()
    page.page.locator(".card").first.wait_for()
    page.page.wait_for_timeout(300)
    check()
    page.close()


def test_a_photo_that_vanishes_is_a_sentence(page, folder):
    (folder / "hill-2.png").unlink()
    page.page.locator(".item", has_text="hill-2.png").click()
    page.says("hill-2.png")
    assert page.page.locator("#name").text_content() == "a-peak.png"
    page.click(100, 80)
    assert len(page.document()["anchors"]) == 1
    page.errors.clear()


def test_the_stages_open_in_the_viewer(page):
    page.click(100, 80)
    with page.context.expect_page() as opened:
        page.keys("g")
    viewer = opened.value
    viewer.wait_for_url("http://127.0.0.1:*/**", timeout=60_000)
    assert "rerun" in viewer.content().lower()
    viewer.close()
