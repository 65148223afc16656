"""The real viewer, without a screen: every tab of a recording, and what it says on hovering."""

import re
import subprocess

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.cli import main
from skyline_viz.diagnosis.explanation import explain_pixel
from skyline_viz.tensor import tensor_map
from skyline_viz.viewer.blueprints import TABS
from skyline_viz.viewer.program.process import (
    headless_viewer,
    settled_picture,
    show_tab,
    tab_names,
)
from skyline_viz.viewer.program.rerun_internals import ViewerError, program
from testing import SAMPLES, until
from testing.programs.robot import Robot, listening, viewer_port

HARMLESS = ("rasterizer", "Docker", "lookup address")  # what a machine without a screen is told


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    file = tmp_path_factory.mktemp("viewer") / "hazy.rrd"
    photo, truth = SAMPLES / "images" / "hazy-1.jpg", SAMPLES / "masks" / "hazy-1.png"
    words = ["inspect", photo, "--truth", truth, "--method", "default", "paper", "--save", file]
    assert main(list(map(str, words))) == 0
    return file


@pytest.fixture(scope="module")
def viewer(recording):
    with headless_viewer([recording]) as client:
        yield client


def test_the_recording_is_whole(recording):
    subprocess.run([program(), "rrd", "verify", recording], check=True, capture_output=True)


def test_it_has_all_tabs(viewer):
    assert tab_names(viewer) == [*TABS, "Diagnosis", "Compare", "Side by side"]


@pytest.mark.parametrize("tab", [*TABS, "Diagnosis", "Compare", "Side by side"])
def test_every_tab_shows_something(viewer, tab):
    show_tab(viewer, tab)
    picture = np.asarray(settled_picture(viewer))
    assert picture.shape == (800, 1280, 3)
    views = picture[100:760]
    left, right = views[:, :640], views[:, 640:]
    for half in (left, right):
        assert half.std() > 10
        assert len(np.unique(half.reshape(-1, 3), axis=0)) > 20


def test_no_view_complains(viewer):
    assert [report for view in viewer.get_state().views for report in view.reports] == []
    logs = [f"{log.level} {log.message}" for log in viewer.get_logs() if log.level != "INFO"]
    assert [log for log in logs if not any(word in log for word in HARMLESS)] == []


def test_an_unknown_tab_is_one_sentence(viewer):
    with pytest.raises(ViewerError, match="no tab called Elsewhere"):
        show_tab(viewer, "Elsewhere")


def test_nothing_listens_beyond_this_machine(viewer):
    assert {address for _, address, _ in listening()} == {"127.0.0.1"}


def test_hovering_a_pixel_tells_its_value_and_unit(viewer):
    strength = tensor_map(sv.read_photo(SAMPLES / "images" / "hazy-1.jpg")).strength
    show_tab(viewer, "Tensor")
    settled_picture(viewer)
    with Robot(viewer_port()) as robot:

        def tooltip():
            robot.do("hover", pos=[320.0, 250.0])
            return robot.says(" grey levels/px"), robot.says(", ")

        said, places = until(lambda: (found := tooltip())[0] and found)
        shown = float(re.fullmatch(r"strength (\S+) grey levels/px", said[0])[1])
        column, row = map(int, next(filter(re.compile(r"\d+, \d+").fullmatch, places)).split(", "))
    assert shown == pytest.approx(strength[row, column], abs=float(strength.max()) / 4000)


def test_the_column_timeline_tells_the_pixel_of_the_path(viewer):
    show_tab(viewer, "Pixel")
    detection = sv.Detector().detect(sv.read_photo(SAMPLES / "images" / "hazy-1.jpg"))
    for column in (100, 700):
        row = int(detection.skyline.rows[column])
        told = explain_pixel(detection, row, column)
        viewer.set_time("column", sequence=column, play_state="paused")
        settled_picture(viewer)
        with Robot(viewer_port()) as robot:
            assert until(lambda robot=robot, column=column: robot.says(f"Column {column}"))
            assert robot.says(str(told.filtered.bin))
            assert robot.says(told.why_edge)


def test_scrubbing_a_setting_moves_the_path(tmp_path):
    file = tmp_path / "sweep.rrd"
    photo, truth = SAMPLES / "images" / "hazy-1.jpg", SAMPLES / "masks" / "hazy-1.png"
    unseen = ("--config.sky-weight", "0")  # else the path is right, and moves little
    words = ["inspect", photo, "--truth", truth, *unseen, "--sweep", "--save", file]
    assert main(list(map(str, words))) == 0
    others = {port for _, _, port in listening()}
    with headless_viewer([file]) as client, Robot(viewer_port(others)) as robot:
        assert tab_names(client) == [*TABS, "Diagnosis", "Sweep"]
        show_tab(client, "Pixel")
        settled_picture(client)
        assert until(lambda: robot.says("the worst one"))  # of the worst column, on any timeline
        show_tab(client, "Sweep")
        assert until(lambda: robot.says("The present settings"))  # it opens with them
        pictures, yellow = [], []
        for setting, at, said in (
            ("canny_thresholds", 40, "Canny thresholds 6 and 26.4"),
            ("canny_thresholds", 100, "Canny thresholds 15 and 66"),
            ("v", 100, "v 1"),
        ):
            client.set_time(setting, sequence=at, play_state="paused")
            assert until(lambda said=said: robot.says(said))
            pictures.append(np.asarray(settled_picture(client))[95:485, 75:775])
            far = np.abs(pictures[-1].astype(int) - (0xFF, 0xD4, 0x00))
            yellow.append((far < 30).all(axis=2).sum())
        assert min(yellow[0], yellow[2]) > 500 > 10 * yellow[1]  # the present path lies on its own
        assert (pictures[0] != pictures[2]).any(axis=2).sum() > 2000
        assert [report for view in client.get_state().views for report in view.reports] == []


def test_a_viewer_that_runs_is_sent_the_recording():
    others = {port for _, _, port in listening()}
    with headless_viewer() as client:
        photo = SAMPLES / "images" / "rover-2.jpg"
        address = f"rerun+http://127.0.0.1:{viewer_port(others)}/proxy"
        assert main(["inspect", str(photo), "--connect", address]) == 0
        assert tab_names(client) == list(TABS)
        assert np.asarray(settled_picture(client)).std() > 20
