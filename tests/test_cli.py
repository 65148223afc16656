"""``skyline-viz``: help, usage, bad input, and the program in a process of its own."""

import os
import subprocess
import sys
from contextlib import nullcontext

import pytest

import skyline_viz as sv
from skyline_viz.cli import main, parse
from skyline_viz.running import batch, resume
from testing.programs.commands import ROOT, files, program, write_scene


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


COMMANDS = [
    "detect",
    "inspect",
    "gallery",
    "train",
    "evaluate",
    "tables",
    "diagnose",
    "render",
    "demo",
]


@pytest.mark.parametrize("command", COMMANDS)
def test_defaults_are_of_their_types(command, monkeypatch):
    monkeypatch.setattr("skyline_viz.command_line.program.without", lambda *_: nullcontext())
    words = {"render": [], "train": ["hills", "--out", "b.npz"]}.get(command, ["hills"])
    parse([command, *words])  # tyro asks typeguard, and warns
    assert "typeguard" in sys.modules


def test_help_imports_nothing_heavy():
    code = (
        "import sys; from skyline_viz.cli import main;"
        f"[main([command, '--help']) for command in {COMMANDS}];"
        "heavy = {'cv2', 'numba', 'matplotlib', 'rich', 'rerun', 'scipy', 'skyline_viz.detector'};"
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
    ("words", "told"),
    [
        ([], "which command? There are detect, inspect, "),
        (["conquer"], "there is no command conquer; there are detect, "),
        (["detct", "a.jpg"], "there is no command detct; did you mean detect?"),
        (["detect", "a.jpg", "--summit", "1"], "has no option --summit; see "),
        (["detect", "a.jpg", "--overlai"], "has no option --overlai; did you mean --overlay?"),
        (["detect", "a.jpg", "--delta", "2"], "--delta; did you mean --config.delta?"),
        (["detect", "a.jpg", "--config.edge-source", "gray"], "gray; did you mean grey?"),
        (["detect", "a.jpg", "--preset", "papr"], "papr; did you mean paper?"),
        (["detect", "a.jpg", "--method", "papr"], "a trained one; did you mean paper?"),
        (["gallery", "hills", "--cause", "fog"], "fog; it is one of truth doubtful, missed edge, "),
        (["train", "x"], "skyline-viz train needs --out FILE."),
        (["evaluate"], "which DATASET? See skyline-viz evaluate --help."),
    ],
)
def test_usage_errors_end_with_2_and_one_sentence(say, words, told):
    status, out, err = say(*words)
    assert (status, out) == (2, "")
    assert err.startswith("skyline-viz: ")
    assert err.count("\n") == 1
    assert told in err


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
        (["evaluate", "HILLS", "--seed", "3"], "--folds asks for none."),
        (["tables", "HILLS", "--sky-class", "3"], "--sky-class is a class of --network"),
        (["detect", "HILLS", "--sky-class", "3"], "--sky-class is a class of --network"),
        (["render", "--seed", "3"], "are for scenes of a --kind."),
        (["render", "--kind", "lunar"], "no scene 'lunar'; a scene is one of clear, "),
        (["render", "--kind", "snwo"], "there is no scene 'snwo'; did you mean snow?"),
        (["diagnose", "HILLS", "--photo", "pp0"], "no photo pp0 with a truth; did you mean p0?"),
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


def test_a_fault_of_the_program_is_not_hidden(hills, monkeypatch):
    def broken(*_, **__):
        raise RuntimeError("a bug")

    monkeypatch.setattr(resume.Kept, "run", broken)
    with pytest.raises(RuntimeError, match="a bug"):
        main(["detect", str(hills)])


def test_a_dead_worker_is_told(say, hills, monkeypatch):
    def dead(*_, **__):
        raise batch.BatchError("a worker process died.")

    monkeypatch.setattr(resume.Kept, "run", dead)
    assert say("detect", hills) == (1, "", "skyline-viz: a worker process died.\n")


def test_the_program_detects(tmp_path):
    photo = write_scene(tmp_path / "in" / "a.png")
    done = program("detect", photo, "--out", "out", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert files(tmp_path / "out") == ["a.csv", "run.json", "skylines.csv"]


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
