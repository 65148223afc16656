"""Opening data sets: the published layouts, plain folders, and everything that does not fit."""

import dataclasses
import os

import numpy as np
import pytest
from PIL import Image

import skyline_viz as sv
from skyline_viz import photo
from skyline_viz.datasets import tree
from skyline_viz.datasets.dataset import DatasetError
from skyline_viz.datasets.layouts import open_datasets
from testing.datasets import (
    HEIGHT,
    MASK,
    PHOTO,
    ROWS,
    SKYLINE,
    WIDTH,
    basalt,
    ch1,
    geopose3k,
    names,
    only,
    put,
    web,
)

# The interface


def test_every_item_has_a_name_a_photo_and_a_truth(tmp_path):
    put(tmp_path / "images" / "a.png")
    put(tmp_path / "images" / "b.png")
    put(tmp_path / "masks" / "b.png", MASK)
    dataset = sv.open_dataset(str(tmp_path))
    assert len(dataset) == 2
    assert dataset.layout == "plain"
    assert dataset.name == tmp_path.name
    first, second = dataset
    assert (first.name, second.name) == ("a", "b")
    assert np.array_equal(first.photo(), PHOTO)
    assert first.truth() is None
    assert second.truth() == SKYLINE
    assert tuple(dataset) == dataset.items


def test_nothing_can_be_changed(tmp_path):
    put(tmp_path / "a.png")
    dataset = sv.open_dataset(tmp_path)
    for thing, field in ((dataset, "name"), (dataset.items[0], "name")):
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(thing, field, "b")


def test_opening_reads_no_pixels(tmp_path, monkeypatch):
    for layout in (basalt, web, ch1, geopose3k):
        layout(tmp_path / layout.__name__)
    Image.init()  # decodes pictures of its own
    monkeypatch.setattr(Image.Image, "load", lambda self: pytest.fail("decoded"))
    for layout in (basalt, web, ch1, geopose3k):
        dataset = sv.open_dataset(tmp_path / layout.__name__)
        assert dataset.problems == ()
        assert any(item.truth_path for item in dataset)


# Published layouts


@pytest.mark.parametrize("folder", ["Basalt", "."])
def test_basalt(tmp_path, folder):
    basalt(tmp_path / "Basalt", count=11)
    dataset = sv.open_dataset(tmp_path / folder)
    assert (dataset.name, dataset.layout, dataset.problems) == ("Basalt", "Basalt", ())
    assert names(dataset) == [f"marsim{number:04}" for number in range(1, 12)]
    for number, item in enumerate(dataset, start=1):
        assert item.photo().shape == (HEIGHT, WIDTH, 3)
        assert item.truth() == sv.Skyline(np.full(WIDTH, number))


@pytest.mark.parametrize("folder", ["web_dataset", "."])
def test_web(tmp_path, folder):
    web(tmp_path / "web_dataset")
    dataset = sv.open_dataset(tmp_path / folder)
    assert (dataset.name, dataset.layout, dataset.problems) == ("web_dataset", "Web", ())
    assert names(dataset) == ["R_GImag0001", "R_GImag0002", "R_GImag0003"]
    for number, item in enumerate(dataset, start=1):
        assert item.truth() == sv.Skyline(np.full(WIDTH, number))


@pytest.mark.parametrize("folder", ["CH1", "."])
def test_ch1(tmp_path, folder):
    ch1(tmp_path / "CH1")
    dataset = sv.open_dataset(tmp_path / folder)
    assert (dataset.name, dataset.layout, dataset.problems) == ("CH1", "CH1", ())
    assert names(dataset) == ["cvg/IMG_1", "cvg/b", "panoramio/IMG_1", "poor_edge_images/c"]
    truths = [item.truth() for item in dataset]
    assert truths == [SKYLINE, SKYLINE, SKYLINE, None]


def test_one_part_of_ch1_is_a_plain_folder(tmp_path):
    ch1(tmp_path)
    dataset = sv.open_dataset(tmp_path / "cvg")
    assert names(dataset) == ["IMG_1", "b"]
    assert [item.truth() for item in dataset] == [SKYLINE, SKYLINE]


@pytest.mark.parametrize("folder", ["geoPose3K", "."])
def test_geopose3k(tmp_path, folder):
    geopose3k(tmp_path / "geoPose3K")
    dataset = sv.open_dataset(tmp_path / folder)
    assert (dataset.name, dataset.layout, dataset.problems) == ("geoPose3K", "GeoPose3K", ())
    assert names(dataset) == ["flickr_1@N00", "flickr_2@N00", "flickr_3@N00"]
    assert [item.truth() for item in dataset] == [SKYLINE, SKYLINE, None]
    assert dataset.items[1].photo().shape == (HEIGHT, WIDTH, 3)


def test_one_folder_of_geopose3k(tmp_path):
    geopose3k(tmp_path)
    item = only(sv.open_dataset(tmp_path / "flickr_1@N00"))
    assert item.name == "flickr_1@N00"
    assert item.truth() == SKYLINE


def test_the_folder_of_one_photo_may_be_here(tmp_path, monkeypatch):
    geopose3k(tmp_path)
    monkeypatch.chdir(tmp_path / "flickr_1@N00")
    assert names(sv.open_dataset(".")) == ["flickr_1@N00"]


def test_loose_pictures_beside_geopose3k_do_not_hide_it(tmp_path):
    geopose3k(tmp_path)
    put(tmp_path / "preview.jpg")
    assert sv.open_dataset(tmp_path).layout == "GeoPose3K"


def test_photos_called_photo_and_label_are_not_geopose3k(tmp_path):
    put(tmp_path / "a" / "images" / "photo.jpg")
    put(tmp_path / "a" / "images" / "label.jpg")
    dataset = sv.open_dataset(tmp_path / "a")
    assert dataset.layout == "plain"
    assert names(dataset) == ["label", "photo"]


def test_geopose3k_columns_without_skyline_are_not_visible(tmp_path):
    labels = np.where(SKYLINE.to_mask(HEIGHT)[:, :, None], 0, PHOTO).astype(np.uint8)
    labels[:, 0] = 99
    labels[:, 1] = 0
    put(tmp_path / "a" / "photo.jpg")
    put(tmp_path / "a" / "labels.png", labels)
    truth = only(sv.open_dataset(tmp_path)).truth()
    assert truth.visible.tolist() == [False, False] + [True] * (WIDTH - 2)
    assert np.array_equal(truth.rows[2:], ROWS[2:])


def test_geopose3k_without_any_sky_is_no_truth(tmp_path):
    put(tmp_path / "a" / "photo.jpg")
    labels = put(tmp_path / "a" / "labels.png", PHOTO)
    with pytest.raises(sv.SkylineError, match="no column holds both sky") as caught:
        only(sv.open_dataset(tmp_path)).truth()
    assert str(labels) in str(caught.value)


def test_geopose3k_labels_of_another_size_or_without_photo(tmp_path):
    geopose3k(tmp_path)
    put(tmp_path / "flickr_1@N00" / "labels.png", PHOTO[:8])
    (tmp_path / "flickr_2@N00" / "photo.jpeg").unlink()
    dataset = sv.open_dataset(tmp_path)
    assert [item.truth() for item in dataset] == [None, None]
    assert len(dataset.problems) == 2
    assert "flickr_1@N00" in dataset.problems[0]
    assert "24x8 pixels, and its photo 24x16" in dataset.problems[0]
    assert "flickr_2@N00" in dataset.problems[1]
    assert "has no photo" in dataset.problems[1]


def test_several_data_sets_in_one_folder(tmp_path):
    basalt(tmp_path / "Basalt")
    ch1(tmp_path / "CH1")
    with pytest.raises(DatasetError, match="several data sets, Basalt, CH1; open one") as caught:
        sv.open_dataset(tmp_path)
    assert str(tmp_path) in str(caught.value)
    assert [one.name for one in open_datasets(tmp_path)] == ["Basalt", "CH1"]


# Plain folders


def test_the_only_folder_with_photos_is_the_data_set(tmp_path):
    put(tmp_path / "set" / "holiday" / "a.png")
    put(tmp_path / "set" / "holiday" / "lake" / "b.png")
    dataset = sv.open_dataset(tmp_path / "set")
    assert (dataset.name, names(dataset)) == ("holiday", ["a", "lake/b"])


def test_photos_of_all_folders_are_taken(tmp_path):
    for name in ("top.png", "day1/a.png", "day2/a.png", "day2/far/images/a.png"):
        put(tmp_path / name)
    put(tmp_path / "day2" / "masks" / "a.png", MASK)
    dataset = sv.open_dataset(tmp_path)
    assert names(dataset) == ["day1/a", "day2/a", "day2/far/a", "top"]
    assert [item.truth_path is not None for item in dataset] == [False, True, False, False]


def test_items_are_sorted_by_name_and_not_by_file(tmp_path):
    for name in ("a-b.jpg", "a.jpg", "B.jpg", "a1.jpg"):
        put(tmp_path / name)
    assert names(sv.open_dataset(tmp_path)) == ["B", "a", "a-b", "a1"]


def test_photos_of_one_stem_keep_their_endings(tmp_path):
    put(tmp_path / "a.jpg")
    put(tmp_path / "a.png")
    put(tmp_path / "b.png")
    put(tmp_path / "masks" / "a.png", MASK)
    dataset = sv.open_dataset(tmp_path)
    assert names(dataset) == ["a.jpg", "a.png", "b"]
    assert [item.truth() for item in dataset] == [SKYLINE, SKYLINE, None]


def test_hidden_files_and_other_files_are_ignored(tmp_path):
    put(tmp_path / "images" / "a.png")
    put(tmp_path / "masks" / "a.png", MASK)
    for place in ("images", "masks"):
        for name in (".DS_Store", "Thumbs.db", "._a.png", ".hidden.png", "._a.csv", "notes.txt"):
            (tmp_path / place / name).write_bytes(b"\0\5\26\7")
    put(tmp_path / ".git" / "photo.jpg")
    assert only(sv.open_dataset(tmp_path)).truth() == SKYLINE


def test_links_are_followed(tmp_path):
    put(tmp_path / "elsewhere" / "x.png")
    put(tmp_path / "elsewhere" / "m.png", MASK)
    (tmp_path / "set" / "masks").mkdir(parents=True)
    (tmp_path / "set" / "a.png").symlink_to(tmp_path / "elsewhere" / "x.png")
    (tmp_path / "set" / "masks" / "a.png").symlink_to(tmp_path / "elsewhere" / "m.png")
    (tmp_path / "set" / "gone.png").symlink_to(tmp_path / "nothing.png")
    (tmp_path / "link").symlink_to(tmp_path / "set", target_is_directory=True)
    dataset = sv.open_dataset(tmp_path / "link")
    assert dataset.name == "link"
    assert only(dataset).name == "a"
    assert only(dataset).truth() == SKYLINE


def test_photos_beside_an_empty_images_folder(tmp_path):
    put(tmp_path / "a.png")
    (tmp_path / "images").mkdir()
    assert names(sv.open_dataset(tmp_path)) == ["a"]


def test_the_folder_may_be_here(tmp_path, monkeypatch):
    put(tmp_path / "mine" / "a.png")
    monkeypatch.chdir(tmp_path / "mine")
    assert sv.open_dataset(".").name == "mine"


# What does not fit


@pytest.mark.parametrize("name", ["a.png", "a.jpg", "a.bmp", "a.csv", "a.json"])
@pytest.mark.parametrize(
    "content", [b"", b"damaged", b"\x89PNG\r\n\x1a\n", b"column,row,visible\n9"]
)
def test_a_damaged_truth_is_named_when_it_is_read(tmp_path, name, content):
    put(tmp_path / "images" / "a.png")
    put(tmp_path / "images" / "b.png")
    put(tmp_path / "masks" / "b.png", MASK)
    damaged = tmp_path / "masks" / name
    damaged.write_bytes(content)
    first, second = sv.open_dataset(tmp_path)
    with pytest.raises(sv.SkylineError) as caught:
        first.truth()
    assert str(damaged) in str(caught.value)
    assert second.truth() == SKYLINE


def test_a_truncated_mask_is_named(tmp_path):
    put(tmp_path / "a.png")
    damaged = put(tmp_path / "masks" / "a.bmp", MASK)
    damaged.write_bytes(damaged.read_bytes()[:-50])
    with pytest.raises(sv.SkylineError, match=r"a\.bmp is damaged"):
        only(sv.open_dataset(tmp_path)).truth()


@pytest.mark.parametrize("name", ["a.csv", "a.png"])
def test_a_truth_that_vanished_is_named(tmp_path, name):
    put(tmp_path / "a.jpg")
    truth = tmp_path / "masks" / name
    put(truth, MASK) if name.endswith("png") else SKYLINE.write_csv(truth)
    item = only(sv.open_dataset(tmp_path))
    truth.unlink()
    with pytest.raises(sv.SkylineError, match=r"(?i)no such file"):
        item.truth()


def test_a_damaged_photo_stays_and_says_so(tmp_path):
    (tmp_path / "a.jpg").write_bytes(b"damaged")
    put(tmp_path / "b.jpg")
    put(tmp_path / "masks" / "a.png", MASK)
    first, second = sv.open_dataset(tmp_path)
    with pytest.raises(sv.PhotoError, match=r"a\.jpg"):
        first.photo()
    assert second.photo().shape == PHOTO.shape


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (lambda path: None, "does not exist"),
        (lambda path: path.touch(), "is a file, not a folder"),
        (lambda path: path.mkdir(), "holds no photograph"),
        (lambda path: put(path / "masks" / "a.png", MASK), "holds no photograph"),
        (lambda path: put(path / "images" / "a-mask.png", MASK), "holds no photograph"),
    ],
)
def test_what_is_no_data_set(tmp_path, make, reason):
    make(tmp_path / "set")
    with pytest.raises(DatasetError) as caught:
        sv.open_dataset(tmp_path / "set")
    assert str(caught.value) == f"{tmp_path / 'set'} {reason}."
    assert isinstance(caught.value, ValueError)


def test_a_folder_that_may_not_be_listed(tmp_path, monkeypatch):
    def closed(folder):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(tree, "folders_in", closed)
    with pytest.raises(DatasetError, match="cannot be read: permission denied"):
        sv.open_dataset(tmp_path)


def test_a_closed_folder_inside_does_not_stop_the_rest(tmp_path, monkeypatch):
    put(tmp_path / "a.png")
    (tmp_path / "lost+found").mkdir()
    find = photo.find_photos

    def guarded(folder):
        if folder.name == "lost+found":
            raise PermissionError(13, "Permission denied")
        return find(folder)

    monkeypatch.setattr(tree, "find_photos", guarded)
    monkeypatch.setattr(os, "access", lambda path, mode: path.name != "lost+found")
    assert names(sv.open_dataset(tmp_path)) == ["a"]


# How a truth is read


def test_one_photo_with_a_published_name_makes_no_published_data_set(tmp_path):
    for name in ("marsim0001.png", "eiger.png", "jungfrau.png"):
        put(tmp_path / "images" / name)
    assert sv.open_dataset(tmp_path).layout == "plain"


def test_photos_in_hidden_folders_are_not_mentioned(tmp_path):
    put(tmp_path / "a.png")
    put(tmp_path / ".thumbnails" / "a.png")
    assert sv.open_dataset(tmp_path).left_out == ()
    assert names(sv.open_dataset(tmp_path)) == ["a"]


def test_a_folder_of_a_storage_is_opened_as_a_copy(tmp_path, memory, monkeypatch):
    monkeypatch.setenv("SKYLINE_VIZ_CACHE", str(tmp_path / "caches"))
    memory.pipe_file("/hills/a.png", put(tmp_path / "a.png").read_bytes())
    memory.pipe_file("/hills/masks/a.png", put(tmp_path / "a_mask.png", MASK).read_bytes())
    (item,) = (dataset := sv.open_dataset("memory://hills"))
    assert (dataset.name, item.name, item.truth()) == ("hills", "a", SKYLINE)
    memory.pipe_file("/texts/a.txt", b"x")
    with pytest.raises(sv.DatasetError, match=r"^memory://texts holds no photograph"):
        sv.open_dataset("memory://texts")
