"""Telling a file's kind by its content: what is read, or what it is instead."""

import json

import pytest

from annotate.formats.kinds import READ, kind_of, kind_of_json, kind_of_xml, shown


@pytest.mark.parametrize(
    ("document", "kind"),
    [
        ({"format": "skyline-labels"}, "json"),
        ({"format": "skyline", "shapes": []}, "csv"),
        ({"shapes": []}, "labelme"),
        ({"annotations": [], "images": []}, "coco"),
        ([{"data": {}}], "Label Studio"),
        ([1, 2], "JSON with a list"),
        ("text", "JSON, but no object"),
        ({"image": {}, "annotations": []}, "Segment Anything"),
        (
            {"a.jpg12": {"regions": [{}, {}]}},
            "VGG Image Annotator project with 2 regions on 1 photos",
        ),
        ({"objects": [], "size": {}}, "Supervisely"),
        ({"b": 1, "a": 2}, "JSON of no known kind, with a, b"),
        ({}, "with nothing in it"),
        ({"format": ["skyline-labels"]}, "JSON of no known kind, with format"),
    ],
)
def test_json(document, kind):
    said = kind_of_json(document)
    assert said == kind if kind in READ else kind in said and said not in READ


def test_xml():
    assert kind_of_xml("annotations") == "cvat"
    assert "Pascal VOC" in kind_of_xml("annotation")
    assert kind_of_xml("x" * 99) == f"XML of no known kind, with <{'x' * 40}>"


@pytest.mark.parametrize(
    ("name", "content", "kind"),
    [
        ("a.json", json.dumps({"shapes": []}), "labelme"),
        ("a.xml", "<annotations/>", "cvat"),
        ("a.csv", "column,row,visible\n0,1,1\n", "csv"),
        ("a.csv", "column,row,visible,margin\n0,1,1,0.5\n", "csv"),
        ("a.csv", "filename,region_shape_attributes\n", "VGG"),
        ("a.csv", "", "with nothing in it"),
        ("a.PNG", "whatever", "mask"),
        ("a.txt", "0 0.1 0.1 0.5 0.5 0.9 0.1", "YOLO"),
        ("a.txt", "just some words here, five", ""),
        ("a.md", "0 0.1 0.1 0.5 0.5", ""),
    ],
)
def test_files(tmp_path, name, content, kind):
    (tmp_path / name).write_text(content)
    said = kind_of(tmp_path / name)
    assert said == kind if kind in READ or not kind else kind in said


def test_kinds_in_words():
    assert {shown(kind) for kind in READ} == {
        "COCO",
        "LabelMe",
        "labels.json",
        "a table of labels",
        "a skyline",
        "cvat",
        "mask",
    }
    assert shown("YOLO text") == "YOLO text"
