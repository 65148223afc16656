"""``skyline-viz render``: scenes of a kind, and the samples."""

import pytest

import skyline_viz as sv
from skyline_viz import rendering
from testing.programs.commands import files


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


def test_render_makes_scenes_of_several_kinds_with_any_camera(say, tmp_path):
    words = ["--count", "2", "--width", "48", "--height", "40", "--camera", "any"]
    status, out, _ = say("render", "--out", "a", "--kind", "sea", "night", "sea", *words)
    assert status == 0
    assert out.splitlines()[-1] == "4 scenes in a"
    names = [f"{kind}-{seed}-any.jpg" for kind in ("night", "sea") for seed in (1, 2)]
    assert sorted(path.name for path in (tmp_path / "a/images").iterdir()) == names


def test_render_knows_all_kinds(say, tmp_path):
    status, _, _ = say("render", "--out", "a", "--kind", "all", "--width", "32", "--height", "32")
    assert status == 0
    kinds = {path.stem for path in (tmp_path / "a/images").iterdir()}
    assert kinds == {f"{kind}-1" for kind in rendering.KINDS}
