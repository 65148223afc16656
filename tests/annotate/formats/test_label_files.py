"""Label files of other programs: read rightly, or refused with what was found in them."""

import random

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from annotate.formats import FormatError
from skyline_viz.photo import write_photo
from testing import label_files as made
from testing.examples import examples
from testing.imports import imported, is_right, said_about
from testing.label_documents import FLAT, READ, SAID
from testing.label_files import HEIGHT, NAME, WIDTH, coco

FEW = examples(30, suppress_health_check=[HealthCheck.function_scoped_fixture])


# What is read


@pytest.mark.parametrize("kind", READ)
def test_labels_of_other_programs_are_read(tmp_path, photos, kind):
    ending = "xml" if kind.startswith("cvat") else "json"
    file = made.written(tmp_path / "in" / f"theirs.{ending}", READ[kind])
    found = is_right(imported(file, photos))
    assert found.problems == ()
    is_right(imported(file, photos, format=kind.split()[0]))
    is_right(imported(file.parent, photos))


def test_an_annotation_without_image_is_named_and_the_others_are_read(tmp_path, photos):
    document = coco([[FLAT], {"image_id": 99, "segmentation": [FLAT], "id": 4711}])
    found = is_right(imported(made.written(tmp_path / "a.json", document), photos))
    assert "4711" in found.notes[0]


# Geometry


# What is refused, and what is said


@pytest.mark.parametrize("kind", SAID)
def test_what_was_found_is_said(tmp_path, photos, kind):
    document, words = SAID[kind]
    text = document if isinstance(document, str) else ""
    ending = "xml" if text.lstrip().startswith("<") else "json"
    file = made.written(tmp_path / "in" / f"theirs.{ending}", document)
    for source in (file, file.parent):
        said = said_about(source, photos)
        for word in words:
            assert word in said
    assert ("sound LabelMe" in said) == (kind.startswith("labelme") and "not sound" in said)


def test_text_and_tables_of_other_programs_are_named(tmp_path, photos):
    made.written(tmp_path / "yolo" / "ridge.txt", "0 0.1 0.1 0.5 0.1 0.5 0.5")
    assert "YOLO" in said_about(tmp_path / "yolo", photos)
    head = "filename,file_size,file_attributes,region_count,region_id,region_shape_attributes\n"
    made.written(tmp_path / "via.csv", head)
    assert "VGG Image Annotator" in said_about(tmp_path / "via.csv", photos)


def test_one_bad_entry_never_loses_the_others(tmp_path, photos):
    names = [NAME, "b.png", "c.png"]
    for name in names[1:]:
        write_photo(photos / name, made.photo())
    document = coco([[FLAT], {"image_id": 2, "segmentation": [["x", 1, 2, 3, 4, 5]]}])
    document["images"] += [
        {"id": 2, "file_name": "b.png", "height": HEIGHT, "width": WIDTH},
        {"id": 3, "file_name": "c.png", "height": 9, "width": 9},
        {"id": [], "file_name": 7},
    ]
    document["annotations"].append(
        {"id": 9, "image_id": 3, "category_id": 1, "segmentation": [FLAT]}
    )
    found = is_right(imported(made.written(tmp_path / "a.json", document), photos, names))
    assert len(found.problems) == 3
    assert any("annotation 2" in one for one in found.problems)
    assert any("c.png" in one for one in found.problems)


# Our own output comes back


# Hostile files


@FEW
@given(seed=st.integers(0, 10**6))
def test_damaged_documents_raise_nothing_but_sentences(tmp_path, photos, seed):
    chance = random.Random(seed)
    kind = chance.choice(list(READ))
    whole = made.cut_up(READ[kind], chance)
    ending = "xml" if kind.startswith("cvat") else "json"
    file = made.written(tmp_path / f"a.{ending}", whole)
    try:
        found = imported(file, photos)
    except FormatError as error:
        assert len(str(error).splitlines()) == 1
    else:
        for one in found:
            assert one.skyline.width == WIDTH
            assert one.skyline.rows.min() >= 0
            assert one.skyline.rows.max() <= HEIGHT


# Labels that cannot all be right


# Photos of the same content
