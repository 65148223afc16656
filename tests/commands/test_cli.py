"""The commands, run in this process; a few in a process of their own."""

import csv
import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import skyline_viz as sv
from skyline_viz import rendering
from skyline_viz.cli import main
from skyline_viz.command_line.inputs import output_names
from skyline_viz.command_line.methods import described
from skyline_viz.commands import detect as detect_command
from skyline_viz.running import batch

HEIGHT, WIDTH = 64, 96
ROOT = Path(sv.__file__).parents[1]


def scene(number):
    """A photo with texture below a slanting line, and the line."""
    rng = np.random.default_rng(number)
    rows = np.round(20 + number + np.arange(WIDTH) * 0.1 * (number % 3))
    truth = sv.Skyline(rows)
    photo = np.full((HEIGHT, WIDTH, 3), (190, 200, 215), np.uint8)
    terrain = rng.integers(20, 110, (HEIGHT, WIDTH, 1), dtype=np.uint8)
    return np.where(truth.to_mask(HEIGHT)[..., None], photo, terrain), truth


def write_scene(path, number=0):
    sv.write_photo(path, scene(number)[0])
    return path


@pytest.fixture(scope="session")
def hills(tmp_path_factory):
    """A data set of four photos with truth; nobody writes here."""
    root = tmp_path_factory.mktemp("data") / "hills"
    for number in range(4):
        write_scene(root / "images" / f"p{number}.png", number)
        scene(number)[1].write_csv(root / "masks" / f"p{number}.csv")
    return root


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    """Relative outputs land in the test's folder, and no browser opens."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("CI", "1")


@pytest.fixture
def say(capsys):
    """Run a command line; give its status and what it printed on stdout and stderr."""

    def run(*words):
        status = main([str(word) for word in words])
        printed = capsys.readouterr()
        assert "Traceback" not in printed.err
        return status, printed.out, printed.err

    return run


def program(*words, **options):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "skyline_viz", *map(str, words)]
    return subprocess.run(  # noqa: PLW1510  # the status is what is tested
        command, capture_output=True, text=True, env=environment, timeout=120, **options
    )


def files(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


# ---- help, version, usage


def test_help_names_all_commands(say):
    status, out, _ = say("--help")
    assert status == 0
    for command in ("detect", "inspect", "gallery", "train", "evaluate", "render", "demo"):
        assert command in out


@pytest.mark.parametrize("command", ["detect", "gallery", "train", "evaluate", "render", "demo"])
def test_every_command_explains_itself(say, command):
    status, out, _ = say(command, "--help")
    assert status == 0
    assert "--out" in out


def test_the_version(say):
    assert say("--version") == (0, f"skyline-viz {sv.__version__}\n", "")


def test_help_imports_nothing_heavy():
    code = (
        "import sys; from skyline_viz.cli import main; main(['detect', '--help']);"
        "heavy = {'cv2', 'numba', 'matplotlib', 'rich', 'scipy', 'skyline_viz.detector'};"
        "sys.exit(f'{heavy & set(sys.modules)}' if heavy & set(sys.modules) else 0)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        timeout=120,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(
    "words", [[], ["conquer"], ["detect", "a.jpg", "--summit", "1"], ["train", "x"]]
)
def test_usage_errors_end_with_2(say, words):
    status, out, err = say(*words)
    assert status == 2
    assert out == ""
    assert err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["detect"], "which photos?"),
        (["detect", "HILLS", "--config.v", "3"], "v is a number from 0 to 1, not 3.0."),
        (["detect", "HILLS", "--workers", "-1"], "workers is 0 or more"),
        (["detect", "HILLS", "--bank", "gone.npz"], "gone.npz does not exist."),
        (["detect", "HILLS", "--bank", "HILLS/masks/p0.csv"], "not a filter bank"),
        (["detect", "."], ". holds no photograph."),
        (["train", "gone", "--out", "b.npz"], "gone does not exist."),
        (["train", "HILLS", "--out", "."], ". is a folder"),
        (["train", "HILLS", "--out", "b.npz", "--seed", "-3"], "not -3."),
        (["train", "HILLS", "--out", "b.npz", "--training.filter-size", "8"], "filter_size is one"),
        (["train", "HILLS", "--out", "b.npz", "--training.bins.strengths", "0"], "strengths is"),
        (["train", "HILLS/images", "--out", "b.npz"], "images holds no truth for any"),
        (["evaluate", "HILLS", "--folds", "5"], "from 2 to the 4 photos, not 5."),
        (["evaluate", "HILLS", "--folds", "2", "--bank", "b.npz"], "b.npz has learned already"),
        (["evaluate", "HILLS", "--seed", "-1"], "a seed is 0 or more, not -1."),
        (["render", "--seed", "3"], "are for scenes of a --kind."),
        (["render", "--kind", "lunar"], "a scene is one of clear, "),
        (["render", "--kind", "clear", "--count", "0"], "--count is 1 or more, not 0."),
        (["demo", "."], ". holds no photograph."),
    ],
)
def test_bad_input_ends_with_2_and_one_sentence(say, hills, words, told):
    status, _, err = say(*[word.replace("HILLS", str(hills)) for word in words])
    assert status == 2
    assert err.startswith("skyline-viz: ")
    assert err.count("\n") == 1
    assert told in err


# ---- detect


def test_detect_writes_a_line_for_each_column(say, tmp_path):
    photo = write_scene(tmp_path / "in" / "Eiger.v2.png")
    status, out, err = say("detect", photo, "--out", "out")
    assert (status, err) == (0, "")
    assert re.fullmatch(r"Eiger\.v2 +96x64 +\d\.\d{3} s  out/Eiger\.v2\.csv\n", out)
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


@pytest.mark.parametrize(
    ("words", "preset"),
    [
        ("detect a.jpg", "default"),
        ("detect --preset paper a.jpg", "paper"),
        ("detect --preset=paper a.jpg", "paper"),
        ("detect --preset paper --preset default", "default"),
        ("detect --preset", "default"),
        ("detect --preset moon", "default"),
        ("detect paper", "default"),
    ],
)
def test_the_preset_is_known_before_parsing(words, preset):
    assert described(words.split()).config == sv.DetectorConfig.presets()[preset]


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
    assert files(tmp_path / "out") == ["x.jpg.csv", "x.png.csv", "y-2.csv", "y.csv", "z.csv"]
    assert "told apart in the names of outputs: x.png, x.jpg, y-2." in err
    found = sv.Skyline.read_csv(tmp_path / "out" / "y-2.csv")
    assert sv.a_err(found, scene(3)[1]) < 2


@pytest.mark.parametrize(
    ("items", "names"),
    [
        (["cvg/I.jpg", "panoramio/I.jpg"], ["cvg-I", "panoramio-I"]),
        (["a/A.png", "b/a.png"], ["a-A", "b-a"]),
        (["x.png", "X.jpg", "x-2.png"], ["x.png", "X.jpg", "x-2"]),
    ],
)
def test_output_names(items, names):
    made = [sv.DatasetItem(str(Path(item).with_suffix("")), Path(item)) for item in items]
    assert output_names(made) == names


def test_numbers_do_not_clash_either():
    places = ["a/x.png", "b/x.png", "c/x-2.png"]
    made = [sv.DatasetItem(Path(place).stem, Path(place)) for place in places]
    assert output_names(made) == ["x", "x-3", "x-2"]


def test_geopose_photos_are_called_after_their_folders():
    made = [sv.DatasetItem(name, Path(name) / "photo.jpg", label_map=True) for name in ("n1", "n2")]
    assert output_names(made) == ["n1", "n2"]
    assert output_names(made[:1]) == ["n1"]


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


def test_an_interrupt_ends_with_130_and_leaves_no_half_file(say, hills, tmp_path, monkeypatch):
    write = sv.Skyline.write_csv

    def interrupted(skyline, path):
        if path.stem == "p2":
            path.parent.mkdir(exist_ok=True)
            raise KeyboardInterrupt
        write(skyline, path)

    monkeypatch.setattr(sv.Skyline, "write_csv", interrupted)
    status, _, err = say("detect", hills, "--out", "out", "--workers", "1")
    assert status == 130
    assert err == "skyline-viz: interrupted; every file that was written is whole.\n"
    assert files(tmp_path / "out") == ["p0.csv", "p1.csv"]


def test_a_fault_of_the_program_is_not_hidden(hills, monkeypatch):
    def broken(*_, **__):
        raise RuntimeError("a bug")

    monkeypatch.setattr(detect_command, "run", broken)
    with pytest.raises(RuntimeError, match="a bug"):
        main(["detect", str(hills)])


def test_a_dead_worker_is_told(say, hills, monkeypatch):
    def dead(*_, **__):
        raise batch.BatchError("a worker process died.")

    monkeypatch.setattr(detect_command, "run", dead)
    assert say("detect", hills) == (1, "", "skyline-viz: a worker process died.\n")


# ---- train and evaluate


def test_train_writes_a_bank_and_tells_about_it(say, hills, tmp_path):
    status, out, err = say(
        "train", hills, "--out", "new/bank.npz", "--seed", "5", "--training.filter-size", "5"
    )
    assert (status, err) == (0, "")
    bank = sv.FilterBank.load(tmp_path / "new" / "bank.npz")
    assert (bank.size, bank.provenance.dataset) == (5, "hills")
    assert (bank.provenance.images, bank.provenance.seed) == (4, 5)
    size = (tmp_path / "new" / "bank.npz").stat().st_size
    for told in (
        "4 of 4 in hills",
        f"{bank.samples.sum():,}",
        f"{bank.starved.sum()} of 288 bins",
        f"{size:,} bytes",
    ):
        assert told in out


def test_the_same_seed_gives_the_same_bank_whatever_the_workers(say, hills, tmp_path):
    for name, workers in (("a", 1), ("b", 2)):
        assert say("train", hills, "--out", f"{name}.npz", "--workers", workers)[0] == 0
    banks = [sv.FilterBank.load(tmp_path / f"{name}.npz") for name in "ab"]
    np.testing.assert_array_equal(banks[0].filters, banks[1].filters)


def test_photos_without_truth_are_named_and_left_out(say, hills, tmp_path):
    root = tmp_path / "some"
    write_scene(root / "images" / "p0.png", 0)
    write_scene(root / "images" / "bare.png", 1)
    scene(0)[1].write_csv(root / "masks" / "p0.csv")
    scene(0)[1].write_csv(root / "masks" / "stray.csv")
    status, out, err = say("train", root, "--out", "b.npz")
    assert status == 0
    assert "1 of 2 in some" in out
    assert err.splitlines() == [
        "skyline-viz: some: masks/stray.csv has no photo.",
        "skyline-viz: left out, because there is no truth: bare.",
    ]


def test_training_goes_on_past_a_bad_photo(say, tmp_path):
    root = tmp_path / "some"
    for number in range(2):
        write_scene(root / "images" / f"p{number}.png", number)
        scene(number)[1].write_csv(root / "masks" / f"p{number}.csv")
    (root / "images" / "p0.png").write_bytes(b"no photo")
    status, out, err = say("train", root, "--out", "b.npz")
    assert status == 1
    assert "1 of 2" in out
    assert "p0.png" in err


def test_evaluate_prints_and_writes(say, hills, tmp_path):
    status, out, err = say("evaluate", hills, "--out", "report")
    assert (status, err) == (0, "")
    assert files(tmp_path / "report") == ["histogram.png", "photos.csv", "summary.json"]
    summary = json.loads((tmp_path / "report" / "summary.json").read_text())
    assert (summary["dataset"], summary["layout"]) == ("hills", "plain")
    assert summary["summary"]["photos"] == 4
    assert summary["config"]["delta"] == sv.DetectorConfig().delta
    with (tmp_path / "report" / "photos.csv").open(newline="") as file:
        lines = list(csv.DictReader(file))
    assert [line["name"] for line in lines] == ["p0", "p1", "p2", "p3"]
    mean = np.mean([float(line["a_err"]) for line in lines])
    assert summary["summary"]["mean"] == pytest.approx(mean, abs=1e-4)
    assert f"{mean:.2f} px" in out
    assert "p3" in out


def test_a_cross_validation_says_so(say, hills, tmp_path):
    status, out, err = say("evaluate", hills, "--folds", "2", "--seed", "4", "--out", "report")
    assert (status, err) == (0, "")
    assert "2-fold cross-validation" in out
    summary = json.loads((tmp_path / "report" / "summary.json").read_text())
    assert (summary["folds"], summary["seed"], summary["failed"]) == (2, 4, [])


def test_testing_on_the_training_photos_is_noticed(say, hills):
    assert say("train", hills, "--out", "b.npz")[0] == 0
    status, _, err = say("evaluate", hills, "--bank", "b.npz")
    assert status == 0
    assert err == "skyline-viz: the bank was trained on hills, so this is no test; see --folds.\n"


def test_an_evaluation_lists_failures(say, tmp_path):
    root = tmp_path / "some"
    for number in range(2):
        write_scene(root / "images" / f"p{number}.png", number)
        scene(number)[1].write_csv(root / "masks" / f"p{number}.csv")
    (root / "images" / "p0.png").write_bytes(b"no photo")
    status, _, err = say("evaluate", root, "--out", "report")
    assert status == 1
    assert "p0.png" in err
    summary = json.loads((tmp_path / "report" / "summary.json").read_text())
    assert [failed["name"] for failed in summary["failed"]] == ["p0"]


def test_a_report_is_not_written_among_the_photos(say, hills):
    before = files(hills)
    assert say("evaluate", hills, "--out", hills / "images")[0] == 2
    assert files(hills) == before


# ---- render and demo


def test_render_makes_scenes_of_a_kind(say, tmp_path):
    words = ["--kind", "clear", "--seed", "3", "--count", "2", "--width", "96", "--height", "64"]
    status, out, _ = say("render", "--out", "a", *words)
    assert status == 0
    assert "2 scenes in a" in out
    say("render", "--out", "b", *words)
    made = files(tmp_path / "a")
    assert made == [
        f"{place}/clear-{seed}.{ending}"
        for place, ending in (("images", "jpg"), ("masks", "png"))
        for seed in (3, 4)
    ]
    for name in made:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    scenes = sv.open_dataset(tmp_path / "a")
    expected = rendering.render("clear", 4, 96, 64).truth
    assert scenes.items[1].truth() == expected


@pytest.fixture
def _few_samples(monkeypatch):
    """Two small scenes instead of the samples, which take a while to render."""

    def scenes():
        for seed in (1, 2):
            yield rendering.render("clear", seed, 96, 64)

    monkeypatch.setattr(rendering, "sample_scenes", scenes)


@pytest.mark.usefixtures("_few_samples")
def test_render_rebuilds_the_samples_byte_for_byte(say, tmp_path):
    status, out, _ = say("render")
    assert status == 0
    assert out.splitlines() == [
        "sample_data/images/clear-1.jpg",
        "sample_data/images/clear-2.jpg",
        "2 scenes in sample_data",
    ]
    list(rendering.write_scenes(rendering.sample_scenes(), tmp_path / "expected"))
    made = files(tmp_path / "sample_data")
    assert made == files(tmp_path / "expected")
    for name in made:
        written = (tmp_path / "sample_data" / name).read_bytes()
        assert written == (tmp_path / "expected" / name).read_bytes()


@pytest.fixture
def _no_viewer(monkeypatch):
    """Galleries are built but not drawn: `tests/e2e` does that."""
    drawn = []

    def draw(out, entries, path):
        drawn.append([entry.name for entry in entries])
        path.write_bytes(b"picture")

    monkeypatch.setattr("skyline_viz.commands.demo.show_picture", draw)
    monkeypatch.setenv("CI", "1")
    return drawn


def test_the_demo_is_a_gallery_the_worst_first(say, hills, tmp_path, _no_viewer):
    status, out, err = say("demo", hills, "--out", "shown")
    assert (status, err) == (0, "")
    assert files(tmp_path / "shown") == [
        "gallery.json",
        "gallery.png",
        *(f"recordings/p{number}.rrd" for number in range(4)),
    ]
    assert "4 photos in shown" in out
    assert "--out shown --serve" in out
    errors = json.loads((tmp_path / "shown" / "gallery.json").read_text())["photos"]
    worst_first = sorted(errors, key=lambda one: (-one["a_err"], one["margin"], one["name"]))
    assert _no_viewer == [[one["name"] for one in worst_first]]


@pytest.mark.usefixtures("_few_samples", "_no_viewer")
def test_the_demo_takes_the_samples_of_this_folder(say, tmp_path):
    list(rendering.write_scenes(rendering.sample_scenes(), tmp_path / "sample_data"))
    status, out, err = say("demo")
    assert (status, err) == (0, "")
    assert "2 photos in skyline-demo" in out


@pytest.mark.usefixtures("_few_samples", "_no_viewer")
def test_the_demo_renders_samples_where_there_are_none(say, tmp_path, monkeypatch):
    monkeypatch.setattr("skyline_viz.commands.demo.__file__", str(tmp_path / "x" / "y" / "z.py"))
    status, out, err = say("demo", "--out", "shown")
    assert status == 0
    assert "rendering sample photos into shown/sample_data." in err
    assert "2 photos in shown" in out


@pytest.mark.usefixtures("_no_viewer")
def test_the_demo_goes_on_past_a_bad_photo(say, tmp_path):
    write_scene(tmp_path / "in" / "good.png")
    (tmp_path / "in" / "bad.png").write_bytes(b"no photo")
    status, out, err = say("demo", tmp_path / "in", "--out", "shown")
    assert status == 1
    assert "1 photo in shown" in out
    assert "bad.png" in err
    (tmp_path / "in" / "good.png").unlink()
    assert say("demo", tmp_path / "in", "--out", "other")[0] == 1
    assert not list((tmp_path / "other").rglob("*.rrd"))


# ---- in a process of its own


def test_the_program_detects(tmp_path):
    photo = write_scene(tmp_path / "in" / "a.png")
    done = program("detect", photo, "--out", "out", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert files(tmp_path / "out") == ["a.csv"]


def test_the_program_tells_what_is_wrong(tmp_path):
    done = program("detect", "gone.jpg", cwd=tmp_path)
    assert done.returncode == 1
    assert done.stdout == ""
    assert done.stderr == "skyline-viz: gone.jpg cannot be read: no such file or directory.\n"


@pytest.mark.skipif(sys.platform == "win32", reason="pipes there break differently")
def test_the_program_is_silent_when_nobody_reads(hills, tmp_path):
    reader, writer = os.pipe()
    os.close(reader)
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-m", "skyline_viz", "detect", hills, "--out", "out"],
        stdout=writer,
        stderr=subprocess.PIPE,
        env=environment,
        cwd=tmp_path,
        timeout=120,
        check=False,
    )
    os.close(writer)
    assert (done.returncode, done.stderr) == (141, b"")


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
