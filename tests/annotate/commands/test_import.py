"""``skyline-annotate import``, and commands that read truths, from the command line."""

import json

import numpy as np
import pytest

from annotate.cli import main as annotate
from annotate.store.store import Store
from skyline_viz.cli import main
from skyline_viz.datasets.layouts import open_dataset
from skyline_viz.datasets.tree import photos_below
from skyline_viz.photo import write_photo
from testing import label_files as made

FLAT = made.flat(made.outline())


@pytest.fixture
def photos(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in (made.NAME, "b.png"):
        photo = made.photo()
        photo[-1, -1] = len(name)  # a photo is known by its content
        write_photo(tmp_path / "photos" / name, photo)
    return tmp_path / "photos"


def lines_of(photos):
    store = Store(photos)
    try:
        return {one.name: one.skyline for one in store.labels("ann", 1)}
    finally:
        store.close()


def run(*words):
    return annotate(["import", "photos", *map(str, words), "--annotator", "ann"])


def test_a_file_with_one_bad_entry_is_imported_but_for_it(photos, capsys):
    document = made.coco([[FLAT], {"image_id": 2, "segmentation": [["x"] * 6]}])
    document["images"].append({"id": 2, "file_name": "b.png", "height": 120, "width": 160})
    made.written(photos.parent / "a.json", document)
    assert run("a.json") == 1
    said = capsys.readouterr()
    assert "1 label imported" in said.out
    assert "annotation 2 is left out: points are no pairs of numbers." in said.err
    assert list(lines_of(photos)) == [made.NAME]


def test_what_belongs_to_no_photo_is_said_and_is_no_failure(photos, capsys):
    made.SKYLINE.write_csv(photos.parent / "in" / "ridge.csv")
    made.SKYLINE.write_csv(photos.parent / "in" / "gone.csv")
    assert run("in") == 0
    assert "1 file belongs to no photo of the folder: gone.csv." in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "category"),
    [(("--label", "SKIES"), "skies"), (("--sky", "a,Skies"), "skies")],
)
def test_labels_are_named(photos, words, category):
    made.written(photos.parent / "a.json", made.coco([[FLAT]], category=category))
    assert run("a.json") == 2
    assert run("a.json", *words) == 0
    np.testing.assert_array_equal(lines_of(photos)[made.NAME].rows, made.ROWS)


def test_sky_and_terrain_are_not_both_said(photos, capsys):
    assert run("a.json", "--sky", "0", "--terrain", "1") == 2
    assert "exclude each other" in capsys.readouterr().err


@pytest.mark.parametrize("command", ["evaluate", "train", "diagnose", "inspect"])
def test_every_command_that_reads_truths_asks_and_is_answered(photos, command, capsys):
    (photos / "b.png").unlink()
    (photos / "masks").mkdir()
    made.ASK["palette of three"](photos / "masks").rename(photos / "masks" / "ridge_mask.png")
    words = {
        "evaluate": ["evaluate", "photos", "--workers", "1"],
        "train": ["train", "photos", "--out", "bank.npz", "--workers", "1"],
        "diagnose": ["diagnose", "photos", "--no-remedies", "--workers", "1"],
        "inspect": ["inspect", "photos", "--headless"],
    }[command]
    assert main(words) != 0
    assert "--sky #4682b4" in capsys.readouterr().err
    assert main([*words, "--sky", "#4682b4"]) == 0
    assert main([*words, "--terrain", "1,2"]) == 0


# Data sets


@pytest.mark.parametrize("place", ["masks", "ground_truth", "truth", "labels", "Labels"])
@pytest.mark.parametrize("added", ["", "_mask", "-mask", "_gt", "_truth", "_label", "-edge"])
def test_where_truths_are_found(photos, place, added):
    folder = photos / place
    folder.mkdir()
    made.SAME["white sky"](folder).rename(folder / f"ridge{added}.png")
    found = {item.name: item for item in open_dataset(photos)}
    assert found["ridge"].truth() == made.SKYLINE
    assert found["b"].truth() is None


def test_a_data_set_without_truths_says_what_they_would_be_called(photos, capsys):
    assert main(["evaluate", "photos"]) == 2
    said = capsys.readouterr().err
    assert "masks/" in said
    assert "b_mask.png" in said


def test_the_masks_of_a_data_set_are_no_photos_to_label(photos):
    for name in ("masks", "ground_truth", "elsewhere/masks", "day2"):
        (photos / name).mkdir(parents=True)
        made.SAME["white sky"](photos / name)
    made.SAME["white sky"](photos).rename(photos / "ridge_mask.png")
    made.SAME["white sky"](photos).rename(photos / "alone_mask.png")
    shown = [path.relative_to(photos).as_posix() for path in photos_below(photos)]
    assert shown == ["b.png", made.NAME, "day2/m.png"]


def test_label_files_of_other_programs_are_no_truths_and_are_named(photos):
    (photos / "labels").mkdir()
    (photos / "labels" / "ridge.json").write_text(json.dumps(made.labelme()))
    made.SAME["white sky"](photos / "labels").rename(photos / "labels" / "ridge.png")
    dataset = open_dataset(photos)
    assert {item.name: item.truth() for item in dataset} == {"b": None, "ridge": made.SKYLINE}
    assert "skyline-annotate import" in dataset.problems[0]


# What is said about truths and photos


def speckled(folder, name):
    sky = made.SKY.copy()
    sky[5:7, 20:23] = False
    write_photo(folder / name, np.where(sky, 0, 255).astype(np.uint8))
    return folder / name


COMMANDS = {
    "evaluate": ["evaluate", "photos", "--workers", "1"],
    "evaluate in processes": ["evaluate", "photos", "--workers", "2"],
    "cross-validate": ["evaluate", "photos", "--workers", "2", "--folds", "2"],
    "train": ["train", "photos", "--out", "bank.npz", "--workers", "1"],
    "diagnose": ["diagnose", "photos", "--no-remedies", "--workers", "1"],
    "inspect": ["inspect", "photos", "--headless"],
}


@pytest.mark.parametrize("command", COMMANDS)
def test_what_was_left_out_of_a_truth_is_said_once(photos, command, capsys):
    for name in ("ridge.png", "b.png"):
        speckled(photos / "masks", name)
    assert main(COMMANDS[command]) == 0
    said = [one for one in capsys.readouterr().err.splitlines() if "specks" in one]
    assert sorted(said) == [
        f"skyline-viz: photos/masks/{name}: specks above the line were left out in columns 20 to "
        f"22."
        for name in ("b.png", "ridge.png")
    ]


def test_what_was_left_out_of_a_truth_that_is_named_is_said(photos, capsys):
    speckled(photos.parent, "truth.png")
    words = ["inspect", "photos/ridge.png", "--truth", "truth.png", "--headless"]
    assert main(words) == 0
    told = "truth.png: specks above the line were left out in columns 20 to 22."
    assert capsys.readouterr().err.count(told) == 1


@pytest.mark.parametrize("command", ["evaluate", "train", "diagnose"])
def test_photos_that_cannot_be_read_are_named_with_the_reason(photos, command, capsys):
    speckled(photos / "masks", "ridge.png")
    (photos / "empty.png").touch()
    (photos / "torn.jpg").write_bytes(b"\xff\xd8\xff\xe0 and no more")
    assert main(COMMANDS[command]) == 0
    told = capsys.readouterr().err
    assert "empty.png is empty (0 bytes); it has no truth either." in told
    assert "torn.jpg" in told
    assert "left out, because there is no truth: b." in told


def test_masks_of_four_names_of_one_photo(photos, capsys):
    for name in ("c.png", "d.png"):
        (photos / name).write_bytes((photos / "b.png").read_bytes())
    for name in ("b.png", "c.png", "d.png"):
        speckled(photos.parent / "in", name)
    assert run("in") == 0
    said = capsys.readouterr()
    assert "1 label imported" in said.out
    assert "c.png, d.png are the same photo as b.png, and one label of it is kept." in said.err
    assert "belong" not in said.err
