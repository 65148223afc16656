"""Commands that read data sets take addresses: what they find is what they find in a folder."""

from pathlib import Path

import fsspec
import pytest
import s3fs

from skyline_viz.storage.copies import CACHE
from testing.programs.s3 import s3 as started_s3


@pytest.fixture
def stored(hills, monkeypatch, tmp_path):
    """The data set in a storage."""
    monkeypatch.setenv(CACHE, str(tmp_path / "cache"))
    files = fsspec.filesystem("memory")
    for path in Path(hills).rglob("*"):
        if path.is_file():
            files.pipe(f"/{Path(hills).name}/{path.relative_to(hills)}", path.read_bytes())
    yield f"memory://{Path(hills).name}"
    files.store.clear()


def test_evaluate_and_train_take_addresses(say, hills, stored, tmp_path):
    here, there = (say("evaluate", one) for one in (hills, stored))
    assert here[0] == there[0] == 0
    assert here[1].splitlines()[0] == there[1].splitlines()[0]
    for one, out in ((hills, "here.npz"), (stored, "there.npz")):
        assert say("train", one, "--out", out)[0] == 0
    assert (tmp_path / "here.npz").read_bytes() == (tmp_path / "there.npz").read_bytes()


def test_diagnose_gallery_and_inspect_take_addresses(say, stored, tmp_path):
    assert say("diagnose", stored, "--no-remedies", "--out", "d")[0] == 0
    assert say("gallery", stored, "--html", "pages")[0] == 0
    assert say("inspect", stored, "--save", "all.rrd")[0] == 0
    assert (tmp_path / "all.rrd").exists()
    assert (tmp_path / "d" / "segments.csv").exists()
    assert [*(tmp_path / "pages" / "pages").iterdir()]


def test_an_address_that_leads_nowhere_is_a_sentence(say, stored):
    for command in ("evaluate", "diagnose"):
        assert say(command, "memory://gone")[2] == "skyline-viz: memory://gone does not exist.\n"


@pytest.fixture
def bucket(hills, monkeypatch, tmp_path):
    """The data set in a bucket, of which a photo and the truth of another one are forbidden."""
    monkeypatch.setenv(CACHE, str(tmp_path / "cache"))
    monkeypatch.setattr(s3fs.S3FileSystem, "retries", 1)
    with started_s3(monkeypatch) as moods:
        for path in Path(hills).rglob("*"):
            if path.is_file():
                key = f"photos/hills/{path.relative_to(hills)}"
                fsspec.filesystem("s3").pipe(key, path.read_bytes())
        photo, truth = "hills/images/p1.png", "hills/masks/p2.csv"
        moods.forbidden = {photo, truth}
        moods.said = [
            f"skyline-viz: s3://photos/{photo} may not be downloaded.",
            f"skyline-viz: s3://photos/{truth} may not be downloaded.",
        ]
        yield moods


@pytest.mark.parametrize(
    "words",
    [
        ("evaluate", "--out", "out"),
        ("evaluate", "--folds", "2", "--out", "out"),
        ("diagnose", "--no-remedies", "--out", "out"),
        ("gallery", "--html", "pages", "--out", "out"),
        ("train", "--out", "bank.npz"),
        ("train", "--method", "svm-dcsi", "--out", "svm.npz"),
        ("tables", "--method", "edges", "--no-studies", "--out", "out"),
        ("inspect", "--save", "all.rrd"),
    ],
)
def test_what_a_storage_does_not_give_fails_alone(say, bucket, words):
    command, *more = words
    status, _, err = say(command, "s3://photos/hills", *more)
    assert status == 1
    assert err.splitlines()[-3:] == ["skyline-viz: 2 photos failed:", *bucket.said]


def test_a_lost_photo_without_a_truth_is_named_with_the_reason(say, bucket):
    fsspec.filesystem("s3").rm("photos/hills/masks/p1.csv")
    err = say("evaluate", "s3://photos/hills")[2].splitlines()
    assert f"{bucket.said[0].rstrip('.')}; it has no truth either." in err


def test_lines_and_truths_take_addresses(say, hills, stored):
    status, out, err = say("evaluate", hills, "--predictions", f"mine={stored}/masks")
    assert (status, err) == (0, "")
    assert f"4 photos, lines of {stored}/masks" in out
    photo, truth = f"{stored}/images/p1.png", f"{stored}/masks/p1.csv"
    status, out, err = say("inspect", photo, "--truth", truth, "--headless")
    assert (status, err) == (0, "")
    assert out.startswith("p1  A_err 0.")
    status, _, err = say("inspect", photo, "--truth", f"{stored}/gone.csv", "--headless")
    assert (status, err) == (1, f"skyline-viz: p1: {stored}/gone.csv does not exist.\n")


def test_a_lost_line_is_that_of_its_photo(say, bucket, hills):
    lines = "s3://photos/hills/masks"
    status, out, err = say("evaluate", hills, "--predictions", lines)
    assert (status, err) == (1, f"{bucket.said[1]}\n")
    assert out.startswith("hills: 3 photos, lines of")


def test_photos_of_addresses_fail_alone(say, stored):
    good, gone = f"{stored}/images/p1.png", f"{stored}/images/gone.png"
    status, out, err = say("inspect", good, gone, "--headless")
    assert (status, out) == (1, "p1  margin 3.19\n1 recording made.\n")
    assert err == f"skyline-viz: {gone} does not exist.\n"


def test_a_photo_is_not_learned_from_where_it_is_swept(say, stored, hills, monkeypatch):
    learned = []

    def train_sizes(items, *_, **__):
        learned.extend(item.name for item in items)
        return [], []

    monkeypatch.setattr("skyline_viz.evaluation.train_sizes", train_sizes)
    for photo in (f"{stored}/images/p1.png", hills / "images" / "p1.png"):
        say("inspect", photo, "--sweep", "--sweep-training", stored, "--headless")
    assert learned == ["p0", "p2", "p3"] * 2


def test_shards_are_joined_from_addresses(say, hills, stored, tmp_path):
    for number in (1, 2):
        assert say("train", hills, "--out", "parts", "--shard", f"{number}/2")[0] == 0
    for path in (tmp_path / "parts").iterdir():
        fsspec.filesystem("memory").pipe(f"/parts/{path.name}", path.read_bytes())
    assert say("join", "parts", "--out", "here.npz")[0] == 0
    assert say("join", "memory://parts", "--out", "there.npz")[0] == 0
    assert (tmp_path / "here.npz").read_bytes() == (tmp_path / "there.npz").read_bytes()


def test_what_is_wrong_in_a_copy_is_told_by_its_address(say, stored):
    files = fsspec.filesystem("memory")
    files.pipe("/hills/images/p1.png", b"")
    status, _, err = say("evaluate", stored)
    assert (status, err) == (1, f"skyline-viz: {stored}/images/p1.png is empty (0 bytes).\n")
    files.pipe("/texts/a.txt", b"x")
    status, _, err = say("evaluate", "memory://texts")
    assert (status, err) == (2, "skyline-viz: memory://texts holds no photograph.\n")
