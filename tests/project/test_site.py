"""The docs as a site: whole, readable from the file system, and in contact with no other host."""

import logging
import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from mkdocs.commands.build import build
from mkdocs.config import load_config
from mkdocs.exceptions import Abort

import annotate
import skyline_viz
from testing import ROOT

OUTSIDE = re.compile(r"^(?:[a-z]+:)?//", re.IGNORECASE)


class Loaded(HTMLParser):
    """What a page loads by itself, and the anchors that it has."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.addresses: list[str] = []
        self.ids: set[str] = set()
        self.styles = re.findall(r"<style[^>]*>(.*?)</style>", page, re.DOTALL)
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.ids.add(found.get("id"))
        self.addresses += [found[name] for name in ("src", "srcset", "poster") if name in found]
        kinds = set((found.get("rel") or "").split())
        if tag == "link" and not kinds <= {"next", "prev", "canonical"}:
            self.addresses.append(found["href"])


def built(site: Path, **settings: object) -> Path:
    """Build the site as `make docs` does; warnings are errors."""
    config = load_config(str(ROOT / "mkdocs.yml"), site_dir=str(site), strict=True, **settings)
    config.plugins.on_startup(command="build", dirty=False)
    build(config)
    return site


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    return built(tmp_path_factory.mktemp("site"))


@pytest.fixture(scope="module")
def pages(site):
    return {page: Loaded(page.read_text()) for page in site.rglob("*.html")}


def test_pages_load_nothing_from_another_host(site, pages):
    assert len(pages) > 20
    for page, loaded in pages.items():
        assert loaded.addresses
        assert not [one for one in loaded.addresses if OUTSIDE.match(one)], page
    styles = [file.read_text() for file in site.rglob("*.css")]
    styles += [style for loaded in pages.values() for style in loaded.styles]
    for style in styles:
        for address in re.findall(r"(?:url\(|@import)\s*[\"']?([^\"')\s]+)", style):
            assert not OUTSIDE.match(address), address


def test_what_pages_load_is_there(pages):
    for page, loaded in pages.items():
        for address in loaded.addresses:
            if page.name != "404.html" and not address.startswith(("data:", "#")):
                assert (page.parent / address).exists(), (page, address)


@pytest.mark.parametrize(
    "name",
    [f"skyline_viz.{name}" for name in skyline_viz.__all__ if name != "__version__"]
    + [f"annotate.{name}" for name in annotate.__all__],
)
def test_every_public_name_is_in_the_reference(pages, name):
    assert any(name in loaded.ids for page, loaded in pages.items() if page.parent.name == "api")


def test_examples_are_drawn_as_code(site):
    for page in (site / "api").glob("*.html"):
        assert "<blockquote>" not in page.read_text(), page  # >>> outside of a section Examples


@pytest.mark.parametrize("page", ["method", "api/stages", "api/detector", "api/evaluation"])
def test_equations_are_drawn_without_a_script(site, page):
    text = (site / f"{page}.html").read_text()
    assert re.search('<math[^>]* display="block"', text)
    assert "$$" not in re.sub(r"<details.*?</details>", "", text, flags=re.DOTALL)  # source code


@pytest.mark.parametrize(
    ("words", "wrong"),
    [
        ("[a page](nowhere.md)", "nowhere.md"),
        ("[a place](other.md#nowhere)", "nowhere"),
        ("![a picture](nowhere.jpg)", "nowhere.jpg"),
        ("[the root](/nowhere.md)", "nowhere.md"),
        ("::: skyline_viz.nothing_of_that_name", "nothing_of_that_name"),
    ],
)
def test_a_broken_link_fails_the_build(tmp_path, caplog, words, wrong):
    docs = tmp_path / "docs"
    docs.mkdir()
    (docs / "index.md").write_text(f"# Start\n\n{words}\n")
    (docs / "other.md").write_text("# Other\n")
    nav = ["index.md", "other.md"]
    with caplog.at_level(logging.WARNING), pytest.raises((Abort, SystemExit)):
        built(tmp_path / "site", docs_dir=str(docs), nav=nav, hooks=[], extra={}, extra_css=[])
    assert wrong in caplog.text
