"""Labels leave and come back, as exactly as each format can carry them."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pycocotools import mask as coco_mask
from pycocotools.coco import COCO

from annotate.formats import FORMATS, FormatError, export_labels, import_labels
from annotate.formats.common import safe_stems
from annotate.labels import ORIGINS, Label
from skyline_viz.datasets import open_dataset
from skyline_viz.photo import write_photo
from skyline_viz.skyline import Skyline

HEIGHT, WIDTH = 24, 31
LOSES_VISIBILITY = {"mask", "ch1", "coco"}


def label(name="a.png", rows=None, visible=None, **other):
    rows = np.arange(WIDTH) % (HEIGHT - 1) if rows is None else np.array(rows)
    told = {
        "digest": "d" * 64,
        "width": WIDTH,
        "height": HEIGHT,
        "annotator": "ann",
        "number": 1,
        "status": "accepted",
        "tags": ("needs terrain data", "fog & <rain>"),
        "skyline": Skyline(rows=rows, visible=visible),
        "origin": (np.arange(WIDTH) % len(ORIGINS)).astype(np.uint8),
        "operations": ({"kind": "anchor", "column": 3, "row": 4, "at": 12.5},),
        "seconds": 12.25,
        "detector": "skyline-viz, 0123",
        "blind": False,
    }
    return Label(name=name, **{**told, **other})


def photos_for(folder, *names):
    random = np.random.default_rng(0)
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        write_photo(folder / name, random.integers(0, 250, (HEIGHT, WIDTH, 3), np.uint8))
    return folder


@pytest.fixture(scope="module")
def photos(tmp_path_factory):
    return photos_for(tmp_path_factory.mktemp("photos"), "a.png", "b/a.png", "b/c.png")


NAMES = ["a.png", "b/a.png", "b/c.png"]
LINES = st.lists(st.integers(0, HEIGHT - 1), min_size=WIDTH, max_size=WIDTH)
SEEN = st.lists(st.booleans(), min_size=WIDTH, max_size=WIDTH).filter(any)


@pytest.mark.parametrize("kind", FORMATS)
@settings(max_examples=25, deadline=None)
@given(rows=st.tuples(LINES, LINES), visible=SEEN)
def test_labels_come_back(kind, rows, visible, photos, tmp_path_factory):
    out = tmp_path_factory.mktemp("out") / "export"
    visible = np.array(visible)
    if kind in LOSES_VISIBILITY:
        visible[:] = True
    labels = [label("a.png", rows[0], visible), label("b/a.png", rows[1])]
    export = export_labels(labels, photos, out, kind)
    assert (export.written, export.notes) == (2, ())
    found = {one.name: one for one in import_labels(out, photos, NAMES)}
    assert set(found) == {"a.png", "b/a.png"}
    assert found["b/a.png"].skyline == labels[1].skyline
    back = found["a.png"].skyline
    np.testing.assert_array_equal(back.visible, visible)
    np.testing.assert_array_equal(back.rows[visible], labels[0].skyline.rows[visible])
    if kind in ("csv", "json"):
        assert back == labels[0].skyline
    if kind in ("json", "labelme", "cvat"):
        assert set(found["a.png"].tags) == set(labels[0].tags)


def test_json_carries_everything(photos, tmp_path):
    given = label()
    export_labels([given], photos, tmp_path / "out", "json")
    (found,) = import_labels(tmp_path / "out" / "labels.json", photos, NAMES)
    for name, value in vars(given).items():
        if name == "origin":
            np.testing.assert_array_equal(found.label.origin, value)
        else:
            assert getattr(found.label, name) == value


@pytest.mark.filterwarnings("ignore::DeprecationWarning:pycocotools")
@pytest.mark.filterwarnings("ignore:__array__ implementation")
@settings(max_examples=100, deadline=None)
@given(rows=LINES.filter(any))
def test_coco_is_exact_by_its_own_tools(rows, photos, tmp_path_factory):
    out = tmp_path_factory.mktemp("coco") / "export"
    given = label("a.png", rows)
    export_labels([given], photos, out, "coco")
    sky = given.skyline.to_mask(HEIGHT)
    for name in ("annotations-rle.json", "annotations-polygon.json"):
        coco = COCO(str(out / name))
        (annotation,) = coco.loadAnns(coco.getAnnIds())
        np.testing.assert_array_equal(coco.annToMask(annotation).astype(bool), sky)
        assert annotation["area"] == sky.sum()
        assert annotation["bbox"] == coco_mask.toBbox(coco.annToRLE(annotation)).tolist()
        assert coco.loadImgs(annotation["image_id"])[0]["file_name"] == "a.png"
        (found,) = import_labels(out / name, photos, NAMES)
        assert found.skyline == given.skyline


def test_compressed_run_lengths_of_others_are_read(photos, tmp_path):
    given = label()
    sky = np.asfortranarray(given.skyline.to_mask(HEIGHT).astype(np.uint8))
    code = coco_mask.encode(sky)
    document = {
        "images": [{"id": 7, "file_name": "a.png", "width": WIDTH, "height": HEIGHT}],
        "categories": [{"id": 3, "name": "sky"}],
        "annotations": [
            {
                "image_id": 7,
                "category_id": 3,
                "segmentation": {"size": code["size"], "counts": code["counts"].decode()},
            }
        ],
    }
    (tmp_path / "theirs.json").write_text(json.dumps(document))
    (found,) = import_labels(tmp_path / "theirs.json", photos, NAMES)
    assert found.skyline == given.skyline


@pytest.mark.parametrize("kind", ["mask", "painted", "ch1", "csv"])
def test_data_sets_are_read_by_the_detectors_side(kind, photos, tmp_path):
    given = label("b/c.png")
    export_labels([given], photos, tmp_path / "out", kind)
    if kind in ("mask", "csv"):  # truths without photos: put the photo beside them
        photos_for(tmp_path / "out" / "images", "b__c.png")
        if kind == "csv":
            (tmp_path / "out" / "masks").mkdir()
            (tmp_path / "out" / "b__c.csv").rename(tmp_path / "out" / "masks" / "b__c.csv")
    (item,) = open_dataset(tmp_path / "out")
    assert item.truth() == given.skyline
    assert item.photo().shape == (HEIGHT, WIDTH, 3)


@pytest.mark.parametrize("kind", FORMATS)
def test_what_a_format_cannot_carry_is_told(kind, photos, tmp_path):
    visible = np.arange(WIDTH) > 3
    export = export_labels([label(visible=visible)], photos, tmp_path / "out", kind)
    assert bool(export.notes) == (kind in LOSES_VISIBILITY)
    for note in export.notes:
        assert "cannot say which columns are not visible" in note


def test_an_empty_or_partial_export_says_so(photos, tmp_path):
    with pytest.raises(FormatError, match="nothing to export"):
        export_labels([], photos, tmp_path / "out", "csv")
    gone, without = label("gone.png"), label("b/c.png", skyline=None)
    with pytest.raises(FormatError, match=r"gone\.png is not in the folder"):
        export_labels([gone, without], photos, tmp_path / "out", "csv")
    assert list(tmp_path.iterdir()) == []
    export = export_labels([label(), gone, without], photos, tmp_path / "out", "csv")
    assert export.written == 1
    assert len(export.notes) == 2


def test_nothing_is_overwritten_or_left_half_written(photos, tmp_path, monkeypatch):
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("mine")
    with pytest.raises(FormatError, match="exists already"):
        export_labels([label()], photos, tmp_path / "full", "csv")
    with pytest.raises(FormatError, match="no format"):
        export_labels([label()], photos, tmp_path / "out", "yaml")

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("annotate.formats.masks.write_photo", interrupted)
    with pytest.raises(KeyboardInterrupt):
        export_labels([label()], photos, tmp_path / "out", "ch1")
    assert [path.name for path in tmp_path.iterdir()] == ["full"]


@given(
    st.lists(st.text(st.characters(blacklist_characters="\0"), min_size=1), min_size=1, max_size=8)
)
def test_names_of_files_are_safe_and_unique(names):
    stems = safe_stems(names)
    assert set(stems) == set(names)
    folded = [stem.casefold() for stem in stems.values()]
    assert len(set(folded)) == len(folded)
    for stem in stems.values():
        assert Path(stem).name == stem
        assert stem not in ("", ".", "..")
        assert not stem.startswith(".")
        assert stem.isprintable()
        assert len(stem.encode()) < 140


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("x.json", "{"),
        ("x.json", "[]"),
        ("x.json", "[" * 100_000),
        ("x.json", '{"format": "skyline-labels", "version": 9, "labels": []}'),
        ("x.json", '{"format": "skyline-labels", "version": 1, "labels": [{}]}'),
        ("x.json", '{"format": "skyline-labels", "version": 1, "labels": []}'),
        ("x.json", '{"images": 3, "annotations": []}'),
        ("x.json", '{"shapes": [{}], "imagePath": "a.png"}'),
        (
            "x.json",
            '{"shapes": [{"label": "skyline", "shape_type": "linestrip", "points": [[NaN, 1]]}],'
            ' "imagePath": "a.png", "imageWidth": 31}',
        ),
        (
            "x.json",
            '{"shapes": [{"label": "skyline", "shape_type": "linestrip", "points": [[1, 99]]}],'
            ' "imagePath": "a.png", "imageWidth": 31}',
        ),
        ("x.xml", "<annotations"),
        ("x.xml", '<!DOCTYPE a [<!ENTITY b "c">]><annotations>&b;</annotations>'),
        ("x.xml", '<a><image name="a.png" width="31"><polyline label="skyline"/></image></a>'),
        (
            "x.xml",
            '<a><image name="a.png" width="9e9"><polyline label="skyline" points="1,2;3,4"/>'
            "</image></a>",
        ),
        ("a.csv", "column,row,visible\n0,nan,1\n"),
        ("a.csv", "column,row,visible\n0,1,1\n"),
        ("x.bin", "nothing"),
    ],
)
def test_malformed_files_are_one_sentence(name, content, photos, tmp_path):
    (tmp_path / name).write_text(content)
    with pytest.raises(FormatError) as refused:
        import_labels(tmp_path / name, photos, NAMES)
    assert str(refused.value).endswith(".")
    assert "\n" not in str(refused.value)


def test_labels_of_another_width_are_refused(photos, tmp_path):
    Skyline(rows=np.zeros(WIDTH + 1)).write_csv(tmp_path / "a.csv")
    with pytest.raises(FormatError, match="31 columns, its label 32"):
        import_labels(tmp_path / "a.csv", photos, NAMES)
