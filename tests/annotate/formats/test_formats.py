"""Formats of labels: what comes back, what other programs see, and what is refused."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

import annotate.formats as formats
from annotate.engine.hidden import Hidden
from annotate.formats import FORMATS, FormatError, export_labels, import_labels
from annotate.store.labels import TAGS, Label
from testing.examples import examples
from testing.exports import FILE, HEIGHT, WIDTH, label, put, refused, there_and_back, without_line

KEEP_VISIBLE = ("painted", "csv", "json", "labelme", "cvat", "parquet")
KEEP_TAGS = ("json", "labelme", "cvat", "parquet")
EVERY = pytest.mark.parametrize("kind", list(FORMATS))
FEW = examples(25, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture
def photos(tmp_path):
    put(tmp_path / "photos", "a.png")
    return tmp_path / "photos"


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

TEXT = {kind: FILE[kind] for kind in ("json", "coco", "labelme", "cvat", "csv")}


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


@pytest.mark.parametrize("kind", FORMATS)
def test_a_photo_without_a_visible_skyline_leaves_no_line(tmp_path, photos, kind):
    put(photos, "fog.png", seed=5)
    blank = label(photos, "fog.png", visible=np.zeros(WIDTH, bool), tags=["no visible skyline"])
    export = export_labels([label(photos, "a.png"), blank], photos, tmp_path / "out", kind)
    if kind in ("mask", "ch1", "coco", "painted"):
        assert export.written == 1
        (said,) = export.notes
        assert said == f"left out, because {kind} cannot say that nothing is visible: fog.png."
        with pytest.raises(
            FormatError, match=f"to export: {kind} cannot say that nothing is visible"
        ):
            export_labels([blank], photos, tmp_path / "alone", kind)
    else:
        assert (export.written, export.notes) == (2, ())


@pytest.mark.parametrize("kind", FORMATS)
def test_what_a_format_cannot_say_of_hidden_columns_is_said(tmp_path, photos, kind):
    visible = np.arange(WIDTH) >= 6
    one = replace(label(photos, "a.png", visible=visible), hidden=(Hidden(0, 5, "fog"),))
    notes = export_labels([one], photos, tmp_path / "out", kind).notes
    loses = {"mask": "which", "ch1": "which", "coco": "which", "csv": "", "json": ""}.get(
        kind, "why"
    )
    wanted = (f"{kind} cannot say {loses} columns are not visible: a.png.",) if loses else ()
    assert notes == wanted
