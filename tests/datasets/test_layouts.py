"""Opening data sets: the published layouts, plain folders, and everything that does not fit."""

import dataclasses
import json
import os
import shutil

import numpy as np
import pytest
from PIL import Image

import skyline_viz as sv
from skyline_viz import photo
from skyline_viz.datasets import layouts as datasets
from skyline_viz.datasets.layouts import DatasetError

HEIGHT, WIDTH = 16, 24
ROWS = np.arange(WIDTH) % 5 + 4
SKYLINE = sv.Skyline(ROWS)
PHOTO = np.full((HEIGHT, WIDTH, 3), (90, 120, 150), np.uint8)
PHOTO[SKYLINE.to_mask(HEIGHT)] = (200, 210, 230)
PAINTED = SKYLINE.to_painted(PHOTO, "red")
MASK = np.where(SKYLINE.to_mask(HEIGHT), 0, 255).astype(np.uint8)
NOISE = np.random.default_rng(0).integers(0, 256, (HEIGHT, WIDTH, 3), np.uint8)


def put(path, pixels=PHOTO, **options):
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.ascontiguousarray(pixels)).save(path, **options)
    return path


def names(dataset):
    return [item.name for item in dataset]


def only(dataset):
    assert len(dataset) == 1
    assert dataset.problems == ()
    return dataset.items[0]


def basalt(root, count=3):
    for number in range(1, count + 1):
        put(root / "images" / f"marsim{number:04}.pgm", PHOTO[:, :, 1])
        line = sv.Skyline(np.full(WIDTH, number)).to_painted(NOISE)
        put(root / "ground_truth" / f"GT_marsim{number:03}_Edge.bmp", line)


def web(root, count=3):
    for number in range(1, count + 1):
        put(root / "images" / f"R_GImag{number:04}.bmp")
        line = sv.Skyline(np.full(WIDTH, number)).to_painted(NOISE, "blue")
        put(root / "ground_truth" / f"GT_GoogleImage{number:03}_Edge.bmp", line)


def ch1(root):
    for part, name in [("cvg", "IMG_1.jpg"), ("panoramio", "IMG_1.jpg"), ("cvg", "b.png")]:
        stem, ending = name.split(".")
        put(root / part / "images" / name)
        put(root / part / "ground_truth" / f"{stem}-mask.{ending}", MASK)
    put(root / "poor_edge_images" / "images" / "c.jpg")


def geopose3k(root):
    sky = SKYLINE.to_mask(HEIGHT)
    labels = np.where(sky[:, :, None], 0, np.array([97, 89, 87])).astype(np.uint8)
    labels[12:, :, :] = (118, 219, 99)
    alpha = np.full((HEIGHT, WIDTH, 1), 255, np.uint8)
    put(root / "flickr_1@N00" / "photo.jpg")
    put(root / "flickr_1@N00" / "labels.png", labels)
    put(root / "flickr_2@N00" / "photo.jpeg")
    put(root / "flickr_2@N00" / "pinhole" / "labels_crop.png", np.dstack([labels, alpha]))
    put(root / "flickr_2@N00" / "cyl" / "labels_crop.png", labels[:10])
    put(root / "flickr_3@N00" / "photo.jpg")
    (root / "README.txt").touch()


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


def test_numbers_are_matched_and_not_positions(tmp_path):
    web(tmp_path, count=4)
    (tmp_path / "ground_truth" / "GT_GoogleImage002_Edge.bmp").unlink()
    (tmp_path / "images" / "R_GImag0003.bmp").unlink()
    dataset = sv.open_dataset(tmp_path)
    first, second, fourth = dataset
    assert first.truth() == sv.Skyline(np.full(WIDTH, 1))
    assert second.truth() is None
    assert fourth.truth() == sv.Skyline(np.full(WIDTH, 4))
    truth = os.path.join("ground_truth", "GT_GoogleImage003_Edge.bmp")  # noqa: PTH118
    assert dataset.problems == (f"{truth} has no photo.",)


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


# Plain folders


@pytest.mark.parametrize("photos", ["images", "IMAGES", "."])
@pytest.mark.parametrize("truths", ["masks", "ground_truth", "Masks"])
@pytest.mark.parametrize("added", ["", "-mask", "_mask", "_Edge", "-MASK"])
def test_where_a_truth_may_lie_and_how_it_may_be_called(tmp_path, photos, truths, added):
    put(tmp_path / photos / "a b.PNG")
    put(tmp_path / truths / f"a b{added}.Bmp", PAINTED)
    item = only(sv.open_dataset(tmp_path))
    assert item.name == "a b"
    assert item.truth() == SKYLINE


@pytest.mark.parametrize("photos", ["images", "."])
@pytest.mark.parametrize("name", ["a-mask.png", "a_mask.jpg", "a_Edge.bmp", "a_edge.png"])
def test_a_picture_beside_the_photo(tmp_path, photos, name):
    put(tmp_path / photos / "a.jpg")
    put(tmp_path / photos / name, MASK, **({"quality": 100} if name.endswith("jpg") else {}))
    item = only(sv.open_dataset(tmp_path))
    assert item.photo_path.name == "a.jpg"
    assert item.truth() == SKYLINE


@pytest.mark.parametrize("place", ["images", "masks", "ground_truth"])
@pytest.mark.parametrize("ending", ["csv", "json", "CSV", "JSON"])
def test_a_skyline_file(tmp_path, place, ending):
    truth = sv.Skyline(ROWS + 0.25, np.arange(WIDTH) > 3)
    put(tmp_path / "images" / "a.jpg")
    (tmp_path / place).mkdir(exist_ok=True)
    write = truth.write_csv if ending.lower() == "csv" else truth.write_json
    write(tmp_path / place / f"a.{ending}")
    assert only(sv.open_dataset(tmp_path)).truth() == truth


def test_other_tables_beside_photos_are_nobodys_truth(tmp_path):
    put(tmp_path / "a.jpg")
    put(tmp_path / "b.jpg")
    (tmp_path / "a.csv").write_text("latitude,longitude\n46.5,8.0\n")
    (tmp_path / "a.json").write_text(json.dumps({"version": "5.0", "shapes": []}))
    (tmp_path / "photos.csv").write_text("name\na\nb\n")
    dataset = sv.open_dataset(tmp_path)
    assert [item.truth() for item in dataset] == [None, None]
    assert dataset.problems == ()


def test_a_closed_table_beside_photos_is_nobodys_truth(tmp_path, monkeypatch):
    put(tmp_path / "a.jpg")
    SKYLINE.write_csv(tmp_path / "a.csv")
    real = type(tmp_path).open

    def closed(path, *args, **kwargs):
        if path.suffix == ".csv":
            raise PermissionError(13, "Permission denied")
        return real(path, *args, **kwargs)

    monkeypatch.setattr(type(tmp_path), "open", closed)
    assert only(sv.open_dataset(tmp_path)).truth() is None


def test_items_are_sorted_by_name_and_not_by_file(tmp_path):
    for name in ("a-b.jpg", "a.jpg", "B.jpg", "a1.jpg"):
        put(tmp_path / name)
    assert names(sv.open_dataset(tmp_path)) == ["B", "a", "a-b", "a1"]


def test_a_photo_called_knife_edge_is_a_photo(tmp_path):
    put(tmp_path / "knife_edge.jpg")
    assert names(sv.open_dataset(tmp_path)) == ["knife_edge"]
    put(tmp_path / "masks" / "knife_edge.png", MASK)
    assert only(sv.open_dataset(tmp_path)).truth() == SKYLINE


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


def test_truths_without_photo_are_named_and_the_rest_goes_on(tmp_path):
    put(tmp_path / "images" / "a.png")
    put(tmp_path / "masks" / "a.png", MASK)
    put(tmp_path / "masks" / "lost.png", MASK)
    put(tmp_path / "images" / "alone-mask.png", MASK)
    SKYLINE.write_csv(tmp_path / "ground_truth" / "gone.csv")
    SKYLINE.write_json(tmp_path / "images" / "nobody.json")
    dataset = sv.open_dataset(tmp_path)
    assert names(dataset) == ["a"]
    assert dataset.items[0].truth() == SKYLINE
    assert len(dataset.problems) == 4
    for name in ("lost.png", "alone-mask.png", "gone.csv", "nobody.json"):
        assert sum(name in problem for problem in dataset.problems) == 1
    assert all(problem.endswith(" has no photo.") for problem in dataset.problems)


@pytest.mark.parametrize("kind", ["mask", "painted", "csv", "json"])
def test_a_truth_of_another_size_is_named_and_left_out(tmp_path, kind):
    put(tmp_path / "images" / "a.png")
    put(tmp_path / "images" / "b.png")
    put(tmp_path / "masks" / "b.png", MASK)
    if kind == "mask":
        put(tmp_path / "masks" / "a.png", MASK[:12])
    elif kind == "painted":
        put(tmp_path / "masks" / "a.png", PAINTED[:, :20])
    else:
        short = sv.Skyline(ROWS[:20])
        (short.write_csv if kind == "csv" else short.write_json)(tmp_path / "masks" / f"a.{kind}")
    dataset = sv.open_dataset(tmp_path)
    assert [item.truth() for item in dataset] == [None, SKYLINE]
    (problem,) = dataset.problems
    sizes = {
        "mask": ("24x12 pixels", "24x16"),
        "painted": ("20x16 pixels", "24x16"),
        "csv": ("20 columns", "24"),
        "json": ("20 columns", "24"),
    }
    found, wanted = sizes[kind]
    assert f"a.{'png' if kind in ('mask', 'painted') else kind} has {found}" in problem
    assert problem.endswith(f"and its photo {wanted}.")


def test_sizes_are_those_of_the_upright_photo(tmp_path):
    exif = Image.Exif()
    exif[0x0112] = 6
    put(tmp_path / "a.jpg", np.rot90(PHOTO), exif=exif)
    put(tmp_path / "masks" / "a.png", MASK)
    item = only(sv.open_dataset(tmp_path))
    assert item.photo().shape == PHOTO.shape
    assert item.truth() == SKYLINE


def test_of_several_truths_the_most_exact_counts(tmp_path):
    put(tmp_path / "a.jpg")
    put(tmp_path / "ground_truth" / "a_Edge.bmp", sv.Skyline(ROWS + 1).to_painted(NOISE))
    SKYLINE.write_csv(tmp_path / "masks" / "a.csv")
    dataset = sv.open_dataset(tmp_path)
    assert dataset.items[0].truth() == SKYLINE
    (problem,) = dataset.problems
    assert "a_Edge.bmp is not used" in problem
    assert "a.csv is there" in problem


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
        (
            lambda path: put(path / "holiday" / "a.png"),
            "holds no photograph itself, but folders in it do: holiday (1); name those",
        ),
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

    monkeypatch.setattr(datasets, "_folders", closed)
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

    monkeypatch.setattr(datasets, "find_photos", guarded)
    monkeypatch.setattr(os, "access", lambda path, mode: path.name != "lost+found")
    assert names(sv.open_dataset(tmp_path)) == ["a"]


# How a truth is read


def truth_of(folder, pixels, name="a.png", **options):
    """The truth that a picture is read as."""
    shutil.rmtree(folder / "masks", ignore_errors=True)
    put(folder / "a.png")
    put(folder / "masks" / name, pixels, **options)
    return only(sv.open_dataset(folder)).truth()


@pytest.mark.parametrize("ending", ["png", "bmp", "pgm", "tif"])
def test_masks_come_back_exactly(tmp_path, ending):
    assert truth_of(tmp_path, MASK, f"a.{ending}") == SKYLINE


@pytest.mark.parametrize(
    "pixels",
    [
        MASK.repeat(3).reshape(HEIGHT, WIDTH, 3),  # RGB
        np.dstack([MASK, MASK, MASK, np.full_like(MASK, 255)]),  # RGBA
        np.dstack([MASK // 255 * 250, MASK // 255 * 235, MASK]),  # tinted
        MASK > 0,  # one bit
        (MASK.astype(np.uint16) << 8) | MASK,  # 16 bits
        np.where(MASK > 0, 128, 127).astype(np.uint8),  # pale
    ],
)
def test_masks_of_every_kind(tmp_path, pixels):
    assert truth_of(tmp_path, pixels) == SKYLINE


@pytest.mark.parametrize("mode", ["L", "RGB"])
def test_jpeg_masks_are_cut_at_128(tmp_path, mode):
    pixels = np.array(Image.fromarray(MASK).convert(mode))
    rows = truth_of(tmp_path, pixels, "a.jpg", quality=92).rows
    assert np.abs(rows - ROWS).max() <= 1


def test_soft_edges_are_cut_at_128(tmp_path):
    soft = MASK.copy()
    soft[ROWS - 1, np.arange(WIDTH)] = 127
    assert truth_of(tmp_path, soft) == SKYLINE
    soft[ROWS - 1, np.arange(WIDTH)] = 128
    assert truth_of(tmp_path, soft) == sv.Skyline(ROWS - 1)


@pytest.mark.parametrize("row", [0, HEIGHT])
def test_masks_all_sky_or_all_terrain(tmp_path, row):
    skyline = sv.Skyline(np.full(WIDTH, row))
    mask = np.where(skyline.to_mask(HEIGHT), 0, 255).astype(np.uint8)
    assert truth_of(tmp_path, mask) == skyline


def test_a_lake_or_a_gap_in_the_rock_does_not_count(tmp_path):
    mask = MASK.copy()
    mask[12:14, 3:9] = 0
    assert truth_of(tmp_path, mask) == SKYLINE


@pytest.mark.parametrize("paint", ["red", "blue"])
@pytest.mark.parametrize("colour", [True, False])
def test_painted_photos_come_back_exactly(tmp_path, paint, colour):
    visible = np.arange(WIDTH) % 7 > 0
    under = PHOTO if colour else PHOTO[:, :, :1].repeat(3, axis=2)
    found = truth_of(tmp_path, sv.Skyline(ROWS, visible).to_painted(under, paint))
    assert np.array_equal(found.visible, visible)
    assert np.array_equal(found.rows[visible], ROWS[visible])


@pytest.mark.parametrize(
    ("pixels", "reason"),
    [
        (NOISE, "no pixel is painted"),
        (NOISE[:, :, :1].repeat(3, axis=2) // 4 * 2, "brightest value is 126"),
        (NOISE[:, :, :1].repeat(3, axis=2), "neither painted nor a mask"),
        (np.repeat(np.uint8([255, 0]), [15, 1])[:, None].repeat(WIDTH, axis=1), "neither painted"),
    ],
)
def test_a_picture_that_is_no_truth_is_refused(tmp_path, pixels, reason):
    with pytest.raises(sv.SkylineError, match=reason) as caught:
        truth_of(tmp_path, pixels)
    assert str(caught.value).startswith(f"{tmp_path / 'masks' / 'a.png'} is no truth: ")
    assert str(caught.value).endswith(".")


def test_a_mask_of_numbers_of_another_size_than_its_photo_is_named(tmp_path):
    put(tmp_path / "images" / "a.png")
    (tmp_path / "masks").mkdir()
    for height, problems in ((HEIGHT, 0), (HEIGHT // 2, 1)):
        mask = np.zeros((height, WIDTH), np.float32)
        mask[height // 2 :] = 1
        Image.fromarray(mask).save(tmp_path / "masks" / "a.tif")
        dataset = sv.open_dataset(tmp_path)
        assert len(dataset.problems) == problems
        assert (dataset.items[0].truth_path is None) == bool(problems)
