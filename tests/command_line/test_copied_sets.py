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
            f"skyline-viz: s3://photos/{photo} may not be read.",
            f"skyline-viz: s3://photos/{truth} may not be read.",
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
