"""The built wheel works by itself in an empty environment."""

import csv
import os
import subprocess
import sys
import venv
import zipfile

import pytest

from testing import ROOT, uncovered


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    command = ["-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    subprocess.run([sys.executable, *command], check=True, capture_output=True)
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    """Folder of the programs of an environment that holds nothing but the wheel and its needs."""
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder, with_pip=True)
    programs = folder / ("Scripts" if os.name == "nt" else "bin")
    pip = [str(programs / "python"), "-m", "pip", "--disable-pip-version-check", "--quiet"]
    for what in (["-r", str(ROOT / "requirements.txt")], ["--no-deps", str(wheel)]):
        subprocess.run([*pip, "install", *what], check=True, capture_output=True)
    return programs


def run(program, *arguments, cwd):
    clean = {name: value for name, value in uncovered().items() if name != "PYTHONPATH"}
    command = [str(program), *map(str, arguments)]
    return subprocess.run(command, cwd=cwd, env=clean, capture_output=True, text=True, check=False)


def test_the_wheel_holds_bank_sky_models_and_licence_and_no_photograph(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    assert "skyline_viz/filter_bank.npz" in names
    assert {"skyline_viz/sky_small.onnx", "skyline_viz/sky_large.onnx"} <= set(names)
    assert "skyline_viz/py.typed" in names
    assert any(name.endswith("LICENSE") for name in names)
    pictures = [name for name in names if name.endswith((".jpg", ".bmp", ".png"))]
    assert all(name.startswith("annotate/static/guideline/") for name in pictures)  # rendered


def test_detect_works_from_the_wheel(installed, tmp_path):
    photo = ROOT / "sample_data" / "images" / "rover-2.jpg"
    done = run(installed / "skyline-viz", "detect", photo, "--out", tmp_path / "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    with (tmp_path / "out" / "rover-2.csv").open() as file:
        lines = list(csv.DictReader(file))
    assert len(lines) == 960
    assert {line["visible"] for line in lines} == {"1"}
    assert all(60 < float(line["row"]) < 300 for line in lines)


def test_demo_renders_its_own_samples_where_there_is_no_sample_data(installed, tmp_path):
    done = run(installed / "skyline-viz", "demo", "--out", "shown", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "shown" / "gallery.png").stat().st_size > 50_000
    assert len(list((tmp_path / "shown" / "recordings").glob("*.rrd"))) == 12
    rebuilt = sorted((tmp_path / "shown").rglob("images/*.jpg"))
    shipped = sorted((ROOT / "sample_data" / "images").glob("*.jpg"))
    assert [path.name for path in rebuilt] == [path.name for path in shipped]
    assert all(a.read_bytes() == b.read_bytes() for a, b in zip(rebuilt, shipped, strict=True))


def test_mistakes_are_one_sentence(installed, tmp_path):
    done = run(installed / "skyline-viz", "detect", "nowhere.jpg", cwd=tmp_path)
    assert done.returncode == 1
    assert "nowhere.jpg" in done.stderr
    assert "Traceback" not in done.stderr
