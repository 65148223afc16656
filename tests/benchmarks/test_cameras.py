"""Sources left out: what learns from which photos, and what is said of the results."""

from dataclasses import replace

import numpy as np

from benchmarks.ablation import DEFAULT, WITHOUT_SKY, compared, variants
from benchmarks.cameras import table
from benchmarks.left_out import LeftOut, Models, Variant
from benchmarks.misses import explained
from benchmarks.sources import Source, sources
from skyline_viz import DetectorConfig, LoadedItem, Skyline
from testing.detections import result
from testing.programs.commands import scene, write_scene

WITHOUT = DetectorConfig(sky_weight=0.0)


def place(name, count, rows=25, *, truth=None, clips=False):
    """A source of small photos with a level skyline, two a clip; their truth may be elsewhere."""
    photo = np.full((40, 60, 3), 200, np.uint8)
    photo[rows:] = 60
    level = Skyline(rows=np.full(60, truth or rows, np.float32))
    items = [LoadedItem(f"{name}{at // 2}-{at}", photo, level) for at in range(count)]
    return Source(name, name, items, 4, clips=clips)


def test_filters_learn_from_all_other_sources_and_from_no_photo_of_the_same_place():
    grades = [replace(place(grade, 2), place="mountains") for grade in "AB"]
    left_out = LeftOut([place("web", 3), *grades, place("uav", 4)])
    variant = Variant("plain", WITHOUT, Models(None))
    learned = {
        name: left_out.detector(variant, name).bank.provenance.images
        for name in ("web", "mountains", "uav")
    }
    assert learned == {"web": 8, "mountains": 7, "uav": 7}


def test_what_has_no_sky_model_that_was_left_out_is_not_measured_and_named(tmp_path):
    left_out = LeftOut([place("web", 2), place("uav", 2)])
    results = left_out.results(Variant("default", DetectorConfig(), Models(tmp_path)))
    assert results == {}
    assert "`no-web.onnx`, `no-uav.onnx` in" in Models(tmp_path).missing(left_out.sources)
    lines = table(left_out.sources, results).splitlines()[2:]
    assert [line.count("not measured") for line in lines] == [1, 1]


def test_lines_and_causes_of_a_detector_that_needs_no_sky_model():
    left_out = LeftOut([place("web", 2), place("uav", 4, clips=True)])
    variant = Variant(WITHOUT_SKY, WITHOUT, Models(None))
    results = left_out.results(variant)
    web, uav = table(left_out.sources, results).splitlines()[2:]
    assert "| 2/2 |" in web
    assert "| 4 of 2 clips |" in uav
    assert explained(left_out, variant, results).endswith("There are none.")


def test_each_gross_miss_is_named_with_its_cause():
    left_out = LeftOut([place("web", 2), place("uav", 2), place("odd", 2, truth=9)])
    variant = Variant(WITHOUT_SKY, WITHOUT, Models(None))
    results = left_out.results(variant)
    assert table(left_out.sources, results).count("| 2/2 |") == 2
    lines = explained(left_out, variant, results).splitlines()[4:]
    assert [line.split(" | ")[0] for line in lines] == ["| odd0-0", "| odd0-1"]
    assert lines[0].split(" | ")[1:5] == ["16 px", "0 to 59", "16 px", "truth doubtful"]


def test_frames_count_as_much_as_their_clips():
    source = place("clip", 8, clips=True)
    alone = replace(source, clips=False)
    every = [True] * 8
    assert source.share(every).low < alone.share(every).low
    some = [True] * 4 + [False] * 4
    assert source.share(some).low < alone.share(some).low


def test_differences_are_paired_and_bold_where_they_are_sure():
    source = place("web", 6)
    good = [result(item.name, 1.0) for item in source.items]
    bad = [result(item.name, 9.0) for item in source.items]
    found = {DEFAULT: {"web": good}, "worse": {"web": bad}, "same": {"web": list(good)}}
    lines = compared([source], found).splitlines()
    assert "**-100.00 (-100.00 to -100.00)**" in next(one for one in lines if "worse" in one)
    same = next(one for one in lines if "| same" in one)
    assert "**" not in same
    assert "+0.00 (+0.00 to +0.00)" in same


def test_the_ablation_has_the_default_first_and_no_variant_twice():
    chosen = variants(Models(None), [])
    assert chosen[0].name == DEFAULT
    configs = [repr((one.config, one.sky)) for one in chosen]
    assert len(set(configs)) == len(configs)


def test_two_grades_are_of_one_place_and_the_rough_one_is_left_out(tmp_path, monkeypatch):
    monkeypatch.setattr("benchmarks.sources.EACH", 0)
    assert sources(tmp_path) == []
    for number, grade in enumerate("ABC"):
        name = f"mountains/{{}}/{grade}-{number}"
        write_scene(tmp_path / f"{name.format('images')}.png", number)
        (tmp_path / "mountains" / "masks").mkdir(exist_ok=True)
        scene(number)[1].write_csv(tmp_path / f"{name.format('masks')}.csv")
    found = [(one.name, one.place, [item.name for item in one.items]) for one in sources(tmp_path)]
    assert found == [("mountains A", "mountains", ["A-0"]), ("mountains B", "mountains", ["B-1"])]
