"""What the page is told: its legend, and the types that its JavaScript is checked against."""

import re
from typing import get_args

import pytest

from annotate.engine.steering import Ground
from annotate.formats import FORMATS, TITLES
from annotate.store.labels import HIDDEN_BY, STATUSES, TAGS
from annotate.work import images
from skyline_viz import overlay
from skyline_viz.stage import OURS, SCORE
from testing.labelling import served, write_hills
from tools import page_types

STATIC = page_types.PLACE.parent
CODE = [*STATIC.rglob("*.js"), *STATIC.glob("*.css"), STATIC / "index.html"]


def test_the_types_of_the_page_are_those_of_the_server():
    assert page_types.PLACE.read_text("utf-8") == page_types.types(), (
        "run: python -m tools.page_types"
    )


def test_the_legend_says_what_is_defined_elsewhere(tmp_path):
    with served(write_hills(tmp_path, count=1)) as client:
        legend = client.get("/api/legend").json()
    assert tuple(legend["statuses"]) == STATUSES
    assert tuple(legend["tags"]) == TAGS
    assert tuple(legend["hidden_by"]) == HIDDEN_BY
    assert list(legend["stages"]) == [*(one.name for one in OURS), "no edge", "clear sky"]
    assert legend["stages"]["score"] == SCORE.title
    assert {one["name"]: one["says"] for one in legend["formats"]} == TITLES
    assert (legend["tile"], legend["band"]) == (images.TILE, images.BAND)
    assert legend["colours"] == {
        "line": overlay.css(overlay.PATH),
        "preview": overlay.css(overlay.ALTERNATIVE),
        "anchor": overlay.css(overlay.ANCHOR),
        "halo": overlay.css(overlay.HALO),
    }


def test_every_format_has_a_title():
    assert set(TITLES) == set(FORMATS)


@pytest.mark.parametrize("file", CODE, ids=lambda file: file.name)
def test_the_page_says_nothing_twice(file):
    text = file.read_text("utf-8").lower()
    lines = (overlay.PATH, overlay.TRUTH, overlay.ALTERNATIVE)
    assert not [one for one in map(overlay.css, lines) if one in text]
    if file.suffix == ".js":
        words = {*TITLES.values(), *TAGS, *(set(FORMATS) - {"json"}), *(one.name for one in OURS)}
        words -= set(get_args(Ground))  # values of an operation, which the page has to send
        written = set(re.findall(r"[\"'`]([^\"'`\n]*)[\"'`]", text))
        assert not {word.lower() for word in words} & written


def test_the_icon_has_the_colour_of_the_line():
    assert f'stroke="{overlay.css(overlay.PATH)}"' in (STATIC / "icon.svg").read_text("utf-8")
