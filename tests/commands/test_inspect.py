"""``skyline-viz inspect`` and ``gallery`` on the command line, without a viewer."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.viewer import entities
from testing.programs.commands import write_flat
from testing.recordings import Read, verify

PHOTO = "hills/images/h0.png"


@pytest.fixture
def hills(tmp_path):
    return write_flat(tmp_path / "hills", 5)


def test_without_a_display_it_says_what_to_do(say, hills):
    status, out, err = say("inspect", hills)
    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    for way in ("--save", "--serve", "--screenshot"):
        assert way in err


def test_a_photo_is_kept_in_full(say, hills, tmp_path):
    photo = hills / "images" / "h3.png"
    truth = hills / "masks" / "h3.csv"
    status, out, err = say("inspect", photo, "--truth", truth, "--save", "out/a.rrd")
    assert (status, err) == (0, "")
    assert "A_err 2.00 px" in out
    assert "\nRight: no column is off by more than 4 px.\n" in out
    verify(tmp_path / "out" / "a.rrd")
    read = Read(tmp_path / "out" / "a.rrd")
    assert np.array_equal(read.picture(entities.PHOTO), sv.read_photo(photo))
    assert {"Pixel", "Filter bank", "Columns"} <= read.view_names
    assert f"{entities.BANK_CHOSEN}/path" in read.entities()
    assert {entities.pixel_of(line) + "/patch" for line in ("path", "truth")} <= read.entities()


def test_a_truth_that_is_visible_nowhere_is_not_diagnosed(say, hills):
    photo = hills / "images" / "h3.png"
    width = sv.read_photo(photo).shape[1]
    sv.Skyline(np.zeros(width), np.zeros(width, bool)).write_csv(hills / "nowhere.csv")
    words = ("--truth", hills / "nowhere.csv", "--headless")
    status, out, err = say("inspect", photo, *words)
    assert (status, err) == (0, "")
    assert "Right" not in out


def test_a_data_set_is_one_recording_with_a_step_a_photo(say, hills, tmp_path):
    status, out, _ = say("inspect", hills, "--save", "a.rrd")
    assert status == 0
    assert out.count("A_err") == 5
    verify(tmp_path / "a.rrd")
    read = Read(tmp_path / "a.rrd")
    errors = [one.as_py()[0] for one in read.all("metrics/a_err", "scalars")]
    assert sorted(errors) == pytest.approx([0, 1, 1, 2, 3])
    assert "Photos" in read.view_names
    steps = {one.as_py() for one in read.values["metrics/a_err", entities.IMAGE]}
    assert steps == set(range(5))


def test_or_one_recording_a_photo(say, hills, tmp_path):
    assert say("inspect", hills, "--split", "--save", "out")[0] == 0
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        f"h{number}.rrd" for number in range(5)
    ]


def test_a_second_detector_beside_the_first(say, hills, tmp_path):
    photo = hills / "images" / "h0.png"
    assert say("inspect", photo, "--method", "default", "paper", "--save", "a.rrd")[0] == 0
    read = Read(tmp_path / "a.rrd")
    assert entities.below(entities.OTHER, entities.SCORE) in read.entities()
    other = sv.Detector(config=sv.DetectorConfig.paper()).detect(sv.read_photo(photo))
    (line,) = read.last(entities.ALTERNATIVE, "strips").as_py()
    assert np.array_equal(np.array(line)[:, 1], other.skyline.rows)
    assert "Compare" in read.view_names


def test_a_sweep_has_a_timeline_a_setting_on_which_everything_is_seen(say, hills, tmp_path):
    truth = hills / "masks" / "h0.csv"
    status, out, err = say("inspect", PHOTO, "--truth", truth, "--sweep", "--save", "a.rrd")
    assert (status, err) == (0, "")
    assert out.count("--sweep-training") == 1
    verify(tmp_path / "a.rrd")
    read = Read(tmp_path / "a.rrd")
    assert "Sweep" in read.view_names
    for entity in (entities.PHOTO, entities.COST, entities.PATH, entities.TRUTH, entities.ERRORS):
        for timeline in ("canny_thresholds", "v", "delta", "link_weight", entities.COLUMN):
            assert (entity, timeline) in read.values
    assert not any(timeline == "filter_size" for _, timeline in read.values)


def test_filters_of_other_sizes_are_learned_without_the_photo(say, hills, tmp_path):
    photo = hills / "images" / ".." / "images" / "h0.png"
    words = ["--sweep", "--sweep-training", hills, "--save", "a.rrd"]
    status, out, _ = say("inspect", photo, *words)
    assert status == 0
    assert "--sweep-training" not in out
    read = Read(tmp_path / "a.rrd")
    steps = {one.as_py() for one in read.values[entities.SWEEP_PATH, "filter_size"]}
    assert steps == {0, 3, 5, 7, 9, 11, 13, 15}  # it opens at 0, with what it is now
    reports = [one.as_py()[0] for one in read.all(entities.SWEEP_REPORT, "text")]
    assert any("the same 4 photos of hills, without this one" in one for one in reports)


def test_there_has_to_be_another_photo_to_learn_from(say, hills):
    for number in range(1, 5):
        (hills / "images" / f"h{number}.png").unlink()
    words = ["--sweep", "--sweep-training", hills, "--headless"]
    status, _, err = say("inspect", PHOTO, *words)
    assert status == 2
    assert "no photo with a truth but h0 itself" in err


def test_a_bad_photo_does_not_stop_the_others(say, hills, tmp_path):
    (hills / "images" / "h1.png").write_bytes(b"no photo")
    status, out, err = say("inspect", hills, "--headless")
    assert status == 1
    assert "h1.png" in err
    assert "1 recording made" in out


def test_nothing_is_written_when_no_photo_can_be_read(say, tmp_path):
    status, _, err = say("inspect", "gone.jpg", "--save", "a.rrd")
    assert status == 1
    assert "gone.jpg" in err
    assert not (tmp_path / "a.rrd").exists()


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["inspect"], "which photos"),
        (["inspect", "hills", "--save", "a.rrd", "--serve"], "exclude each other"),
        (["inspect", "hills", "--truth", "x.csv", "--headless"], "belongs to one photo"),
        (["inspect", "hills", "--screenshot", "a.gif"], "end in .png or .jpg"),
        (["inspect", "hills", "--headless", "--method", "gone.npz"], "gone.npz does not exist"),
        (["inspect", PHOTO, "--headless", "--sweep", "--method", "edges"], "not edges."),
        (["inspect", PHOTO, "--headless", "--method", "paper", "paper"], "is named twice"),
        (["inspect", "hills", "--sweep", "--headless"], "--sweep belongs to one photo, and there"),
        (["inspect", PHOTO, "--sweep-training", "hills", "--headless"], "not asked for"),
        (["inspect", PHOTO, "--sweep", "--sweep-training", "x", "--headless"], "x does not exist"),
        (["gallery"], "which data set"),
        (["gallery", "--list-flags", "--out", "nowhere"], "nowhere is no gallery"),
        (["gallery", "hills", "--serve", "--screenshot", "a.png"], "exclude each other"),
        (["gallery", "hills", "--screenshot", "a.gif"], "end in .png or .jpg"),
    ],
)
@pytest.mark.usefixtures("hills")
def test_what_makes_no_sense_is_one_sentence(say, words, reason):
    status, out, err = say(*words)
    assert (status, out) == (2, "")
    assert reason in err
    assert err.count("\n") == 1


def test_a_viewer_that_does_not_answer(say, hills):
    photo = hills / "images" / "h0.png"
    address = "rerun+http://127.0.0.1:9/proxy"
    status, _, err = say("inspect", photo, "--connect", address)
    assert status == 1
    assert f"no viewer answers at {address}" in err
