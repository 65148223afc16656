"""Addresses where commands take paths: copied where they are read, refused in all other places."""

from pathlib import Path

import fsspec
import pytest

from annotate.cli import main as annotate
from skyline_viz.command_line.local import called, local, refuse_addresses, spelt_as_address


def test_paths_stay_as_they_are(tmp_path):
    assert local("photos/hills") == Path("photos/hills")
    assert local(tmp_path) == tmp_path


def test_what_is_at_an_address_is_copied(monkeypatch, tmp_path):
    monkeypatch.setenv("SKYLINE_VIZ_CACHE", str(tmp_path))
    files = fsspec.filesystem("memory")
    files.pipe("/in/a.jpg", b"x")
    assert (local("memory://in") / "a.jpg").read_bytes() == b"x"
    files.store.clear()


def test_a_folder_that_looks_like_an_address_is_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert spelt_as_address(Path("s3:/b")) == "s3://b"
    Path("s3:/b").mkdir(parents=True)
    assert spelt_as_address(Path("s3:/b")) == ""
    refuse_addresses(object())


@pytest.mark.parametrize(
    ("words", "option"),
    [
        (("evaluate", "HILLS", "--out", "ADDRESS"), "out"),
        (("evaluate", "HILLS", "--bank", "ADDRESS"), "bank"),
        (("evaluate", "HILLS", "--config", "ADDRESS"), "config"),
        (("evaluate", "HILLS", "--method", "mine=ADDRESS"), "method"),
        (("detect", "HILLS", "--network", "ADDRESS"), "network"),
        (("inspect", "HILLS", "--save", "ADDRESS"), "save"),
        (("train", "HILLS", "--out", "ADDRESS"), "out"),
        (("render", "--out", "ADDRESS"), "out"),
    ],
)
def test_an_address_for_a_path_is_one_sentence_and_nothing_is_made(
    say, hills, tmp_path, words, option
):
    status, out, err = say(*(w.replace("HILLS", str(hills)).replace("ADDRESS", A) for w in words))
    assert (status, out) == (2, "")
    assert err == (
        f"skyline-viz: {A} is an address, and --{option} takes a path of this machine; copy from "
        f"there or to there, with aws s3 cp or the like.\n"
    )
    assert [*tmp_path.iterdir()] == []


A = "s3://photos/some.npz"


@pytest.mark.parametrize("words", [("open", A), ("status", A), ("import", A, "masks")])
def test_labels_lie_beside_their_photos(capsys, words):
    assert annotate([*words]) == 2
    assert capsys.readouterr().err == (
        f"skyline-annotate: {A} is an address, and labels are kept beside their photos, in a "
        f"folder of this machine; copy the photos into one, with aws s3 sync or the like.\n"
    )


def test_labels_are_imported_from_an_address(capsys, hills, tmp_path, monkeypatch):
    monkeypatch.setenv("SKYLINE_VIZ_CACHE", str(tmp_path / "cache"))
    files, photos = fsspec.filesystem("memory"), tmp_path / "photos"
    photos.mkdir()
    for path in (hills / "images").iterdir():
        (photos / path.name).write_bytes(path.read_bytes())
    for path in (hills / "masks").iterdir():
        files.pipe(f"/masks/{path.name}", path.read_bytes())
    assert annotate(["import", str(photos), "memory://masks"]) == 0
    assert capsys.readouterr().out == f"4 labels imported into {photos}\n"
    files.store.clear()


def test_names_of_addresses_are_short():
    assert called("https://host/hills/?list=1") == "hills"
