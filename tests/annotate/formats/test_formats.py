"""Formats of labels: what comes back, what other programs see, and what is refused."""

import csv
import hashlib
import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pycocotools import mask as coco_mask
from pycocotools.coco import COCO

import annotate.formats as formats
from annotate.formats import FORMATS, FormatError, export_labels, import_labels
from annotate.store.labels import TAGS, Label
from skyline_viz.datasets.layouts import open_dataset
from skyline_viz.photo import write_photo
from skyline_viz.skyline import Skyline

HEIGHT, WIDTH = 16, 24
KEEP_VISIBLE = ("painted", "csv", "json", "labelme", "cvat")
KEEP_TAGS = ("json", "labelme", "cvat")
EVERY = pytest.mark.parametrize("kind", list(FORMATS))
FEW = settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def put(folder, name, height=HEIGHT, width=WIDTH, seed=0):
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(seed)
    write_photo(path, random.integers(0, 256, (height, width, 3), np.uint8))
    return path


def label(photos, name, rows=None, visible=None, tags=(), width=WIDTH, height=HEIGHT):
    rows = np.arange(width) % 5 + 4 if rows is None else rows
    path = photos / name
    return Label(
        name=name,
        digest=hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "",
        width=width,
        height=height,
        annotator="ann",
        number=2,
        status="accepted",
        tags=tuple(tags),
        skyline=Skyline(rows, visible),
        origin=(np.arange(width) % 4).astype(np.uint8),
        operations=({"kind": "anchor", "column": 3, "row": 4, "at": 1.5},),
        seconds=12.5,
        detector="found by hand",
        blind=True,
    )


def without_line(photos, name):
    return Label(**{**vars(label(photos, name)), "skyline": None})


@pytest.fixture
def photos(tmp_path):
    put(tmp_path / "photos", "a.png")
    return tmp_path / "photos"


def there_and_back(tmp_path, photos, kind, labels):
    """Export and import; the names that are there are those of the labels."""
    out = tmp_path / "out"
    shutil.rmtree(out, ignore_errors=True)
    export = export_labels(labels, photos, out, kind)
    return export, import_labels(out, photos, [one.name for one in labels])


@st.composite
def lines(draw, lowest=0):
    rows = draw(st.lists(st.integers(lowest, HEIGHT - 1), min_size=WIDTH, max_size=WIDTH))
    visible = draw(st.lists(st.booleans(), min_size=WIDTH, max_size=WIDTH).filter(any))
    return np.array(rows), np.array(visible)


# There and back


@EVERY
@FEW
@given(line=lines(), tags=st.lists(st.sampled_from([*TAGS, 'own <&" é']), unique=True))
def test_labels_come_back(tmp_path, photos, kind, line, tags):
    rows, visible = line
    _, (found,) = there_and_back(tmp_path, photos, kind, [label(photos, "a.png", *line, tags)])
    assert found.name == "a.png"
    np.testing.assert_array_equal(found.skyline.rows[visible], rows[visible])
    if kind in KEEP_VISIBLE:
        np.testing.assert_array_equal(found.skyline.visible, visible)
    else:
        assert found.skyline.visible.all()
        np.testing.assert_array_equal(found.skyline.rows, rows)
    assert found.tags == (tuple(tags) if kind in KEEP_TAGS else ())


def test_json_carries_everything(tmp_path, photos):
    given_label = label(photos, "a.png", tags=TAGS)
    _, (found,) = there_and_back(tmp_path, photos, "json", [given_label])
    before, after = dict(vars(given_label)), dict(vars(found.label))
    np.testing.assert_array_equal(before.pop("origin"), after.pop("origin"))
    assert before == after


@EVERY
def test_many_photos_with_folders_and_equal_stems(tmp_path, photos, kind):
    names = ["a.png", "a.bmp", "x/a.png", "y/a.png", "x__a.png"]
    labels = []
    for number, name in enumerate(names):
        put(photos, name)
        labels.append(label(photos, name, np.full(WIDTH, 3 + number)))
    export, found = there_and_back(tmp_path, photos, kind, labels)
    assert export.written == 5
    assert {one.name: one.skyline.rows[0] for one in found} == {
        name: 3 + number for number, name in enumerate(names)
    }


@pytest.mark.parametrize(
    "kind",
    list(FORMATS),
)
def test_a_part_of_the_photos_comes_back_to_the_same_photos(tmp_path, photos, kind):
    put(photos, "a.bmp")
    export_labels([label(photos, "a.png")], photos, tmp_path / "out", kind)
    found = import_labels(tmp_path / "out", photos, ["a.bmp", "a.png"])
    assert [one.name for one in found] == ["a.png"]


@pytest.mark.parametrize("kind", ["json", "csv", "mask", "coco"])
def test_a_column_that_is_all_sky(tmp_path, photos, kind):
    rows = np.full(WIDTH, 5)
    rows[3:6] = HEIGHT
    _, (found,) = there_and_back(tmp_path, photos, kind, [label(photos, "a.png", rows)])
    np.testing.assert_array_equal(found.skyline.rows, rows)


# What other programs see


@pytest.mark.filterwarnings("ignore:__array__ implementation:DeprecationWarning")  # theirs
@FEW
@given(
    rows=st.lists(st.integers(0, HEIGHT), min_size=WIDTH, max_size=WIDTH).filter(any),
)
def test_coco_means_this_very_mask(tmp_path, photos, rows):
    given_label = label(photos, "a.png", np.array(rows))
    out = tmp_path / "out"
    shutil.rmtree(out, ignore_errors=True)
    export_labels([given_label], photos, out, "coco")
    wanted = given_label.skyline.to_mask(HEIGHT)
    for name in ("annotations-polygon.json", "annotations-rle.json"):
        coco = COCO(out / name)
        (one,) = coco.loadAnns(coco.getAnnIds())
        packed = coco.annToRLE(one)
        np.testing.assert_array_equal(coco_mask.decode(packed).astype(bool), wanted, name)
        assert coco_mask.area(packed) == one["area"]
        (image,) = coco.loadImgs(one["image_id"])
        assert (image["height"], image["width"]) == (HEIGHT, WIDTH)
        assert coco.loadCats(one["category_id"])[0]["name"] == "sky"
    counts = one["segmentation"]["counts"]
    assert sum(counts) == HEIGHT * WIDTH
    assert min(counts[1:]) > 0


def test_coco_is_read_as_pycocotools_packs_it(tmp_path, photos):
    export_labels([label(photos, "a.png")], photos, tmp_path / "out", "coco")
    path = tmp_path / "out" / "annotations-rle.json"
    document = json.loads(path.read_text())
    sky = label(photos, "a.png").skyline.to_mask(HEIGHT)
    packed = coco_mask.encode(np.asfortranarray(sky.astype(np.uint8)))
    document["annotations"][0]["segmentation"] = {
        "size": packed["size"],
        "counts": packed["counts"].decode(),
    }
    path.write_text(json.dumps(document))
    (found,) = import_labels(path, photos, ["a.png"])
    assert found.skyline == label(photos, "a.png").skyline


@pytest.mark.parametrize(("kind", "layout"), [("ch1", "CH1"), ("painted", "Web")])
def test_an_export_opens_as_a_data_set(tmp_path, photos, kind, layout):
    put(photos, "x/a.png", seed=1)
    labels = [
        label(photos, "a.png"),
        label(photos, "x/a.png", np.full(WIDTH, 7)),
    ]
    export_labels(labels, photos, tmp_path / "out", kind)
    dataset = open_dataset(tmp_path / "out")
    assert dataset.layout == layout
    assert dataset.problems == ()
    assert sorted(item.truth().rows[1] for item in dataset) == [5, 7]


@pytest.mark.parametrize(("kind", "place"), [("mask", "masks"), ("csv", "ground_truth")])
def test_masks_and_tables_are_truths_beside_their_photos(tmp_path, photos, kind, place):
    export_labels([label(photos, "a.png")], photos, tmp_path / "out", kind)
    shutil.copytree(tmp_path / "out" / ("masks" if kind == "mask" else "."), photos / place)
    (item,) = open_dataset(photos)
    assert item.truth() == label(photos, "a.png").skyline


def test_labelme_documents_have_what_labelme_asks_for(tmp_path, photos):
    export_labels([label(photos, "a.png", tags=["mine"])], photos, tmp_path / "out", "labelme")
    document = json.loads((tmp_path / "out" / "a.json").read_text())
    assert document["imagePath"] == "a.png"
    assert document["imageData"] is None
    assert (document["imageHeight"], document["imageWidth"]) == (HEIGHT, WIDTH)
    assert document["flags"] == {"mine": True}
    assert {shape["shape_type"] for shape in document["shapes"]} == {"linestrip"}


def test_tables_have_a_line_a_column(tmp_path, photos):
    export_labels([label(photos, "a.png")], photos, tmp_path / "out", "csv")
    with (tmp_path / "out" / "a.csv").open(newline="") as file:
        lines_read = list(csv.reader(file))
    assert lines_read[0] == ["column", "row", "visible"]
    assert len(lines_read) == WIDTH + 1


# What cannot be carried


@pytest.mark.parametrize("kind", ["mask", "ch1", "coco"])
def test_lost_visibility_is_told(tmp_path, photos, kind):
    visible = np.arange(WIDTH) > 3
    export, _ = there_and_back(tmp_path, photos, kind, [label(photos, "a.png", visible=visible)])
    assert export.written == 1
    assert "not visible" in export.notes[0]


@EVERY
def test_what_is_left_out_is_told(tmp_path, photos, kind):
    put(photos, "small.png", height=12)
    labels = [
        label(photos, "a.png"),
        without_line(photos, "b.png"),
        label(photos, "gone.png"),
        label(photos, "small.png"),
    ]
    export = export_labels(labels, photos, tmp_path / "out", kind)
    assert export.written == 1
    assert [note.split()[0] for note in export.notes] == ["b.png", "gone.png", "small.png"]


@EVERY
def test_an_empty_export_is_refused(tmp_path, photos, kind):
    for labels in ([], [without_line(photos, "a.png")]):
        with pytest.raises(FormatError, match="nothing to export"):
            export_labels(labels, photos, tmp_path / "out", kind)
    assert [one.name for one in tmp_path.iterdir()] == ["photos"]


# Whole or not at all


@EVERY
def test_an_interrupted_export_leaves_nothing(tmp_path, photos, kind, monkeypatch):
    write, read = FORMATS[kind]

    def interrupted(entries, folder):
        write(entries, folder)
        raise KeyboardInterrupt

    monkeypatch.setitem(formats.FORMATS, kind, (interrupted, read))
    with pytest.raises(KeyboardInterrupt):
        export_labels([label(photos, "a.png")], photos, tmp_path / "out", kind)
    assert [one.name for one in tmp_path.iterdir()] == ["photos"]


def test_nothing_is_overwritten(tmp_path, photos):
    out = tmp_path / "out"
    out.mkdir()
    export_labels([label(photos, "a.png")], photos, out, "csv")
    before = (out / "a.csv").read_bytes()
    with pytest.raises(FormatError, match="exists already"):
        export_labels([label(photos, "a.png", np.full(WIDTH, 1))], photos, out, "csv")
    assert (out / "a.csv").read_bytes() == before
    with pytest.raises(FormatError, match="exists already"):
        export_labels([label(photos, "a.png")], photos, out / "a.csv", "csv")


# Hostile names


@EVERY
@pytest.mark.parametrize(
    "name", ["b\nc.png", 'quo"te<&>.png', " .png", "con.png", "é" * 100 + ".png"]
)
def test_strange_names_come_back(tmp_path, photos, kind, name):
    put(photos, name)
    _, (found,) = there_and_back(tmp_path, photos, kind, [label(photos, name)])
    assert found.name == name


@EVERY
@pytest.mark.parametrize("name", ["../outside.png", "x/../../outside.png", "ABSOLUTE"])
def test_nothing_outside_the_folder_is_exported(tmp_path, photos, kind, name):
    outside = put(tmp_path, "outside.png")
    name = str(outside) if name == "ABSOLUTE" else name
    labels = [label(photos, "a.png"), label(photos, name)]
    (photos / "x").mkdir()
    export = export_labels(labels, photos, tmp_path / "in" / "out", kind)
    assert export.written == 1
    assert sorted(one.name for one in tmp_path.iterdir()) == ["in", "outside.png", "photos"]
    assert [one.name for one in (tmp_path / "in").iterdir()] == ["out"]


def test_an_import_opens_no_photo_that_it_was_not_given(tmp_path, photos):
    put(tmp_path, "outside.png")
    export_labels([label(photos, "a.png")], photos, tmp_path / "out", "coco")
    for path in (tmp_path / "out").iterdir():
        path.write_text(path.read_text().replace("a.png", "../outside.png"))
    with pytest.raises(FormatError, match="holds no label"):
        import_labels(tmp_path / "out", photos, ["a.png"])


# Damaged files

FILE = {
    "mask": "masks/a.png",
    "painted": "ground_truth/GT_GoogleImage001_Edge.bmp",
    "ch1": "cvg/ground_truth/a-mask.png",
    "csv": "a.csv",
    "json": "labels.json",
    "coco": "annotations-rle.json",
    "labelme": "a.json",
    "cvat": "annotations.xml",
}
TEXT = {kind: FILE[kind] for kind in ("json", "coco", "labelme", "cvat", "csv")}


def refused(tmp_path, photos, kind, content):
    """What is said about a file of an export that was replaced by `content`."""
    out = tmp_path / "out"
    shutil.rmtree(out, ignore_errors=True)
    export_labels([label(photos, "a.png")], photos, out, kind)
    path = out / FILE[kind]
    path.write_bytes(content(path.read_bytes()) if callable(content) else content)
    with pytest.raises(FormatError) as caught:
        import_labels(out, photos, ["a.png"], kind)
    said = str(caught.value)
    assert len(said.splitlines()) == 1
    assert said.endswith(".")
    return said


@EVERY
@pytest.mark.parametrize("content", [b"", b"\0\xff\xfe", b"[1, 2", b"<a><b></a>", b"[" * 100_000])
def test_damaged_files_are_refused_in_one_sentence(tmp_path, photos, kind, content):
    refused(tmp_path, photos, kind, content)


@pytest.mark.parametrize("kind", TEXT)
def test_half_a_file_is_refused(tmp_path, photos, kind):
    refused(tmp_path, photos, kind, lambda whole: whole[: len(whole) // 2 - 1])


def leaves(document, path=()):
    """Paths of everything in a JSON document."""
    yield path
    if isinstance(document, dict | list):
        keys = document if isinstance(document, dict) else range(len(document))
        for one in keys:
            yield from leaves(document[one], (*path, one))


@pytest.mark.parametrize("kind", ["json", "coco", "labelme"])
@FEW
@given(data=st.data())
def test_wrong_values_raise_nothing_but_sentences(tmp_path, photos, kind, data):
    out = tmp_path / "out"
    shutil.rmtree(out, ignore_errors=True)
    export_labels([label(photos, "a.png", tags=TAGS)], photos, out, kind)
    path = out / FILE[kind]
    document = json.loads(path.read_text())
    *place, last = data.draw(st.sampled_from([one for one in leaves(document) if one]))
    inside = document
    for one in place:
        inside = inside[one]
    inside[last] = data.draw(
        st.sampled_from(
            [None, True, -1, 1e300, float("nan"), float("inf"), 10**30, "", "é", [], {}, [[]], [{}]]
        )
    )
    path.write_text(json.dumps(document))
    try:
        found = import_labels(out, photos, ["a.png"], kind)
    except FormatError as error:
        assert len(str(error).splitlines()) == 1
    else:
        for one in found:
            assert one.skyline.width == WIDTH
            assert one.skyline.rows.min() >= 0
            assert one.skyline.rows.max() <= HEIGHT


@pytest.mark.parametrize("number", ["nan", "inf", "-inf", "1e999", "1e300", "-5000", "x", ""])
def test_points_that_are_no_place_in_a_photo(tmp_path, photos, number):
    def content(whole):
        return whole.replace(b'points="0.50,4.00', f'points="0.50,{number}'.encode())

    refused(tmp_path, photos, "cvat", content)


def test_entities_are_refused_before_they_are_expanded(tmp_path, photos):
    bomb = b'<!DOCTYPE a [<!ENTITY b "bb"><!ENTITY c "&b;&b;">]><annotations>&c;</annotations>'
    for content in (bomb, bomb.decode().encode("utf-16")):
        refused(tmp_path, photos, "cvat", content)


@EVERY
def test_another_size_than_the_photos_is_refused(tmp_path, photos, kind):
    export_labels([label(photos, "a.png")], photos, tmp_path / "out", kind)
    put(photos, "a.png", width=WIDTH + 1)
    with pytest.raises(FormatError):
        import_labels(tmp_path / "out", photos, ["a.png"])


@pytest.mark.parametrize(
    "kind",
    [one for one in FORMATS if one != "csv"],
)
def test_another_height_than_the_photos_is_refused(tmp_path, photos, kind):
    export_labels([label(photos, "a.png")], photos, tmp_path / "out", kind)
    put(photos, "a.png", height=HEIGHT + 1)
    with pytest.raises(FormatError):
        import_labels(tmp_path / "out", photos, ["a.png"])


def test_a_claimed_size_is_checked_before_memory_is_taken(tmp_path, photos, monkeypatch):
    def claim(whole):
        document = json.loads(whole)
        document["images"][0] |= {"height": 10**5, "width": 10**5}
        document["annotations"][0]["segmentation"]["counts"] = [10**10]
        return json.dumps(document).encode()

    repeat = np.repeat

    def small(values, counts, *rest):
        assert np.sum(counts) < 10**9, "10 GB"
        return repeat(values, counts, *rest)

    monkeypatch.setattr(np, "repeat", small)
    refused(tmp_path, photos, "coco", claim)


@pytest.mark.parametrize(
    "kind",
    list(FORMATS),
)
def test_two_passes_over_a_photo_do_not_overwrite_each_other(tmp_path, photos, kind):
    labels = [
        label(photos, "a.png"),
        Label(**{**vars(label(photos, "a.png", np.full(WIDTH, 2))), "annotator": "bob"}),
    ]
    export, found = there_and_back(tmp_path, photos, kind, labels)
    assert export.written == len(found)
    assert len(export.notes) == (0 if kind == "json" else 1)


def test_unknown_formats_and_sources(tmp_path, photos):
    with pytest.raises(FormatError, match="is no format"):
        export_labels([label(photos, "a.png")], photos, tmp_path / "out", "gif")
    with pytest.raises(FormatError, match="does not exist"):
        import_labels(Path("nowhere"), photos, ["a.png"])
    (tmp_path / "empty").mkdir()
    with pytest.raises(FormatError, match="no known format"):
        import_labels(tmp_path / "empty", photos, ["a.png"])
