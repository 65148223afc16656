"""A real browser on the labelling page."""

import re
import shutil
from contextlib import contextmanager

from playwright.sync_api import sync_playwright

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = ["--no-sandbox"]


@contextmanager
def chromium(flags=()):
    """The system's Chromium, or Playwright's own where there is none."""
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=[*FLAGS, *flags])
        yield browser
        browser.close()


@contextmanager
def windows_on(browser, file, allowed):
    """Opens a file in windows, which log no error and ask for nothing but what is allowed."""
    errors, asked, contexts = [], [], []

    def opened(**how):
        context = browser.new_context(viewport={"width": 1280, "height": 800}, **how)
        contexts.append(context)
        context.on("request", lambda request: asked.append(request.url))
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on("console", lambda one: errors.append(one.text) if one.type == "error" else None)
        page.goto(file.as_uri())
        return page

    yield opened
    for context in contexts:
        context.close()
    assert errors == []
    assert file.as_uri() in asked
    assert [url for url in asked if not (url.startswith("data:") or allowed(url))] == []


def hold(page, address):
    """
    Keep the next request to an address on its way; the list gets its route, to be answered later.

    The rule stays, and lets what follows pass: a rule that ends with its first request ends the
    interception of the browser as well, which then sends what is held.
    """
    held = []

    def keep(route):
        if held:
            route.fallback()
        else:
            held.append(route)

    page.route(address, keep)
    return held


class Page:
    """The labelling page as a person uses it."""

    def __init__(self, browser, client, **context):
        context = {"viewport": {"width": 1440, "height": 900}, **context}
        self.context = browser.new_context(**context)
        self.client = client
        self.page = self.context.new_page()
        self.errors = []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("console", self._heard)
        self.open()
        self.page.locator("#first-dialog button.primary").click()
        self.page.locator("#first-dialog").wait_for(state="hidden")
        self.page.locator("#lines:focus").wait_for()  # which is told a moment later

    def _heard(self, message):
        if message.type == "error" and "Failed to load resource" not in message.text:
            self.errors.append(message.text)

    @property
    def address(self):
        """What a server prints."""
        return self.client.address

    def open(self):
        """Go to the page, or load it again."""
        self.page.goto(self.address)
        self.wait_for_photo()

    def wait_for_photo(self):
        self.page.locator("#accept:enabled").wait_for()
        self.saved()

    def shows(self, name):
        """Wait until a photo is shown; while it is on its way, an ellipsis follows its name."""
        self.page.locator("#name", has_text=re.compile(f"{re.escape(name)}[^…]*$")).wait_for()

    def close(self):
        self.context.close()
        assert self.errors == []

    def document(self, photo=1):
        """What the server knows."""
        return self.client.get(f"/api/photos/{photo}").json()

    def saved(self):
        """Wait until everything is acknowledged."""
        self.page.locator("#saving[data-state=saved]").wait_for(timeout=20_000)
        self.page.wait_for_timeout(50)

    def says(self, text):
        """Wait until the page says something."""
        self.page.locator("#said", has_text=text).wait_for(timeout=10_000)

    def at(self, column, row):
        """Where a pixel is on the screen, while the whole photo is shown."""
        shown = self.document(
            int(self.page.locator("[aria-selected=true]").get_attribute("data-photo"))
        )
        return self.place(column, row, shown)

    def place(self, column, row, shown):
        """Where a pixel of a photo of some width and height is on the screen."""
        box = self.page.locator("#lines").bounding_box()
        scale = min(box["width"] / shown["width"], box["height"] / shown["height"])
        left = box["x"] + (box["width"] - shown["width"] * scale) / 2
        top = box["y"] + (box["height"] - shown["height"] * scale) / 2
        return left + (column + 0.5) * scale, top + row * scale

    def click(self, column, row, **how):
        """Click a pixel, after moving there."""
        x, y = self.at(column, row)
        self.page.mouse.move(x, y)
        self.page.wait_for_timeout(80)
        self.page.mouse.click(x, y, **how)
        self.saved()

    def drag(self, *pixels):
        """Press at the first pixel, move through the others, and let go at the last."""
        places = [self.at(*pixel) for pixel in pixels]
        self.page.mouse.move(*places[0])
        self.page.mouse.down()
        for place in places[1:]:
            self.page.mouse.move(*place, steps=8)
        self.page.mouse.up()
        self.saved()

    def keys(self, *keys):
        """Press keys, one after another."""
        for key in keys:
            self.page.keyboard.press(key)
        self.saved()
