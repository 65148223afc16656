"""A full disk is an error of every command: one sentence that names the file, and no half file.

Files may not grow beyond a limit here, which the system tells a process of as it tells of a full
disk; that needs no rights and no disk.
"""

from pathlib import Path

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.rendering import render
from testing.programs.ends import write_set
from testing.programs.full import COMMANDS, fault_of, run


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    sv.Detector().detect(render("desert", 50, 160, 120).photo)  # what is compiled is on disk now
    return write_set(tmp_path_factory.mktemp("data") / "hills", photos=4, size=(160, 120))


@pytest.mark.parametrize("name", COMMANDS)
def test_one_sentence_and_no_half_file(name, data, tmp_path):
    assert fault_of(name, data, tmp_path) == ""


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
