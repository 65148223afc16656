"""The server of the page for flags: what it tells, what it takes, and when it says so."""

import json
from dataclasses import replace
from urllib.error import HTTPError
from urllib.request import Request, urlopen

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.datasets.named_item import NamedItem
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.gallery import flag_page as module
from skyline_viz.gallery.entry import Entry
from skyline_viz.gallery.flag_page import POLICY, about, flag_page
from skyline_viz.gallery.flags import Change, Flag, change_flags, read_flags
from skyline_viz.gallery.store import Gallery

NAMES = ["hash#1", "plain"]


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    folder = tmp_path_factory.mktemp("gallery")
    photo = np.full((60, 70, 3), 200, np.uint8)
    photo[30:] = 60
    sv.write_photo(folder / "a.png", photo)
    photos = [NamedItem(name, DatasetItem(name, folder / "a.png")) for name in NAMES]
    gallery = Gallery(folder / "g")
    return gallery, list(gallery.build(photos, sv.Detector(), workers=1))


@pytest.fixture
def page(built):
    gallery, entries = built
    gallery.folder.joinpath("flags.json").unlink(missing_ok=True)
    with flag_page(gallery, entries) as address:
        yield address


def get(address):
    with urlopen(address, timeout=10) as answer:
        return answer.read(), answer.headers


def put(address, body):
    data = body if isinstance(body, bytes) else json.dumps(body).encode()
    how = {"Content-Type": "application/json"}
    try:
        with urlopen(Request(address, data, how, method="PUT"), timeout=10) as answer:
            return answer.status, json.load(answer)
    except HTTPError as error:
        with error:
            return error.code, json.load(error)


def test_photos_come_in_the_order_of_the_gallery_with_all_that_is_said(built, page):
    gallery, entries = built
    change_flags(gallery.folder, {"plain": Change(True, "faint"), "gone": Change(True)})
    told = json.loads(get(f"{page}photos")[0])
    assert told["folder"] == str(gallery.folder)
    assert [one["name"] for one in told["photos"]] == NAMES
    assert [one["flag"]["comment"] for one in told["photos"]] == ["", "faint"]
    for one, entry in zip(told["photos"], entries, strict=True):
        assert (one["verdict"], one["details"]) == about(entry)
        picture = get(f"{page}thumbnails/{one['id']}.jpg")[0]
        assert picture == gallery.thumbnail(entry.name).read_bytes()


@pytest.mark.parametrize("name", ["", "style.css", "flags.js"])
def test_the_page_is_code_of_ours_without_inline_script_or_style(page, name):
    content, headers = get(page + name)
    assert headers["Content-Security-Policy"] == POLICY
    assert b"http:" not in content
    assert b"https:" not in content
    for line in content.splitlines():
        assert b"<script" not in line or b"src=" in line
        assert b" style=" not in line
        assert b"innerHTML" not in line


def test_what_is_answered_is_on_the_disk(built, page):
    gallery, _ = built
    place = json.loads(get(f"{page}photos")[0])["photos"][0]["id"]
    for body, said in (
        ({"reviewed": True}, Flag(True)),
        ({"comment": "faint", "instead_of": ""}, Flag(True, "faint")),
        ({"reviewed": False}, Flag(False, "faint")),
    ):
        assert put(f"{page}flags/{place}", body) == (200, vars(said))
        assert read_flags(gallery.folder) == {"hash#1": said}


def test_another_window_is_not_overwritten(built, page):
    gallery, _ = built
    change_flags(gallery.folder, {"plain": Change(comment="theirs")})
    status, said = put(f"{page}flags/plain", {"comment": "ours", "instead_of": ""})
    assert status == 409
    assert said["now"] == {"reviewed": False, "comment": "theirs"}
    assert "changed elsewhere" in said["detail"]
    assert read_flags(gallery.folder)["plain"].comment == "theirs"


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"\xff",
        b"[" * 50_000,
        [],
        {},
        None,
        {"reviewed": 1},
        {"reviewed": None},
        {"comment": 1},
        {"name": "a"},
        {"reviewed": True, "more": 1},
    ],
)
def test_what_is_no_change_is_refused(built, page, body):
    assert put(f"{page}flags/plain", body) == (400, {"detail": "this is no change of a flag."})
    assert read_flags(built[0].folder) == {}


@pytest.mark.parametrize("name", ["flags/other", "flags/", "flags", "photos", "thumbnails/plain"])
def test_there_is_nothing_else_to_change(page, name):
    assert put(page + name, {"reviewed": True})[0] == 404


@pytest.mark.parametrize("name", ["flags/plain", "thumbnails/../plain.jpg", "thumbnails/x", "x"])
def test_there_is_nothing_else_to_read(page, name):
    with pytest.raises(HTTPError, match="404"):
        get(page + name)


def test_a_comment_that_is_too_long_is_a_sentence(page):
    status, said = put(f"{page}flags/plain", {"comment": "x" * 2001})
    assert (status, said["detail"]) == (422, "a comment has at most 2000 characters.")


def test_a_full_disk_is_a_sentence_and_nothing_is_acknowledged(built, page, monkeypatch):
    def full(folder, changes):
        raise OSError(28, "No space left on device", str(folder / "flags.json"))

    monkeypatch.setattr(module, "change_flags", full)
    status, said = put(f"{page}flags/plain", {"reviewed": True})
    assert status == 507
    assert said["detail"] == f"{built[0].folder / 'flags.json'}: no space left on device."


def test_what_a_detection_came_to_is_said_in_words():
    verdict = Verdict(None, None, None, None, None, 1.234, 7)
    entry = Entry("a", "", "", 60, 70, verdict)
    assert about(entry) == ("", "margin 1.23 at 7 · by default")
    assert about(replace(entry, shows="no sky", confidence=0.1))[0] == "no sky"
    assert about(replace(entry, shows="skyline", confidence=0.9))[0] == ""
    right = replace(entry, verdict=replace(verdict, a_err=0.5, segments=()), causes=())
    assert about(right) == ("A_err 0.50 px", "no column wrong · margin 1.23 at 7 · by default")
    wrong = replace(
        right,
        verdict=replace(right.verdict, segments=((0, 9),)),
        causes=("too steep",),
        compared="paper",
        difference=2.0,
    )
    assert about(wrong) == (
        "2.00 px from paper · A_err 0.50 px · too steep",
        "wrong 0 to 9 · margin 1.23 at 7 · by default",
    )
    turned = replace(wrong, other_a_err=3.0, parts_at="edges, column 7", turned_by="sky")
    assert about(turned) == (
        "2.00 px from paper · A_err +2.50 px by it · A_err 0.50 px · too steep",
        "wrong 0 to 9 · part at edges, column 7, turned by sky · margin 1.23 at 7 · by default",
    )
