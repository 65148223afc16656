"""``skyline-viz inspect --report``."""

import pytest

from skyline_viz.cli import main
from testing import SAMPLES

PHOTO = str(SAMPLES / "images" / "hazy-1.jpg")
TRUTH = str(SAMPLES / "masks" / "hazy-1.png")


def test_one_photo_with_its_remedy(tmp_path, capsys):
    file = tmp_path / "r.html"
    words = ["--truth", TRUTH, "--config.sky-weight", "0", "--report", str(file)]
    assert main(["inspect", PHOTO, *words]) == 0
    out = capsys.readouterr().out
    assert "hazy-1  A_err " in out
    assert f"{file}: 1 photo, " in out
    text = file.read_text(encoding="utf-8")
    assert "<title>hazy-1</title>" in text
    assert 'class="remedy"' in text


def test_photos_without_a_truth_and_one_that_fails(tmp_path, capsys):
    (tmp_path / "bad.jpg").write_bytes(b"no photo")
    file = tmp_path / "r.html"
    assert main(["inspect", PHOTO, str(tmp_path / "bad.jpg"), "--report", str(file)]) == 1
    assert "bad" in capsys.readouterr().err
    text = file.read_text(encoding="utf-8")
    assert text.count("<article") == 1
    assert "No truth to compare with" in text
    assert "Photos that failed" in text


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--save", "a.rrd"], "--save and --report exclude each other"),
        (["--sweep"], "--report and --sweep exclude each other"),
        (["--split"], "--report and --split exclude each other"),
        (["--method", "default", "paper"], "inspect reports on one method, and 2 are named"),
    ],
)
def test_what_makes_no_report_is_refused(words, said, tmp_path, capsys):
    assert main(["inspect", PHOTO, "--report", str(tmp_path / "r.html"), *words]) == 2
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
