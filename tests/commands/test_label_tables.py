"""Commands on tables of labels: here and in a storage, in one process, in shards, on a cluster."""

import json

import fsspec
import pytest

import skyline_viz as sv
from testing.datasets import put, row_of, write_labels
from testing.programs.commands import scene, write_scene


@pytest.fixture
def labels(tmp_path, s3):
    """A table in a storage of six photos beside it: one has no line, one is no photo."""
    files = fsspec.filesystem("s3")
    rows = []
    for number in range(6):
        name, truth = f"p{number}.png", scene(number)[1]
        data = write_scene(tmp_path / name, number).read_bytes()
        files.pipe(f"photos/in/{name}", data if number != 4 else b"no photo")
        (tmp_path / name).unlink()
        rows.append(row_of(name, truth if number != 5 else None))
    table = write_labels(tmp_path / "in.parquet", rows)
    files.pipe("photos/in/in.parquet", table.read_bytes())
    table.unlink()
    return "s3://photos/in/in.parquet"


@pytest.fixture
def folder(tmp_path):
    """The same as a folder."""
    for number in range(6):
        write_scene(tmp_path / "in" / "images" / f"p{number}.png", number)
        if number != 5:
            scene(number)[1].write_csv(tmp_path / "in" / "masks" / f"p{number}.csv")
    (tmp_path / "in" / "images" / "p4.png").write_bytes(b"no photo")
    return tmp_path / "in"


def test_a_bank_is_the_same_from_folder_table_shards_and_cluster(say, labels, folder, tmp_path, s3):
    wanted = say("train", folder, "--out", "folder.npz", "--workers", "1")
    for name, *words in (["one", "--workers", "1"], ["cluster", "--cluster", "local:2"]):
        status, out, err = say("train", labels, "--out", f"{name}.npz", *words)
        assert (status, "photos used   4 of 6 in in" in out) == (1, True)
        assert "left out, because there is no truth: p5." in err
        assert "s3://photos/in/p4.png" in err
        assert wanted[0] == status
    for shard in ("1/3", "2/3", "3/3"):
        say("train", labels, "--out", "parts", "--shard", shard)
    assert say("join", "parts", "--out", "joined.npz")[0] == 0
    names = ("folder", "one", "cluster", "joined")
    assert len({(tmp_path / f"{one}.npz").read_bytes() for one in names}) == 1


def test_evaluation_of_a_table_is_that_of_the_folder(say, labels, folder, tmp_path, s3):
    results = {}
    for name, source in (("folder", folder), ("table", labels)):
        status, _, _ = say("evaluate", source, "--out", name, "--folds", "2")
        assert status == 1
        lines = (tmp_path / name / "photos.csv").read_text().splitlines()
        header = lines[0].split(",")
        assert header[:2] == ["name", "a_err"]
        left = header.index("seconds")
        results[name] = [[*one.split(",")[:left], *one.split(",")[left + 1 :]] for one in lines]
    assert results["folder"] == results["table"]
    assert json.loads((tmp_path / "table" / "summary.json").read_text())["layout"] == "table"


def test_a_killed_evaluation_of_a_table_goes_on(say, labels, monkeypatch, s3):
    words = ("evaluate", labels, "--out", "out", "--workers", "1")
    with monkeypatch.context() as patch:
        patch.setattr("skyline_viz.evaluation.write_evaluation", _interrupted)
        assert say(*words)[0] == 130
    s3.downloads.clear()
    assert "4 of 5 photos were done already." in say(*words)[2]


def _interrupted(*_, **__):
    raise KeyboardInterrupt


@pytest.mark.parametrize(
    "words",
    [
        ("diagnose", "--out", "causes", "--no-remedies"),
        ("gallery", "--html", "pages"),
        ("inspect", "--save", "all.rrd"),
        ("detect", "--out", "lines"),
        ("detect", "--out", "lines.parquet"),
    ],
)
def test_all_commands_take_a_table(say, labels, words, tmp_path, s3):
    status, _, err = say(words[0], labels, *words[1:])
    assert status == 1
    assert "s3://photos/in/p4.png" in err
    assert (tmp_path / words[2]).exists()


def test_what_detect_has_found_is_evaluated_as_lines(say, hills, tmp_path):
    say("detect", hills, "--out", "lines.parquet")
    status, _, _ = say("evaluate", hills, "--predictions", "lines.parquet", "--out", "of_lines")
    assert status == 0
    say("evaluate", hills, "--out", "of_method")
    told = []
    for one in ("of_lines", "of_method"):
        lines = (tmp_path / one / "photos.csv").read_text().splitlines()[1:]
        told.append([line.split(",")[:2] for line in lines])
    assert told[0] == told[1]


def test_a_table_that_is_damaged_or_missing_ends_with_a_sentence(say, tmp_path):
    (tmp_path / "bad.parquet").write_bytes(b"x")
    for name, said in (
        ("bad", "bad.parquet is damaged, or no Parquet table."),
        ("none", "none.parquet cannot be read: no such file or directory."),
    ):
        for words in (("evaluate",), ("train", "--out", "b.npz"), ("detect",)):
            status, out, err = say(words[0], f"{name}.parquet", *words[1:])
            assert (status, out, err) == (2, "", f"skyline-viz: {said}\n")


def test_a_photo_of_a_table_that_is_another_one_fails_alone(say, tmp_path):
    put(tmp_path / "a.png", scene(0)[0])
    put(tmp_path / "b.png", scene(1)[0])
    rows = [row_of("a.png", scene(0)[1], sha256="0" * 64), row_of("b.png", scene(1)[1], sha256="")]
    write_labels(tmp_path / "t.parquet", rows)
    status, _, err = say("train", "t.parquet", "--out", "bank.npz")
    assert status == 1
    assert "a.png is not the file that was labelled" in err
    assert sv.FilterBank.load(tmp_path / "bank.npz").provenance.images == 1


@pytest.mark.parametrize("how", [("--workers", "1"), ("--workers", "2"), ("--cluster", "local:2")])
def test_a_row_that_is_damaged_costs_its_photo_alone(say, tmp_path, how):
    rows = []
    for number in range(4):
        write_scene(tmp_path / f"p{number}.png", number)
        rows.append(row_of(f"p{number}.png", scene(number)[1]))
    rows[1]["rows"], rows[2]["visible"] = [], [True]
    write_labels(tmp_path / "t.parquet", rows)
    for words in (("train", "t.parquet", "--out", "b.npz"), ("evaluate", "t.parquet")):
        status, out, err = say(*words, *how)
        assert status == 1
        told = [line for line in err.splitlines() if "its row of the table cannot be read" in line]
        assert len(told) == 2
        assert "2 of 4 in t" in out or "2 photos" in out
