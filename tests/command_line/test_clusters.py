"""Commands on a cluster find what they find in processes; lost workers cost nothing else."""

import json
from contextlib import nullcontext

import pytest

from skyline_viz.command_line.clusters import on_cluster
from skyline_viz.running.batch import elsewhere
from skyline_viz.running.clusters.requirements import ClusterError
from skyline_viz.running.clusters.working import Cluster
from skyline_viz.storage import copy_names


def test_without_one_nothing_is_elsewhere():
    with on_cluster(None, 3):
        assert elsewhere() is None


def test_evaluate_finds_the_same_with_folds_on_a_cluster(say, hills):
    words = ("evaluate", hills, "--folds", "2", "--out")
    assert say(*words, "here")[0] == 0
    status, _, err = say(*words, "there", "--cluster", "local:2")
    assert status == 0
    assert err.startswith("skyline-viz: the cluster shows what it does at http://127.0.0.1:")
    here, there = (_without_times(json.loads(_read(f"{one}/summary.json"))) for one in HERE)
    assert here == there


def test_diagnose_finds_the_same_on_a_cluster(say, hills):
    words = ("diagnose", hills, "--no-remedies", "--out")
    assert say(*words, "here")[0] == 0
    assert say(*words, "there", "--cluster", "local:1")[0] == 0
    assert _read("here/segments.csv") == _read("there/segments.csv")


def test_a_gallery_is_the_same_on_a_cluster(say, hills, tmp_path):
    for out, more in (("here", ()), ("there", ("--cluster", "local:1"))):
        words = ("gallery", hills, "--out", out, "--html", f"{out}-pages", *more)
        assert say(*words)[0] == 0
    names = [sorted(path.name for path in tmp_path.glob(f"{one}-pages/pages/*")) for one in HERE]
    assert names[0] == names[1] != []


def test_detect_writes_the_same_files_from_a_cluster(say, hills, tmp_path):
    words = ("detect", hills, "--mask", "--overlay", "--out")
    assert say(*words, "here")[0] == 0
    assert say(*words, "there", "--cluster", "local:2")[0] == 0
    here, there = (
        {path.name: path.read_bytes() for path in tmp_path.glob(f"{one}/p*")} for one in HERE
    )
    assert len(here) == 12
    assert here == there
    rows = [_read(f"{one}/skylines.csv").splitlines() for one in HERE]
    assert [row.split(",")[:8] for row in rows[0]] == [row.split(",")[:8] for row in rows[1]]
    assert json.loads(_read("there/run.json"))["options"]["cluster"] == "local:2"


def test_detect_names_bad_photos_of_a_cluster(say, hills, tmp_path):
    (tmp_path / "empty.png").touch()
    photo = next((hills / "images").iterdir())
    words = ("empty.png", "gone.png", photo, "--out", "out", "--cluster", "local:1")
    status, out, err = say("detect", *words)
    assert status == 1
    assert f"out/{photo.stem}.csv" in out
    assert err.splitlines()[-3:] == [
        "skyline-viz: 2 photos failed:",
        "skyline-viz: empty.png is empty (0 bytes).",
        "skyline-viz: gone.png cannot be read: no such file or directory.",
    ]


def test_tables_are_the_same_from_a_cluster(say, hills, tmp_path):
    for out, more in (("here", ()), ("there", ("--cluster", "local:2"))):
        assert say("tables", hills, "--method", "default", "--out", out, *more)[0] == 0
    tables = [_read(f"{one}/tables.md").partition("Table VI")[0] for one in HERE]
    assert tables[0] == tables[1]
    assert "Table III" in tables[0]


def test_a_folder_that_workers_do_not_see_is_refused(tmp_path, monkeypatch):
    seen = {"tcp://a:1": True, "tcp://b:2": False}
    monkeypatch.setattr("skyline_viz.running.clusters.working.every_worker", lambda *_: seen)
    with pytest.raises(ClusterError, match=r"^the worker tcp://b:2 does not see the folder .*path"):
        Cluster(None).check_shared(tmp_path)
    with pytest.raises(ClusterError, match=r"; let CACHE name one that all machines share"):
        Cluster(None).check_shared(tmp_path, "let CACHE name")
    assert [*tmp_path.iterdir()] == []


def test_copies_have_to_be_where_workers_see_them(monkeypatch, tmp_path):
    checked = []

    class There:
        link = "http://127.0.0.1:1"

        def check_shared(self, folder, how="name"):
            checked.append((folder, how))

    monkeypatch.setattr(
        "skyline_viz.running.clusters.connecting.cluster_at", lambda *_: nullcontext(There())
    )
    monkeypatch.setattr(copy_names, "_copies", {})
    monkeypatch.setenv("SKYLINE_VIZ_CACHE", str(tmp_path))
    with on_cluster("local:1"):
        assert checked == []
    copy_names.remember(tmp_path / "hills", "s3://b/hills")
    with on_cluster("local:1"):
        assert checked == [(tmp_path, "let SKYLINE_VIZ_CACHE name")]


HERE = ("here", "there")


def _read(file):
    with open(file, encoding="utf-8") as opened:  # noqa: PTH123 - below the folder of the test
        return opened.read()


def _without_times(told):
    if isinstance(told, dict):
        return {
            key: _without_times(value)
            for key, value in told.items()
            if not any(word in key for word in ("second", "time", "command", "argv", "when"))
        }
    return [*map(_without_times, told)] if isinstance(told, list) else told
