"""The record of a run."""

import json
from pathlib import Path

import skyline_viz as sv
from skyline_viz.command_line.earlier_run import earlier
from skyline_viz.command_line.run_record import Beginning, remember
from skyline_viz.methods.registry import find_method
from skyline_viz.running.photo_table import PhotoRow


def test_a_record_holds_what_a_run_needs_to_be_repeated(tmp_path):
    remember("skyline-viz", ["detect", "a.png"])
    rows = [PhotoRow("a", Path("a.png"), "ab"), PhotoRow("b", Path("b.png"), error="it is empty.")]
    method = sv.Detector(config=sv.DetectorConfig(delta=6))
    Beginning.now().write(tmp_path / "run.json", method, None, {"mask": True}, rows)
    told = json.loads((tmp_path / "run.json").read_text())
    assert told["command"] == ["skyline-viz", "detect", "a.png"]
    assert (told["package"], told["options"]) == (sv.__version__, {"mask": True})
    assert told["photos"][0] == {"name": "a", "file": "a.png", "sha256": "ab"}
    assert told["failed"] == [{"name": "b", "reason": "it is empty."}]
    assert told["started"] <= told["ended"]
    assert set(told["versions"]) == {"python", "numpy", "opencv", "system"}
    assert len(told["digest"]) == 64
    assert earlier(tmp_path / "run.json").config == method.config


def test_another_method_is_known_by_its_name(tmp_path):
    Beginning.now().write(tmp_path / "run.json", find_method("edges"), None, {}, [])
    assert json.loads((tmp_path / "run.json").read_text())["settings"] == {"edges": {}}
