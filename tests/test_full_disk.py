"""A full disk is an error of every command: one sentence that names the file, and no half file.

Files may not grow beyond a limit here, which the system tells a process of as it tells of a full
disk; that needs no rights and no disk.
"""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.rendering import render
from tests.ends import write_set

LIMITED = """
import resource, sys
from {program}.cli import main
resource.setrlimit(resource.RLIMIT_FSIZE, ({most}, {most}))
sys.exit(main(sys.argv[1:]))
"""


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    sv.Detector().detect(render("desert", 50, 160, 120).photo)  # what is compiled is on disk now
    return write_set(tmp_path_factory.mktemp("data") / "hills", photos=4, size=(160, 120))


def run(program, most, *words, stdout=subprocess.PIPE):
    code = LIMITED.format(program=program, most=most)
    command = [sys.executable, "-c", code, *map(str, words)]
    return subprocess.run(command, stdout=stdout, stderr=subprocess.PIPE, text=True, check=False)


COMMANDS = {
    "detect": (100, "detect DATA --out OUT", ".csv"),
    "detect --json": (1700, "detect DATA --out OUT --json", ".json"),
    "detect with workers": (100, "detect DATA --out OUT --workers 2", ".csv"),
    "evaluate": (100, "evaluate DATA --out OUT", ".json"),
    "evaluate, at the end": (2000, "evaluate DATA --out OUT", "histogram.png"),
    "evaluate methods": (100, "evaluate DATA --out OUT --method edges", ".json"),
    "diagnose": (100, "diagnose DATA --out OUT", ".json"),
    "tables": (100, "tables DATA --out OUT --method edges", ".json"),
    "train": (5000, "train DATA --out OUT/bank.npz", "bank.npz"),
    "gallery": (20_000, "gallery DATA --out OUT --serve", ".rrd"),
    "inspect": (20_000, "inspect DATA --save OUT/a.rrd", "a.rrd"),
    "render": (20_000, "render --out OUT", ".jpg"),
}


@pytest.mark.parametrize("name", COMMANDS)
def test_one_sentence_and_no_half_file(name, data, tmp_path):
    most, line, ending = COMMANDS[name]
    out = tmp_path / "out"
    out.mkdir()
    words = [word.replace("DATA", str(data)).replace("OUT", str(out)) for word in line.split()]
    done = run("skyline_viz", most, *words)
    assert done.returncode == 1, done.stderr
    said = done.stderr.strip().splitlines()[-1]
    assert len(done.stderr.strip().splitlines()) == 1, done.stderr
    assert said.startswith(f"skyline-viz: {out}")
    assert said.endswith(f"{ending}: file too large.")
    files = [path for path in out.rglob("*") if path.is_file()]
    assert not [path for path in files if path.name.startswith(".")]
    assert not [path for path in files if path.stat().st_size in (0, most)]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no disk that is always full")
def test_output_that_cannot_be_printed_is_an_error(data, tmp_path):
    with Path("/dev/full").open("w") as full:
        done = run("skyline_viz", 10**9, "detect", data, "--out", tmp_path, stdout=full)
    assert done.returncode == 1
    assert done.stderr == ("skyline-viz: the output cannot be written: no space left on device.\n")


def test_an_export_is_whole_or_not_there(tmp_path):
    folder, labels = tmp_path / "photos", tmp_path / "labels"
    folder.mkdir()
    labels.mkdir()
    sv.write_photo(folder / "wide.png", np.zeros((60, 9000, 3), np.uint8))
    sv.Skyline(np.full(9000, 20.0)).write_csv(labels / "wide.csv")
    for words in (["import", folder, labels, "--status", "accepted"], ["status", folder]):
        assert run("annotate", 10**9, *words).returncode == 0
    done = run("annotate", 50_000, "export", folder, "--out", tmp_path / "out")
    assert done.returncode == 1
    assert done.stderr.startswith("skyline-annotate: ")
    assert done.stderr.endswith("wide.csv: file too large.\n")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["labels", "photos"]
