"""Label files of other programs: read rightly, or refused with what was found in them."""

import json
import random
import shutil

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from annotate.formats import FORMATS, FormatError, documents, export_labels, import_labels
from annotate.formats.outlines import polygon_mask
from annotate.store.folder import photos_below
from annotate.store.labels import Label
from skyline_viz.photo import write_photo
from skyline_viz.skyline import Skyline
from testing import label_files as made
from testing.label_documents import FLAT, LAYOUTS, LEFT, OUTLINE, READ, RIGHT, SAID
from testing.label_files import HEIGHT, NAME, ROWS, SKY, SKYLINE, WIDTH, coco, labelme, shape

FEW = settings(
    max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@pytest.fixture
def photos(tmp_path):
    write_photo(tmp_path / "photos" / NAME, made.photo())
    return tmp_path / "photos"


def imported(source, photos, names=(NAME,), **options):
    return import_labels(source, photos, names, **options)


def said_about(source, photos, names=(NAME,), **options):
    with pytest.raises(FormatError) as caught:
        imported(source, photos, names, **options)
    said = str(caught.value)
    assert len(said.splitlines()) == 1
    assert said.endswith(".")
    for word in ("Error", "NoneType", "codec", "object is", "object has", "not subscriptable"):
        assert word not in said
    return said


def is_right(found, name=NAME):
    assert [one.name for one in found] == [name]
    np.testing.assert_array_equal(found.found[0].skyline.rows, ROWS)
    assert found.found[0].skyline.visible.all()
    return found


# What is read


@pytest.mark.parametrize("kind", READ)
def test_labels_of_other_programs_are_read(tmp_path, photos, kind):
    ending = "xml" if kind.startswith("cvat") else "json"
    file = made.written(tmp_path / "in" / f"theirs.{ending}", READ[kind])
    found = is_right(imported(file, photos))
    assert found.problems == ()
    is_right(imported(file, photos, format=kind.split()[0]))
    is_right(imported(file.parent, photos))


@pytest.mark.parametrize("kind", made.SAME)
def test_masks_that_are_read_as_truths_are_imported(tmp_path, photos, kind):
    folder = tmp_path / "in"
    folder.mkdir()
    mask = made.SAME[kind](folder)
    mask.rename(mask.with_name(f"ridge{mask.suffix}"))
    (found,) = imported(folder, photos)
    seen = found.skyline.visible
    assert seen.sum() > 0.9 * WIDTH
    assert found.skyline.rows[seen].tolist() == made.ROWS[seen].tolist()


def test_an_annotation_without_image_is_named_and_the_others_are_read(tmp_path, photos):
    document = coco([[FLAT], {"image_id": 99, "segmentation": [FLAT], "id": 4711}])
    found = is_right(imported(made.written(tmp_path / "a.json", document), photos))
    assert "4711" in found.notes[0]


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("packed", [False, True])
def test_folders_and_zips_as_programs_lay_them_out(tmp_path, photos, layout, packed):
    for name, document in LAYOUTS[layout].items():
        made.written(tmp_path / "in" / name, document)
    source = tmp_path / "in"
    if packed:
        source = tmp_path / "packed.zip"
        made.zipped(
            source,
            {
                file.relative_to(tmp_path / "in").as_posix(): file.read_bytes()
                for file in (tmp_path / "in").rglob("*")
                if file.is_file()
            },
        )
    found = is_right(imported(source, photos))
    assert bool(found.problems) == (layout == "one damaged file among them")
    assert all("skyline-labels-" not in one for one in (*found.problems, *found.notes))


def test_masks_in_a_zip(tmp_path, photos):
    png = made.SAME["palette of two"](tmp_path).read_bytes()
    members = {"SegmentationClass/ridge.png": png, "SegmentationObject/ridge.png": b"", "l.txt": ""}
    is_right(imported(made.zipped(tmp_path / "a.zip", members), photos))


def test_a_zip_cannot_leave_its_folder_nor_fill_the_disk(tmp_path, photos, monkeypatch):
    text = json.dumps(READ["coco polygon"])
    bad = {"../out.json": text, "/etc/out.json": text, "a\\..\\out.json": text, ".x/o.json": text}
    said_about(made.zipped(tmp_path / "a.zip", bad), photos)
    assert sorted(one.name for one in tmp_path.iterdir()) == ["a.zip", "photos"]
    monkeypatch.setattr(documents, "_MOST_UNPACKED", 1000)
    assert "unpack it" in said_about(made.zipped(tmp_path / "b.zip", {"a.json": text}), photos)
    (tmp_path / "c.zip").write_bytes((tmp_path / "b.zip").read_bytes()[:-30])
    assert "no sound ZIP" in said_about(tmp_path / "c.zip", photos)


# Geometry


def test_a_polygon_that_stops_short_is_visible_only_where_it_is(tmp_path, photos):
    inner = [(4.0, 2.0), (WIDTH - 7.0, 2.0)]
    inner += [(x, y) for x, y in OUTLINE[2:] if 4 <= x <= WIDTH - 7]
    for document in (coco([[made.flat(inner)]]), labelme(shape(inner, "sky", "polygon"))):
        file = made.written(tmp_path / "a.json", document)
        found = imported(file, photos)
        line = found.found[0].skyline
        assert np.flatnonzero(line.visible)[[0, -1]].tolist() == [4, WIDTH - 8]
        np.testing.assert_array_equal(line.rows[line.visible], ROWS[line.visible])
        assert any("do not reach the sides" in note for note in found.notes)


def test_a_mask_that_stops_short_is_visible_only_where_it_is(tmp_path, photos):
    short = SKY.copy()
    short[:2], short[:, :3] = False, False
    file = made.written(tmp_path / "a.json", coco([made.rle(short)]))
    line = imported(file, photos).found[0].skyline
    assert np.flatnonzero(~line.visible).tolist() == [0, 1, 2]
    np.testing.assert_array_equal(line.rows[3:], ROWS[3:])


def test_terrain_is_read_where_it_is_asked_for(tmp_path, photos):
    ground = [(0, HEIGHT), (WIDTH, HEIGHT), *OUTLINE[2:]]
    file = made.written(tmp_path / "a.json", coco([[made.flat(ground)]], category="Mountain"))
    assert "Mountain (1 polygon)" in said_about(file, photos)
    is_right(imported(file, photos, terrain="mountain"))


def test_what_lies_above_the_sky_hides_it(tmp_path, photos):
    low = [(0, 0), (20, 0), (20, 30), (60, 30), (60, 0), (WIDTH, 0), *OUTLINE[2:]]
    tree = [(20, 0), (60, 0), (60, 30), (20, 30)]
    sky = shape(low, "sky", "polygon")
    file = made.written(tmp_path / "a.json", labelme(sky, shape(tree, "tree", "polygon")))
    found = imported(file, photos)
    assert np.flatnonzero(~found.found[0].skyline.visible).tolist() == list(range(20, 60))
    assert any("above the sky" in note for note in found.notes)
    found = imported(made.written(tmp_path / "a.json", labelme(sky)), photos)
    is_right(found)
    assert any("counts as sky" in note for note in found.notes)


@pytest.mark.parametrize(
    ("points", "wanted"),
    [
        ([(0.5, 50), (40.5, 50), (40.5, 20), (60.5, 20), (60.5, 50), (159.5, 50)], "steps"),
        ([(0.5, 50), (40, 50), (50, 40), (30, 20), (60, 20), (159.5, 50)], "overhang"),
        ([(-30, 50), (40.5, 50), (400, 50)], "beyond"),
        ([(2.5, 50), (157, 50)], "inside"),
    ],
)
def test_lines_of_every_form(tmp_path, photos, points, wanted):
    line = imported(made.written(tmp_path / "a.json", labelme(shape(points))), photos)
    line = line.found[0].skyline
    x = np.arange(WIDTH) + 0.5
    if wanted == "steps":
        np.testing.assert_array_equal(line.rows, np.where((x >= 40.5) & (x <= 60.5), 20, 50))
    elif wanted == "overhang":
        assert (line.rows[:29] == 50).all()
        assert (line.rows[30:60] == 20).all()
        assert (np.diff(line.rows[60:]) >= 0).all()
    elif wanted == "beyond":
        assert (line.rows == 50).all()
        assert line.visible.all()
    else:
        assert np.flatnonzero(line.visible)[[0, -1]].tolist() == [2, 157]


@FEW
@given(
    data=st.data(),
)
def test_polygons_mean_the_pixels_whose_centres_they_hold(tmp_path, photos, data):
    place = st.floats(-20, 60, allow_nan=False).map(lambda one: round(one, 2) + 0.003)
    points = data.draw(st.lists(st.tuples(place, place), min_size=3, max_size=8))
    mask, _ = polygon_mask([np.array(points)], 30, 40)
    for row, column in [(r, c) for r in range(0, 30, 3) for c in range(0, 40, 3)]:
        x, y = column + 0.5, row + 0.5
        crossed = [
            y0 + (x - x0) / (x1 - x0) * (y1 - y0)
            for (x0, y0), (x1, y1) in zip(points, [*points[1:], points[0]], strict=True)
            if (x0 <= x) != (x1 <= x)
        ]
        if all(abs(y - one) > 1e-6 for one in crossed):  # a centre on an edge may be either
            assert mask[row, column] == (sum(y > one for one in crossed) % 2 == 1)


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


@pytest.mark.parametrize("kind", ["palette of three", "three greys"])
def test_masks_ask_and_are_answered(tmp_path, photos, kind):
    (tmp_path / "in").mkdir()
    made.ASK[kind](tmp_path / "in").rename(tmp_path / "in" / "ridge_mask.png")
    assert "--sky" in said_about(tmp_path / "in", photos)
    is_right(imported(tmp_path / "in", photos, sky="0" if kind == "palette of three" else "2"))


# Our own output comes back

NAMES = st.text(
    st.characters(blacklist_characters="/\0", blacklist_categories=["Cs"]), min_size=1, max_size=12
).filter(lambda name: not name.startswith(".") and len(name.encode()) < 100)


@settings(FEW, max_examples=15)
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


# Hostile files


@FEW
@given(seed=st.integers(0, 10**6))
def test_damaged_documents_raise_nothing_but_sentences(tmp_path, photos, seed):
    chance = random.Random(seed)
    kind = chance.choice(list(READ))
    document = READ[kind]
    whole = document if isinstance(document, bytes | str) else json.dumps(document)
    whole = bytearray(whole if isinstance(whole, bytes) else whole.encode())
    for _ in range(chance.randint(1, 6)):
        place = chance.randrange(len(whole))
        whole[place : place + chance.randint(0, 3)] = chance.choice(
            [b"", b"-", b"9", b"null", b"[", b"}", b'"', b"\xff", b"1e999", b","]
        )
    ending = "xml" if kind.startswith("cvat") else "json"
    file = made.written(tmp_path / f"a.{ending}", bytes(whole))
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


def level(row, first=0.0, last=float(WIDTH)):
    return [(first, float(row)), (last, float(row))]


@pytest.mark.parametrize("apart", [0, 2, 3, 60])
@pytest.mark.parametrize("kind", ["two files", "one file", "cvat"])
def test_two_lines_of_a_photo_agree_or_none_is_imported(tmp_path, photos, kind, apart):
    write_photo(photos / "b.png", made.photo())
    other = level(30 + apart, 40)
    if kind == "two files":
        made.written(tmp_path / "in" / "anna" / "p.json", labelme(shape(level(30))))
        made.written(tmp_path / "in" / "ben" / "p.json", labelme(shape(other)))
        made.written(tmp_path / "in" / "b.json", labelme(shape(level(9)), name="b.png"))
    elif kind == "one file":
        made.written(tmp_path / "in" / "a.json", labelme(shape(level(30)), shape(other)))
        made.written(tmp_path / "in" / "b.json", labelme(shape(level(9)), name="b.png"))
    else:
        lines = [
            f'<polyline label="skyline" points="{made.cvat_points(one)}"/>'
            for one in (level(30), other)
        ]
        document = made.cvat("".join(lines))
        start, end = document.index("<image"), document.index("</image>") + len("</image>")
        good = made.cvat(lines[0], name="b.png")
        good = good[good.index("<image") : good.index("</image>") + len("</image>")]
        document = document[:start] + good + document[start:end] + document[end:]
        made.written(tmp_path / "in" / "a.xml", document)
    found = imported(tmp_path / "in", photos, (NAME, "b.png"))
    if apart > 2:
        assert [one.name for one in found] == ["b.png"]
        assert found.problems == (
            f"{NAME} has two lines that differ by up to {apart} px in columns 40 to {WIDTH - 1}; "
            f"none is imported.",
        )
    else:
        assert sorted(one.name for one in found) == ["b.png", NAME]
        assert found.problems == ()


def test_lines_that_meet_at_a_cliff_are_one(tmp_path, photos):
    document = labelme(shape(level(30, 0, 80.7)), shape(level(70, 80.2, WIDTH)))
    (found,) = imported(made.written(tmp_path / "a.json", document), photos)
    np.testing.assert_array_equal(found.skyline.rows, [30] * 81 + [70] * (WIDTH - 81))


@pytest.mark.parametrize("apart", [0, 40])
def test_two_tables_of_a_photo_agree_or_none_is_imported(tmp_path, photos, apart):
    for folder, row in (("anna", 30), ("ben", 30 + apart)):
        Skyline(np.full(WIDTH, row)).write_csv(tmp_path / "in" / folder / "ridge.csv")
    if apart:
        said = said_about(tmp_path / "in", photos)
        assert said == (
            f"{NAME} has two files that differ by up to 40 px in columns 0 to {WIDTH - 1}; "
            f"none is imported."
        )
    else:
        found = imported(tmp_path / "in", photos)
        assert len(found) == 1
        assert "another file for the same photo" in found.notes[0]


SHARES = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.4), (0.5, 0.3), (0.0, 0.4)]
IN_SHARES = {
    "coco": coco([[made.flat(SHARES)]]),
    "labelme line": labelme(shape(SHARES[2:])),
    "labelme polygon": labelme(shape(SHARES, "sky", "polygon")),
    "cvat": made.cvat(f'<polyline label="skyline" points="{made.cvat_points(SHARES[2:])}"/>'),
}


@pytest.mark.parametrize("kind", IN_SHARES)
def test_shares_of_the_sides_are_no_pixels(tmp_path, photos, kind):
    ending = "xml" if kind == "cvat" else "json"
    said = said_about(made.written(tmp_path / f"a.{ending}", IN_SHARES[kind]), photos)
    assert "its points lie within one pixel of the corner: coordinates must be in pixels." in said


# Photos of the same content


@pytest.mark.parametrize("kind", ["mask", "labelme"])
@pytest.mark.parametrize("apart", [0, 1, 20])
def test_labels_of_copies_are_one_and_the_others_are_named(tmp_path, photos, kind, apart):
    shutil.copy(photos / NAME, photos / "z.png")
    shutil.copy(photos / NAME, photos / "y.png")
    for name, row in ((NAME, 30), ("y.png", 30), ("z.png", 30 + apart)):
        stem = name.removesuffix(".png")
        if kind == "mask":
            sky = Skyline(np.full(WIDTH, row)).to_mask(HEIGHT)
            write_photo(tmp_path / "in" / name, np.where(sky, 0, 255).astype(np.uint8))
        else:
            document = labelme(shape(level(row)), name=name)
            made.written(tmp_path / "in" / f"{stem}.json", document)
    found = imported(tmp_path / "in", photos)
    assert [one.name for one in found] == [NAME]
    np.testing.assert_array_equal(found[0].skyline.rows, 30)
    told = f"y.png, z.png are the same photo as {NAME}, and one label of it is kept."
    assert found.notes == (told,)
    wrong = (
        f"z.png is the same photo as {NAME}, and their labels differ by up to {apart} px in "
        f"columns 0 to {WIDTH - 1}; that of {NAME} is kept."
    )
    assert found.problems == ((wrong,) if apart else ())


def test_a_label_that_only_a_copy_has_is_that_of_the_photo(tmp_path, photos):
    (photos / "day").mkdir()
    shutil.copy(photos / NAME, photos / "z.png")
    shutil.copy(photos / NAME, photos / "day" / NAME)
    SKYLINE.write_csv(tmp_path / "in" / "z.csv")
    is_right(imported(tmp_path / "in", photos))
    document = labelme(shape(level(30)), name=f"elsewhere/{NAME}")
    found = imported(made.written(tmp_path / "a.json", document), photos)
    assert [one.name for one in found] == [NAME]
