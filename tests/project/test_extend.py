"""The term that ``docs/extend.md`` makes up appears wherever terms do, without another line."""

import re
from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from annotate.work.overlays import overlay, overlays
from skyline_viz import cost
from skyline_viz.diagnosis.cost_split import split_cost
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.diagnosis.other_settings import settings_to_try
from skyline_viz.diagnosis.sweep import setting_sweeps
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline
from skyline_viz.viewer.diagnosis_recording import log_diagnosis
from skyline_viz.viewer.sweep_recording import log_sweeps
from testing import ROOT
from testing.recordings import Read

SCENE = render("hazy", 1, 240, 160)


@pytest.fixture(scope="module")
def detector():
    page = (ROOT / "docs" / "extend.md").read_text(encoding="utf-8")
    section = page.split("## Add a term of the cost")[1].split("\n## ")[0]
    (example,) = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    before = cost.TERMS
    made = {}
    exec(example, made)
    yield made["detector"]
    cost.TERMS = before


@pytest.fixture(scope="module")
def found(detector):
    return detector.detect(SCENE.photo)


def test_it_is_a_summand_of_the_cost(found):
    without = found.again(replace(found.config, depth=0.0))
    rows = np.arange(160)[:, None] / 160
    np.testing.assert_allclose(found.cost - without.cost, 0.5 * rows.repeat(240, 1), atol=1e-5)
    np.testing.assert_allclose(
        found.cost_model["depth"].map(), 0.5 * rows.repeat(240, 1), atol=1e-6
    )


def test_it_is_a_part_of_what_a_line_pays(found):
    rows = found.skyline.rows.astype(np.int32)
    split = split_cost(found, rows)
    np.testing.assert_allclose(split.terms["depth"], 0.5 * rows / 160, atol=1e-6)
    whole = sum(split.totals(0, 239).values())
    assert whole == pytest.approx(found.path_cost, rel=1e-5)


def test_a_diagnosis_says_what_path_and_truth_pay_for_it(found):
    truth = Skyline(rows=np.minimum(found.skyline.rows + 40, 159))
    segment = diagnose(found, truth).main
    assert segment.truth_cost["depth"] > segment.path_cost["depth"]


def test_it_is_swept_and_tried_as_a_remedy(found):
    (sweep,) = (one for one in setting_sweeps(found) if one.timeline == "depth")
    assert sweep.now == "0.5"
    assert len({one.cost.tobytes() for _, one in sweep.detections(found)}) == len(sweep.steps)
    tried = settings_to_try(found)
    assert tried["half the cost of depth (--config.depth 0.25)"].depth == 0.25
    assert tried["twice the cost of depth (--config.depth 1)"].depth == 1


def test_the_viewer_shows_it(found, tmp_path):
    truth = Skyline(rows=np.minimum(found.skyline.rows + 40, 159))
    sweeps = [one for one in setting_sweeps(found) if one.timeline == "depth"]
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        sv.log_detection(recording, found, truth)
        log_diagnosis(recording, diagnose(found, truth), found, truth)
        log_sweeps(recording, sweeps, found, truth)
    read = Read(tmp_path / "a.rrd")
    assert read.array("terms/depth", "SegmentationImage:buffer").any()
    assert "Depth (cost): bright is cheap" in read.view_names
    assert len(read.on("depth", "sweep/path", "strips")) == len(sweeps[0].steps)


def test_the_page_can_lay_it_over_the_photo(found):
    assert "depth" in overlays(found)
    assert overlay(found, "depth") not in (
        overlay(found, "x"),
        overlay(found, "cost"),
    )
