"""``skyline-viz demo``: a gallery of whatever photos there are."""

import json

import pytest

from skyline_viz import rendering
from testing.programs.commands import files, write_scene


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
    status, out, err = say("demo", hills, "--out", "shown", "--workers", "1")
    assert (status, err) == (0, "")
    assert files(tmp_path / "shown") == [
        "gallery.json",
        "gallery.png",
        *(f"recordings/p{number}.rrd" for number in range(4)),
        *(f"thumbnails/p{number}.jpg" for number in range(4)),
    ]
    assert "4 photos in shown" in out
    assert "--out shown --serve" in out
    errors = json.loads((tmp_path / "shown" / "gallery.json").read_text())["photos"]
    worst_first = sorted(
        errors, key=lambda one: (-one["verdict"]["a_err"], one["verdict"]["margin"], one["name"])
    )
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
