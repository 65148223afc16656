"""Which photo of a folder a label file means."""

import random
import shutil

import numpy as np
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from annotate.formats import FORMATS, export_labels, import_labels
from annotate.store.labels import Label
from skyline_viz.datasets.tree import photos_below
from skyline_viz.photo import write_photo
from skyline_viz.skyline import Skyline
from testing import label_files as made
from testing.examples import examples
from testing.imports import imported, is_right, said_about
from testing.label_documents import FLAT, LEFT, RIGHT
from testing.label_files import NAME, SKYLINE, coco

FEW = examples(30, suppress_health_check=[HealthCheck.function_scoped_fixture])


def test_files_of_no_photo_are_named(tmp_path, photos):
    for stem in ("ridge", "gone", "lost"):
        SKYLINE.write_csv(tmp_path / "in" / f"{stem}.csv")
    found = is_right(imported(tmp_path / "in", photos))
    assert found.notes == ("2 files belong to no photo of the folder: gone.csv, lost.csv.",)
    (tmp_path / "in" / "ridge.csv").unlink()
    assert "gone.csv, lost.csv" in said_about(tmp_path / "in", photos)


def test_a_name_that_could_mean_two_photos_is_not_guessed(tmp_path, photos):
    for name in ("x/a.png", "y/a.png"):
        write_photo(photos / name, made.photo())
    names = [NAME, "x/a.png", "y/a.png"]
    document = coco([[FLAT]], name="elsewhere/a.png")
    assert "could be any of x/a.png, y/a.png" in said_about(
        made.written(tmp_path / "a.json", document), photos, names
    )
    document = coco([[FLAT]], name="C:\\all\\x\\a.png")
    is_right(imported(made.written(tmp_path / "a.json", document), photos, names), "x/a.png")


def test_two_labels_that_could_only_be_one_photo_are_not_united(tmp_path, photos):
    document = coco([[made.flat(LEFT)], {"image_id": 2, "segmentation": [made.flat(RIGHT)]}])
    document["images"].append(document["images"][0] | {"id": 2, "file_name": f"day2/{NAME}"})
    document["images"][0]["file_name"] = f"day1/{NAME}"
    said = said_about(made.written(tmp_path / "a.json", document), photos)
    assert f"day1/{NAME} and day2/{NAME} could all be {NAME}" in said


NAMES = st.text(
    st.characters(blacklist_characters="/\0", blacklist_categories=["Cs"]), min_size=1, max_size=12
).filter(lambda name: not name.startswith(".") and len(name.encode()) < 100)


@examples(15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_exports_come_back_whatever_the_photos_are_called(tmp_path, data):
    root = tmp_path / str(random.random())
    few = st.sampled_from(["a", "A", "a.png", "a_mask", "a-1", "a.", "a,b", "a_b", "é", "e\u0301"])
    stems = data.draw(st.lists(st.one_of(few, NAMES), min_size=1, max_size=5, unique=True))
    photos, labels = root / "photos", []
    pixels = np.zeros((16, 24, 3), np.uint8)
    for stem in stems:
        place = data.draw(st.sampled_from(["", "", "x/", "y/"]))
        write_photo(photos / f"{place}{stem}{data.draw(st.sampled_from(['.png', '.bmp']))}", pixels)
    names = [path.relative_to(photos).as_posix() for path in photos_below(photos)]
    for number, name in enumerate(names):
        labels.append(
            Label(
                name,
                "",
                24,
                16,
                "ann",
                1,
                "accepted",
                (),
                Skyline(np.full(24, 2 + number)),
                np.zeros(24, np.uint8),
                (),
                0.0,
                "",
                False,
            )
        )
    if not labels:
        return
    for kind in FORMATS:
        export_labels(labels, photos, root / kind, kind)
        found = import_labels(root / kind, photos, names, kind)
        assert {one.name: one.skyline.rows[0] for one in found} == {
            name: 2 + number for number, name in enumerate(names)
        }
    shutil.rmtree(root)
