"""``skyline-viz detect``: what it writes, what it refuses, and what goes on past a fault."""

import csv
import hashlib
import json
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import skyline_viz as sv
from skyline_viz.commands import detect as detect_command
from skyline_viz.overlay import draw_overlay
from skyline_viz.running.photo_table import TABLE
from skyline_viz.sky_model import SkyModel
from testing.detections import NoSky
from testing.programs.commands import HEIGHT, WIDTH, scene, write_scene, write_scenes
from testing.programs.commands import files as all_files


def files(folder):
    """Files of a folder, without what a run says of itself."""
    return [name for name in all_files(folder) if name not in (TABLE, "run.json")]


def test_detect_writes_a_line_for_each_column(say, tmp_path):
    photo = write_scene(tmp_path / "in" / "Eiger.v2.png")
    status, out, err = say("detect", photo, "--out", "out")
    assert (status, err) == (0, "")
    assert re.fullmatch(r"Eiger\.v2 +96x64 +\d+ % sure +\d\.\d{3} s  out/Eiger\.v2\.csv\n", out)
    assert files(tmp_path / "out") == ["Eiger.v2.csv"]
    found = sv.Skyline.read_csv(tmp_path / "out" / "Eiger.v2.csv")
    assert sv.a_err(found, scene(0)[1]) < 2
    assert found == sv.Detector().detect(sv.read_photo(photo)).skyline


def test_detect_writes_what_is_asked_for(say, tmp_path):
    photo = write_scene(tmp_path / "in" / "a.png")
    assert say("detect", photo, "--mask", "--overlay", "--json")[0] == 0
    out = tmp_path / "skylines"
    assert files(out) == ["a-mask.png", "a-overlay.jpg", "a.csv", "a.json"]
    found = sv.Skyline.read_csv(out / "a.csv")
    assert sv.Skyline.read_json(out / "a.json") == found
    mask = np.asarray(Image.open(out / "a-mask.png"))
    np.testing.assert_array_equal(mask, np.where(found.to_mask(HEIGHT), 0, 255))
    overlay = sv.read_photo(out / "a-overlay.jpg").astype(int)
    assert overlay.shape == (HEIGHT, WIDTH, 3)
    line = overlay[found.rows.astype(int), np.arange(WIDTH)]
    assert (line[:, 0] > line[:, 1] + 80).mean() > 0.9  # magenta, as far as JPEG keeps it


def test_a_photo_without_a_skyline_is_said_to_be_one(say, tmp_path, monkeypatch):
    photo = write_scene(tmp_path / "a.png")
    monkeypatch.setattr(SkyModel, "sky", NoSky.sky)
    status, out, err = say("detect", photo, "--out", "out")
    assert (status, err) == (0, "")
    assert "a: No skyline is visible: there seems to be no sky (evidence 0.0" in out
    assert len(out.splitlines()) == 2
    assert not sv.Skyline.read_csv(tmp_path / "out" / "a.csv").visible.any()
    status, out, err = say("detect", photo, "--out", "out", "--preset", "paper")
    assert "visible" not in out
    assert sv.Skyline.read_csv(tmp_path / "out" / "a.csv").visible.all()


def test_detect_takes_the_photos_of_a_data_set(say, hills, tmp_path):
    status, out, _ = say("detect", hills, "--out", "out")
    assert status == 0
    assert files(tmp_path / "out") == ["p0.csv", "p1.csv", "p2.csv", "p3.csv"]
    assert "4 skylines in out" in out


def test_two_processes_find_the_same(say, hills, tmp_path):
    assert say("detect", hills, "--out", "one", "--workers", "1")[0] == 0
    assert say("detect", hills, "--out", "two", "--workers", "2")[0] == 0
    for name in files(tmp_path / "one"):
        assert (tmp_path / "one" / name).read_text() == (tmp_path / "two" / name).read_text()


def test_settings_reach_the_detector(say, hills, monkeypatch):
    seen = []

    def remember(options, detector, photo):
        seen.append((detector.config, detector.bank.provenance.dataset))
        raise sv.PhotoError("enough.")

    monkeypatch.setattr(detect_command, "_detect", remember)
    assert say("train", hills, "--out", "b.npz")[0] == 0
    photo = hills / "images" / "p0.png"
    say("detect", photo, "--bank", "b.npz", "--config.delta", "2")
    say("detect", photo, "--preset", "paper", "--config.v", "0.25")
    say("detect", photo, "--config.no-fit-thresholds")
    assert seen[0] == (sv.DetectorConfig(delta=2), "hills")
    paper = sv.DetectorConfig.paper()
    assert seen[1][0].edge_source == "grey"
    assert (seen[1][0].v, seen[1][0].delta) == (0.25, paper.delta)
    assert seen[2][0] == sv.DetectorConfig(fit_thresholds=False)


def test_bad_photos_are_listed_and_the_others_done(say, tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "torn.jpg").write_bytes(b"\xff\xd8\xff\xe0 and no more")
    (tmp_path / "in" / "empty.png").touch()
    good = write_scene(tmp_path / "in" / "good.png")
    status, out, err = say("detect", "gone.jpg", tmp_path / "in", good, "--out", "out")
    assert status == 1
    assert files(tmp_path / "out") == ["good.csv"]
    assert "good" in out
    told = err.splitlines()
    assert told[0] == "skyline-viz: 3 photos failed:"
    assert "gone.jpg cannot be read: no such file or directory." in told[1]
    assert "empty.png is empty (0 bytes)." in told[2]
    assert "torn.jpg" in told[3]
    assert len(told) == 4


def test_photos_of_the_same_stem_do_not_overwrite_each_other(say, tmp_path):
    photos = [
        write_scene(tmp_path / place, number)
        for number, place in enumerate(["a/x.png", "a/x.jpg", "b/y.png", "c/y.png", "c/z.png"])
    ]
    status, _, err = say("detect", *photos, photos[4], "--out", "out")
    assert status == 0
    assert files(tmp_path / "out") == ["b-y.csv", "c-y.csv", "x.jpg.csv", "x.png.csv", "z.csv"]
    assert "told apart in those of outputs: x.png, x.jpg, b-y, c-y." in err
    found = sv.Skyline.read_csv(tmp_path / "out" / "c-y.csv")
    assert sv.a_err(found, scene(3)[1]) < 2


@pytest.mark.parametrize("out", ["set/images", "set/masks", "set/ground_truth", "set/images/masks"])
def test_skylines_never_become_truth_by_accident(say, tmp_path, out):
    photo = write_scene(tmp_path / "set" / "images" / "a.png")
    status, _, err = say("detect", photo, "--out", out)
    assert status == 2
    assert "would be taken for the truth" in err
    assert files(tmp_path) == ["set/images/a.png"]
    assert say("detect", photo, "--out", "set/found")[0] == 0
    assert sv.open_dataset(tmp_path / "set").items[0].truth() is None


def test_an_output_folder_that_is_a_file(say, tmp_path):
    photo = write_scene(tmp_path / "in" / "a.png")
    (tmp_path / "file").touch()
    for out in ("file", "file/deeper"):
        status, _, err = say("detect", photo, "--out", out)
        assert status == 2
        assert f"the folder {out} cannot be made: " in err


def test_an_output_that_is_a_folder_is_the_failure_of_one_photo(say, tmp_path):
    (tmp_path / "skylines" / "a.csv").mkdir(parents=True)
    photos = [write_scene(tmp_path / "in" / name) for name in ("a.png", "b.png")]
    status, _, err = say("detect", *photos)
    assert status == 1
    assert "is a directory" in err
    assert files(tmp_path / "skylines") == ["b.csv"]


def test_a_full_disk_ends_the_run_with_a_sentence(say, hills, monkeypatch):
    def full(options, detector, photo):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(detect_command, "_detect", full)
    assert say("detect", hills) == (
        1,
        "",
        "skyline-viz: the output cannot be written: no space left on device.\n",
    )


def test_an_interrupt_leaves_no_half_file_and_the_next_run_goes_on(
    say, hills, tmp_path, monkeypatch
):
    write = sv.Skyline.write_csv
    written = []

    def interrupted(skyline, path, margins):
        if path.stem == "p2" and not written.count("p2"):
            written.append("p2")
            path.parent.mkdir(exist_ok=True)
            raise KeyboardInterrupt
        written.append(path.stem)
        write(skyline, path, margins)

    monkeypatch.setattr(sv.Skyline, "write_csv", interrupted)
    words = ("detect", hills, "--out", "out", "--workers", "1")
    status, _, err = say(*words)
    assert status == 130
    assert err == "skyline-viz: interrupted; every file that was written is whole.\n"
    csv_files = [name for name in files(tmp_path / "out") if name.endswith(".csv")]
    assert csv_files == ["p0.csv", "p1.csv"]
    (tmp_path / "out" / "p0.csv").unlink()  # what is gone is made again
    status, out, _ = say(*words)
    assert status == 0
    assert "1 of 4 photos was done already." in out
    assert written == ["p0", "p1", "p2", "p0", "p2", "p3"]
    assert files(tmp_path / "out") == ["p0.csv", "p1.csv", "p2.csv", "p3.csv"]


def test_the_same_photo_gives_the_same_bytes(say, tmp_path):
    photo = write_scene(tmp_path / "in" / "a.png")
    digests = set()
    for out in ("one", "two"):
        say("detect", photo, "--out", out, "--mask", "--overlay")
        whole = b"".join((tmp_path / out / name).read_bytes() for name in files(tmp_path / out))
        digests.add(hashlib.sha256(whole).hexdigest())
    assert len(digests) == 1


def test_detect_says_what_is_wrong_with_a_data_set(say, tmp_path):
    (tmp_path / "set" / "images").mkdir(parents=True)
    (tmp_path / "set" / "masks").mkdir()
    Image.fromarray(np.full((40, 60, 3), 90, np.uint8)).save(tmp_path / "set/images/a.png")
    Image.fromarray(np.full((40, 60), 255, np.uint8)).save(tmp_path / "set/masks/orphan.png")
    status, _, errors = say("detect", tmp_path / "set", "--out", tmp_path / "out")
    assert status == 0
    assert "orphan" in errors


def table(folder):
    with (folder / TABLE).open(newline="") as file:
        return {row["name"]: row for row in csv.DictReader(file)}


def test_detect_says_how_sure_it_is(say, hills, tmp_path):
    (tmp_path / "torn.png").write_bytes(b"torn")
    status, out, _ = say("detect", hills, "torn.png", "--out", "out", "--json")
    assert status == 1
    rows = table(tmp_path / "out")
    assert list(rows) == ["p0", "p1", "p2", "p3", "torn"]
    least = min(["p0", "p1", "p2", "p3"], key=lambda name: float(rows[name]["confidence"]))
    assert re.search(rf"Look at these first:\n  {least} +\d+ % sure, least in columns \d", out)
    assert "torn.png" in rows["torn"]["error"]
    for name in ("p0", "torn"):
        content = Path(rows[name]["file"]).read_bytes()
        assert rows[name]["sha256"] == hashlib.sha256(content).hexdigest()
    found = sv.Detector().detect(sv.read_photo(hills / "images" / "p1.png"))
    assert float(rows["p1"]["confidence"]) == pytest.approx(found.confidence, abs=1e-4)
    assert (rows["p1"]["case"], rows["p1"]["width"]) == (found.visibility.case, str(WIDTH))
    told = np.genfromtxt(tmp_path / "out" / "p1.csv", delimiter=",", names=True)
    np.testing.assert_allclose(told["margin"], found.margins(), rtol=1e-4)
    assert len(json.loads((tmp_path / "out" / "p1.json").read_text())["margins"]) == WIDTH


def test_a_run_is_repeated_from_its_record(say, hills, tmp_path):
    words = ("--config.delta", "2", "--config.v", "0.25")
    assert say("detect", hills, "--out", "one", *words)[0] == 0
    assert say("detect", hills, "--out", "two", "--config", "one/run.json")[0] == 0
    for name in files(tmp_path / "one"):
        assert (tmp_path / "one" / name).read_text() == (tmp_path / "two" / name).read_text()
    told = [json.loads((tmp_path / out / "run.json").read_text()) for out in ("one", "two")]
    assert told[0]["command"][:3] == ["skyline-viz", "detect", str(hills)]
    assert told[0]["digest"] == told[1]["digest"]
    assert told[0]["settings"] == told[1]["settings"]


def test_photos_called_like_what_a_run_writes(say, tmp_path):
    photos = [write_scene(tmp_path / "in" / name) for name in ("skylines.png", "run.png")]
    status, _, err = say("detect", *photos, "--out", "out", "--json")
    assert status == 0
    assert "told apart in those of outputs: skylines-photo, run-photo." in err
    assert set(table(tmp_path / "out")) == {"skylines-photo", "run-photo"}


def test_a_photo_after_the_method_is_a_photo(say, tmp_path):
    photo = write_scene(tmp_path / "in" / "a.png")
    assert say("detect", "--method", "edges", photo, "--out", "out")[0] == 0
    assert files(tmp_path / "out") == ["a.csv"]


def test_an_overlay_shows_the_truth_where_there_is_one(say, hills, tmp_path):
    assert say("detect", hills, "--overlay", "--out", "with")[0] == 0
    photo, truth = scene(0)
    found = sv.Detector().detect(photo).skyline
    picture = sv.read_photo(tmp_path / "with" / "p0-overlay.jpg").astype(int)
    shown, hidden = draw_overlay(photo, found, truth), draw_overlay(photo, found)
    apart = (shown != hidden).any(axis=2)
    assert np.abs(picture - shown)[apart].mean() < np.abs(picture - hidden)[apart].mean() / 2


def test_an_overlay_can_hide_less(say, tmp_path):
    photo = write_scene(tmp_path / "a.png")
    changed = []
    for width in ("0", "1"):
        words = ["--overlay", "--overlay-width", width, "--out", width]
        assert say("detect", photo, *words)[0] == 0
        picture = sv.read_photo(tmp_path / width / "a-overlay.jpg").astype(int)
        changed.append((np.abs(picture - scene(0)[0]).max(axis=2) > 60).sum())
    assert changed[1] < changed[0] / 2


def test_a_truth_that_is_damaged_costs_no_overlay(say, tmp_path):
    own = write_scenes(tmp_path / "own", 1)
    (own / "masks" / "p0.csv").write_text("column,row,visible\n0,x,1\n")
    status, _, err = say("detect", own, "--overlay", "--out", "out")
    assert status == 0
    assert "p0-overlay.jpg is without a truth: " in err
    assert (tmp_path / "out" / "p0-overlay.jpg").is_file()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--overlay-width", "2"], "--overlay-width is that of --overlay, which is not asked for."),
        (["--overlay", "--overlay-width", "-1"], "--overlay-width is from 0 to 100 pixels, not -1"),
    ],
)
def test_widths_of_overlays_that_are_none(say, hills, words, told):
    status, _, err = say("detect", hills, *words)
    assert status == 2
    assert told in err


def test_quiet_prints_nothing_where_all_is_well(say, hills):
    assert say("detect", hills, "--quiet") == (0, "", "")


def test_verbose_names_each_photo_as_it_is_done(say, hills):
    status, _, err = say("detect", hills, "--verbose")
    assert status == 0
    assert re.search(r"^2 of 4 photos after \d+\.\d s: p1$", err, re.MULTILINE)


def test_photos_that_may_show_no_skyline_are_named_at_the_end(say, hills, tmp_path, monkeypatch):
    monkeypatch.setattr(SkyModel, "sky", NoSky.sky)
    status, out, _ = say("detect", hills, "--out", "out", "--quiet")
    assert status == 0
    assert "4 photos may show no skyline, or a part of one: p0, p1, p2, p3\n" in out
