"""What is a photo: both programs see the same ones, and none that they have written."""

import itertools
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import skyline_viz as sv
from annotate.cli import main as annotate
from annotate.store.identity import scan
from skyline_viz.cli import main
from skyline_viz.datasets.tree import Tree, photos_below
from testing.datasets import MASK, PHOTO, put
from testing.exports import put as put_small


def below(folder):
    return [path.relative_to(folder).as_posix() for path in photos_below(folder)]


def touch(folder, *names):
    for name in names:
        put(folder / name)


def test_photos_are_found_below_without_truths_and_hidden_ones(tmp_path):
    touch(tmp_path, "b.png", "a/c.png", ".hidden/d.png", "masks/b.png", "a/c_mask.png")
    touch(tmp_path, "z/Ground_Truth/e.png", "a/.f.png", "a/knife_edge.png")
    (tmp_path / "words.txt").touch()
    assert below(tmp_path) == ["b.png", "a/c.png", "a/knife_edge.png"]
    assert Tree.of(tmp_path).said() == ()


def test_pictures_that_cannot_be_read_are_one_sentence(tmp_path):
    for name in ("a.nef", "x/b.jxl", ".git/c.psd"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    (said,) = Tree.of(tmp_path).said()
    assert said.startswith("2 files are no photos that can be read: a.nef (raw files of cameras")
    assert "x/b.jxl (JPEG XL)" in said


@pytest.mark.parametrize("images", ["images", "Photos", "img"])
def test_beside_truths_photos_are_those_of_images(tmp_path, images):
    touch(tmp_path, f"{images}/a.png", f"{images}/day/b.png", "preview.png", "small/a.png")
    assert len(below(tmp_path)) == 4
    touch(tmp_path, "masks/a.png")
    assert below(tmp_path) == [f"{images}/a.png", f"{images}/day/b.png"]
    (said,) = Tree.of(tmp_path).said()
    assert "not taken: 1 in the folder itself, 1 in small; name those" in said


def test_a_folder_of_skies_holds_truths_beside_images_only(tmp_path):
    touch(tmp_path, "sky/a.png")
    assert below(tmp_path) == ["sky/a.png"]
    touch(tmp_path, "images/a.png")
    assert below(tmp_path) == ["images/a.png"]


def test_an_original_is_the_photo_of_its_folder(tmp_path):
    touch(tmp_path, "images/n1/original.png", "images/n1/mask.png", "images/n1/small.png")
    touch(tmp_path, "images/n2/original.png", "images/n2/sky.png")
    assert below(tmp_path) == ["images/n1/original.png", "images/n2/original.png"]
    (said,) = Tree.of(tmp_path).said()
    assert "1 in images/n1" in said


def test_links_count_under_their_own_names_and_circles_end(tmp_path):
    touch(tmp_path, "in/a.png", "out/b.png")
    (tmp_path / "in" / "c.png").symlink_to("a.png")
    (tmp_path / "in" / "more").symlink_to("../out", target_is_directory=True)
    (tmp_path / "in" / "again").symlink_to(".", target_is_directory=True)
    (tmp_path / "out" / "back").symlink_to("../in", target_is_directory=True)
    assert below(tmp_path / "in") == ["a.png", "c.png", "more/b.png"]


@pytest.fixture
def labelled(tmp_path):
    """Two photos with masks in a folder."""
    for name in ("a", "b"):
        put(tmp_path / "in" / "images" / f"{name}.png", PHOTO.repeat(3, 0).repeat(3, 1))
        put(tmp_path / "in" / "masks" / f"{name}.png", MASK.repeat(3, 0).repeat(3, 1))
    return tmp_path / "in"


@pytest.mark.parametrize("place", ["results", ".", "images/results"])
def test_what_skyline_viz_writes_beside_photos_is_none(labelled, place, capsys):
    out = ["--out", str(labelled / place)]
    photos = ["images/a.png", "images/b.png"]
    assert main(["detect", str(labelled), "--mask", "--overlay", *out]) == 0
    assert below(labelled) == photos
    assert main(["evaluate", str(labelled), *out]) == 0
    assert main(["diagnose", str(labelled), "--no-remedies", *out]) == 0
    assert below(labelled) == photos
    dataset = sv.open_dataset(labelled)
    assert [item.truth_path.parent.name for item in dataset] == ["masks", "masks"]
    (said,) = dataset.left_out
    assert said.startswith("pictures written by skyline-viz are no photos: ")


@pytest.mark.parametrize("kind", ["mask", "painted", "ch1", "csv", "json", "coco", "labelme"])
@pytest.mark.parametrize("place", ["sent", "masks", "labels"])
def test_an_export_beside_photos_is_none(tmp_path, kind, place):
    folder = tmp_path / "in"
    for seed, name in enumerate(("a", "b")):
        put_small(folder, f"{name}.png", *MASK.repeat(3, 0).repeat(3, 1).shape[:2], seed)
        put(tmp_path / "masks" / f"{name}.png", MASK.repeat(3, 0).repeat(3, 1))
    accepted = ["--status", "accepted", "--annotator", "me"]
    assert annotate(["import", str(folder), str(tmp_path / "masks"), *accepted]) == 0
    before = below(folder)
    assert annotate(["export", str(folder), "--format", kind, "--out", str(folder / place)]) == 0
    assert below(folder) == before == ["a.png", "b.png"]
    assert len(sv.open_dataset(folder)) == 2
    assert [one.name for one in scan(folder, [])[0]] == before


NAMES = ["a.png", "a_mask.png", "images/a.png", "photos/b.png", "masks/a.png", "day/a.png"]
NAMES += ["day/masks/a.png", "n/original.png", "n/mask.png", "g/photo.jpg", "g/labels.png"]
NAMES += ["a-overlay.png", "sky/a.png", "day/images/c.png", "labels/x/a.png"]


@settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(chosen=st.sets(st.sampled_from(NAMES)))
def test_both_programs_see_the_same_photos(tmp_path_factory, chosen):
    folder = tmp_path_factory.mktemp("same")
    for number, name in zip(itertools.count(), sorted(chosen), strict=False):
        put_small(folder, name, seed=number)
    seen = {one.name for one in scan(folder, [])[0]}
    try:
        found = {item.photo_path for item in sv.open_dataset(folder)}
    except sv.DatasetError:
        found = set()
    assert {Path(path).relative_to(folder).as_posix() for path in found} == seen
