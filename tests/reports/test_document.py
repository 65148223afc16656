"""The page: whole, by itself, and the same whatever photos are called."""

import base64
import hashlib
import re
from collections import Counter
from dataclasses import replace
from html.parser import HTMLParser

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz import __version__
from skyline_viz.reports import Report, page, write_report
from skyline_viz.reports.document import MOST_STAGES
from skyline_viz.running.batch import Failure
from skyline_viz.system.names import printable
from testing.detections import result

ODD = ["<script>alert(1)</script>", '"><img src=x onerror=x>', "{{ 7 * 7 }}", "a\udcfcb\x1b[31m"]


class Read(HTMLParser):
    """What a browser makes of a page: its elements, cards and texts."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.cards, self.parts, self.within = Counter(), [], {}, ""
        self.addresses, self.policy, self.said = set(), "", []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.tags[tag] += 1
        self.within = tag
        self.addresses |= {values[one] for one in ("src", "href") if one in values}
        assert not any(name.startswith("on") or name == "style" for name in values)
        if tag == "article":
            self.cards.append(values)
        if values.get("http-equiv") == "Content-Security-Policy":
            self.policy = values["content"]

    def handle_data(self, data):
        if self.within in ("style", "script"):
            self.parts[self.within] = self.parts.get(self.within, "") + data
        self.said.append(data)

    def handle_endtag(self, tag):
        self.within = ""


@pytest.fixture(scope="module")
def three(hazy, flat, blind):
    return Report("set", [flat, blind, hazy], "default", notes=["One thing."])


def test_the_worst_photo_comes_first_and_what_has_no_truth_last(three):
    read = Read(page(three))
    assert [one["data-name"] for one in read.cards] == ["hazy", "flat", "blind"]
    assert read.cards[2]["data-error"] == ""
    assert "One thing." in read.said
    assert __version__ in page(three)


def test_the_legend_names_no_line_that_is_nowhere(three, blind):
    assert "with the best remedy" in page(three)
    assert "with the best remedy" not in page(Report("set", [blind], "default"))


def test_nothing_is_asked_for_from_anywhere(three):
    read = Read(page(three))
    assert {one for one in read.addresses if not one.startswith(("data:", "#"))} == set()
    assert read.tags["script"] == read.tags["style"] == 1
    for kind in ("script", "style"):
        digest = base64.b64encode(hashlib.sha256(read.parts[kind].encode()).digest()).decode()
        assert f"{kind}-src 'sha256-{digest}'" in read.policy
    assert read.policy.startswith("default-src 'none'; img-src data:;")


def test_a_lost_photo_says_why_and_what_to_add(three, hazy):
    text = page(three)
    assert hazy.segments[0].title in text
    assert f'data-text="{hazy.remedy.flags}"' in text
    assert f'd="{hazy.mended}"' in text
    assert "What would help, tried on all photos" in text


@pytest.mark.parametrize("name", ODD)
def test_odd_names_are_text(hazy, name):
    plain = Read(page(Report("a", [hazy, replace(hazy, name="b")])))
    odd = replace(hazy, name=name, method=name, about=(name,))
    report = Report(name, [odd, replace(odd, name=f"{name}2")], name, notes=[name])
    read = Read(page(report))
    assert read.tags == plain.tags + Counter(p=2)  # how it was tested, and the note
    assert read.cards[0]["data-name"] == printable(name)


@given(st.text(st.characters(exclude_categories=[]), max_size=30))
def test_any_name_of_a_failure_is_text(name):
    read = Read(page(Report("a", [], failures=[Failure(name, "it is gone")])))
    assert read.tags["li"] == 1
    assert read.tags["script"] == 1
    assert printable(str(Failure(name, "it is gone"))) in "".join(read.said)


def test_photos_that_failed_are_named_and_all_may_fail(tmp_path):
    report = Report("set", [], failures=[Failure("a.jpg", "it is damaged")])
    write_report(tmp_path / "r.html", report)
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "a.jpg: it is damaged." in text
    assert "No photo could be worked on." in text


def test_one_photo_has_neither_table_nor_controls(hazy):
    read = Read(page(Report("hazy", [hazy])))
    assert read.tags["form"] == 0
    assert read.tags["details"] == (len(hazy.segments) > 3)
    assert len(read.cards) == 1


def test_several_methods_are_told_on_each_card(hazy, flat):
    both = {name: [result("hazy", 5.0), result("flat", 7.25)] for name in (hazy.method, "other")}
    text = page(Report("set", [hazy, flat], results=both))
    assert "other: A_err 7.25 px" in text
    assert f"{hazy.method}: A_err" not in text


def test_of_many_photos_the_stages_of_the_worst_stay_and_that_is_said(hazy):
    photos = [replace(hazy, name=f"p{number}") for number in range(MOST_STAGES + 2)]
    text = page(Report("set", photos))
    assert len(re.findall('<div class="stages">', text)) == MOST_STAGES
    assert f"The stages of the first {MOST_STAGES} photos are in this file" in text


def test_forty_photos_can_be_mailed(hazy):
    photos = [replace(hazy, name=f"p{number}") for number in range(40)]
    assert len(page(Report("set", photos)).encode()) < 5_000_000


def test_a_report_is_the_same_every_time(three):
    assert page(three) == page(three)
