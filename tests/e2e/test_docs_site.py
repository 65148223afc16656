"""The docs in a real browser, opened from the file system."""

import os
import subprocess
import sys

import pytest

from testing import ROOT
from testing.programs.browser import chromium


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    site = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", site]
    quiet = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    said = subprocess.run(command, cwd=ROOT, env=quiet, capture_output=True, text=True, check=True)
    assert said.stdout + said.stderr == ""
    return site


@pytest.fixture
def page(site):
    with chromium() as browser:
        page = browser.new_page(color_scheme="light")
        asked, errors = [], []
        page.on("request", lambda request: asked.append(request.url))
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto((site / "index.html").as_uri())
        yield page
        assert not [url for url in asked if not url.startswith(("file:", "data:", "blob:"))]
        assert errors == []


def test_the_site_is_read_searched_and_darkened_without_a_network(page):
    background = "getComputedStyle(document.body).backgroundColor"
    light = page.evaluate(background)
    page.locator("form[data-md-component=palette] label:visible").click()
    page.wait_for_function(f"{background} !== '{light}'")
    page.locator(".md-nav__link", has_text="Method").last.click()
    page.locator("math[display=block]").first.wait_for()
    page.locator("input.md-search__input").click()
    page.keyboard.type("structure tensor")
    page.locator(".md-search-result__link").first.wait_for()
    page.locator(".md-search-result__link", has_text="Structure tensor").first.click()
    page.locator("h3:visible, h2:visible", has_text="Structure tensor").first.wait_for()
