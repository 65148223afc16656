"""Commands that read data sets take addresses: what they find is what they find in a folder."""

from pathlib import Path

import fsspec
import pytest

from skyline_viz.storage.copies import CACHE


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
