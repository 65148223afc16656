"""A gallery in the real viewer: cards, what people said about them, the stages."""

import json
import os
import signal
import subprocess
import sys
from urllib.request import Request, urlopen

import numpy as np
import pytest
from PIL import Image

from skyline_viz.cli import main
from skyline_viz.command_line.inputs import collect
from skyline_viz.commands.gallery import PICTURE, build
from skyline_viz.diagnosis.causes import CAUSES
from skyline_viz.gallery.flags import Change, change_flags, read_flags
from skyline_viz.gallery.store import Gallery
from skyline_viz.gallery.table import served
from skyline_viz.viewer.program.process import (
    headless_viewer,
    settled_picture,
    show_tab,
    tab_names,
)
from skyline_viz.viewer.program.rerun_internals import program
from testing import SAMPLES, until
from testing.detections import WITHOUT_SKY
from testing.programs.robot import Robot, listening, viewer_port

NAMES = ["hazy-1", "spires-5", "rover-2"]  # the worst first


@pytest.fixture(scope="module")
def photos(tmp_path_factory):
    folder = tmp_path_factory.mktemp("photos")
    for kind, ending in (("images", ".jpg"), ("masks", ".png")):
        (folder / kind).mkdir()
        for name in NAMES:
            source = SAMPLES / kind / f"{name}{ending}"
            (folder / kind / source.name).write_bytes(source.read_bytes())
    return folder


@pytest.fixture(scope="module")
def built(photos, tmp_path_factory):
    folder = tmp_path_factory.mktemp("gallery")
    detector = WITHOUT_SKY
    entries, failures = build(folder, collect([photos]), detector, workers=1)
    assert failures == []
    return Gallery(folder), entries


def test_cards_tell_what_people_said_and_lead_inside(built):
    files, entries = built
    assert [entry.name for entry in entries] == NAMES
    assert {entry.cause for entry in entries} <= set(CAUSES)
    for entry in entries:
        words = [program(), "rrd", "verify", files.recording(entry.name)]
        subprocess.run(words, check=True, capture_output=True)
    change_flags(files.folder, {"hazy-1": Change(True, "faint ridge")})
    with (
        served(files, entries, truth=True) as gallery,
        headless_viewer([gallery.address], (1280, 1000)) as viewer,
    ):
        cards = np.asarray(settled_picture(viewer))
        assert cards[200:900].std() > 20
        assert {address for _, address, _ in listening()} == {"127.0.0.1"}

        def says(robot, text):
            viewer.take_screenshot()  # a viewer without a screen works only when it draws
            return robot.says(text)

        with Robot(viewer_port()) as robot:
            until(lambda: says(robot, "hazy-1"))
            assert [one for one in NAMES if robot.says(one)] == NAMES
            assert robot.says("faint ridge")
            assert robot.says("1 marked")
            flags = robot.widgets(role="CheckBox", label_contains="Flag")
            assert len(flags) >= 2
            assert all(one.get("disabled") for one in flags)  # they are set elsewhere
            assert not robot.widgets(role="TextInput", label_contains="comment")
            change_flags(files.folder, {"hazy-1": Change(comment="said meanwhile")})
            assert gallery.refresh()
            robot.do("click", role="Button", label_contains="Refresh table")
            until(lambda: says(robot, "said meanwhile"))
            robot.do("click", content_contains="hazy-1", role="Label")
            until(lambda: viewer.get_state().views)
            error = f"{entries[0].verdict.a_err:.2f}"
            until(lambda: says(robot, f"A_err {error}") or says(robot, f"{error} px"))
            assert tab_names(viewer)[-1] == "Diagnosis"
            show_tab(viewer, "Diagnosis")
            until(lambda: says(robot, entries[0].titles[0]))


def test_the_table_follows_what_is_said_while_it_is_served(built):
    files, entries = built
    (files.folder / "flags.json").unlink(missing_ok=True)

    def said(gallery):
        rows = gallery._table.reader().to_arrow_table().to_pylist()
        assert len(rows) == len(NAMES)
        return {one["name"]: (one["reviewed"], one["comment"]) for one in rows}

    with served(files, entries, truth=True) as gallery:
        assert said(gallery) == dict.fromkeys(NAMES, (False, ""))
        assert not gallery.refresh()
        change_flags(files.folder, {"rover-2": Change(True, "later"), "gone": Change(True)})
        assert gallery.refresh()
        expected = dict.fromkeys(NAMES, (False, "")) | {"rover-2": (True, "later")}
        assert said(gallery) == expected
        assert not gallery.refresh()
        change_flags(files.folder, {"rover-2": Change(False, "")})
        assert gallery.refresh()
        assert said(gallery) == dict.fromkeys(NAMES, (False, ""))


def test_one_cause_is_a_filter_of_the_viewer(built):
    files, entries = built
    with (
        served(files, entries, truth=True, cause="too steep") as gallery,
        headless_viewer([gallery.address], (1280, 1000)) as viewer,
    ):
        settled_picture(viewer)
        with Robot(viewer_port()) as robot:
            until(lambda: robot.says("spires-5") and robot.says("rover-2"))
            assert robot.says("too steep")
            assert not robot.says("hazy-1")


def test_a_picture_of_the_cards(photos, tmp_path, capsys):
    words = ["gallery", photos, "--out", tmp_path / "g", "--screenshot", tmp_path / "cards.png"]
    assert main(list(map(str, words))) == 0
    assert "3 photos" in capsys.readouterr().out
    with Image.open(tmp_path / "cards.png") as picture:
        assert picture.size == PICTURE
        assert np.asarray(picture)[200:700].std() > 20


@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM])
def test_a_served_gallery_has_a_page_for_flags_and_ends_politely(photos, tmp_path, ending):
    words = [sys.executable, "-m", "skyline_viz", "gallery", photos, "--out", tmp_path, "--serve"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=os.environ)
    said = iter(process.stdout.readline, "")
    assert next(line for line in said if "rerun+http://127.0.0.1" in line)
    page = next(line for line in said if "Review and comment" in line).split()[-1]
    assert page.startswith("http://127.0.0.1:")
    how = {"Content-Type": "application/json"}
    request = Request(f"{page}flags/hazy-1", b'{"reviewed": true}', how, method="PUT")
    with urlopen(request, timeout=10) as answer:
        assert json.load(answer) == {"reviewed": True, "comment": ""}
    process.send_signal(ending)
    assert process.wait(30) == 0
    process.stdout.close()
    assert [*read_flags(tmp_path)] == ["hazy-1"]
    assert len(json.loads((tmp_path / "gallery.json").read_text())["photos"]) == 3
