"""A gallery in the real viewer: cards, a review and a comment that reach the disk, the stages."""

import json
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from skyline_viz.cli import main
from skyline_viz.command_line.inputs import collect
from skyline_viz.commands.gallery import PICTURE, build
from skyline_viz.detector import Detector
from skyline_viz.gallery.hand import ended_edits
from skyline_viz.gallery.store import Flag, Gallery
from skyline_viz.gallery.table import served
from skyline_viz.viewer.process import (
    PROGRAM,
    headless_viewer,
    settled_picture,
    show_tab,
    tab_names,
)
from testing import SAMPLES, until
from testing.robot import Robot, listening, viewer_port

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


def click_flag(robot):
    flag = robot.widgets(role="CheckBox", label_contains="Flag")[-1]
    box = json.loads(robot.do("get_widget", id=flag["id"]))["node"]["bounds"]
    robot.do("click", pos=[box["x"] + box["w"] / 2, box["y"] + box["h"] / 2])


def test_reviewing_commenting_and_looking_inside(photos, tmp_path):
    detector = Detector()
    entries, failures = build(tmp_path, collect([photos]), detector, workers=1)
    assert failures == []
    assert [entry.name for entry in entries] == NAMES
    assert [entry.cause for entry in entries] == ["cheaper path", "too steep", "missed edge"]
    for entry in entries:
        file = Gallery(tmp_path).recording(entry.name)
        subprocess.run([PROGRAM, "rrd", "verify", file], check=True, capture_output=True)
    with (
        served(Gallery(tmp_path), entries, truth=True) as gallery,
        headless_viewer([gallery.address], (1280, 1000)) as viewer,
    ):
        cards = np.asarray(settled_picture(viewer))
        assert cards[200:900].std() > 20
        assert {address for _, address, _ in listening()} == {"127.0.0.1"}

        def saved():
            viewer.take_screenshot()  # a viewer without a screen works only when it draws
            return gallery.save_edits()

        port = viewer_port()
        with Robot(port) as robot:
            until(lambda: len(robot.says("hazy-1")) > 0)
            assert [one for one in NAMES if robot.says(one)] == NAMES
            for change in (1, -1, 1):  # set it, take it back, set it
                with ended_edits(port, lambda: gallery.reviewed):
                    click_flag(robot)
                    until(saved)
                assert gallery.reviewed == max(change, 0)
            (name,) = Gallery(tmp_path).flags()
            assert Gallery(tmp_path).flags() == {name: Flag(reviewed=True)}
            field = robot.widgets(role="TextInput", label_contains="comment")[0]
            robot.do("click", id=field["id"])
            robot.do("type_text", id=field["id"], text="faint ridge")
            robot.do("press_key", key="Enter")
            until(saved)
            said = Gallery(tmp_path).flags()
            assert [one.comment for one in said.values() if one.comment] == ["faint ridge"]
            robot.do("click", content_contains="hazy-1", role="Label")
            until(lambda: viewer.get_state().views)
            until(lambda: robot.says("A_err 132.88") or robot.says("132.88 px"))
            assert tab_names(viewer)[-1] == "Diagnosis"
            show_tab(viewer, "Diagnosis")
            until(lambda: robot.says("cheaper path"))
    again = Gallery(tmp_path).flags()
    assert any(one.reviewed for one in again.values())
    assert any(one.comment == "faint ridge" for one in again.values())


def test_one_cause_and_a_review_while_another_is_hidden(photos, tmp_path):
    detector = Detector()
    entries, _ = build(tmp_path, collect([photos]), detector, workers=1)
    files = Gallery(tmp_path)
    files.save_flags({"hazy-1": Flag(reviewed=True)})
    with (
        served(files, entries, truth=True, cause="too steep") as gallery,
        headless_viewer([gallery.address], (1280, 1000)) as viewer,
    ):
        port = viewer_port()

        def saved():
            viewer.take_screenshot()
            return gallery.save_edits()

        with Robot(port) as robot:
            until(lambda: robot.says("spires-5") and robot.says("rover-2"))
            assert robot.says("too steep")
            assert not robot.says("hazy-1")
            settled_picture(viewer)
            with ended_edits(port, lambda: gallery.reviewed):
                click_flag(robot)
                until(saved)
    reviewed = [name for name, flag in files.flags().items() if flag.reviewed]
    assert len(reviewed) == 2
    assert "hazy-1" in reviewed


def test_a_picture_of_the_cards(photos, tmp_path, capsys):
    words = ["gallery", photos, "--out", tmp_path / "g", "--screenshot", tmp_path / "cards.png"]
    assert main(list(map(str, words))) == 0
    assert "3 photos" in capsys.readouterr().out
    with Image.open(tmp_path / "cards.png") as picture:
        assert picture.size == PICTURE
        assert np.asarray(picture)[200:700].std() > 20


@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM])
def test_a_served_gallery_ends_politely(photos, tmp_path, ending):
    words = [sys.executable, "-m", "skyline_viz", "gallery", photos, "--out", tmp_path, "--serve"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=os.environ)
    said = iter(process.stdout.readline, "")
    assert next(line for line in said if "rerun+http://127.0.0.1" in line)
    process.send_signal(ending)
    assert process.wait(30) == 0
    process.stdout.close()
    assert len(json.loads((tmp_path / "gallery.json").read_text())["photos"]) == 3
