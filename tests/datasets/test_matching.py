"""Which truth belongs to which photo, and what is said about those that belong to none."""

import json
import os

import numpy as np
import pytest
from PIL import Image

import skyline_viz as sv
from testing.datasets import (
    HEIGHT,
    MASK,
    NOISE,
    PAINTED,
    PHOTO,
    ROWS,
    SKYLINE,
    WIDTH,
    names,
    only,
    put,
    web,
)


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


def test_a_photo_called_knife_edge_is_a_photo(tmp_path):
    put(tmp_path / "knife_edge.jpg")
    assert names(sv.open_dataset(tmp_path)) == ["knife_edge"]
    put(tmp_path / "masks" / "knife_edge.png", MASK)
    assert only(sv.open_dataset(tmp_path)).truth() == SKYLINE


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
