"""What a file or folder holds: its files, their format, and what was drawn in them."""

import pytest

from annotate.formats import sources
from annotate.formats.importing import Found
from annotate.formats.sources import drawings_in, files_below, format_of
from skyline_viz.datasets.outlines import FormatError
from testing.label_documents import FLAT
from testing.label_files import coco, labelme, line, shape, written


def made(folder, *names):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).touch()


def test_files_are_found_below_but_not_hidden_or_too_deep(tmp_path):
    made(tmp_path, "b", "a/c", ".hidden", "a/.b/c", "1/2/3/4/in", "1/2/3/4/5/out")
    found = [file.relative_to(tmp_path).as_posix() for file in files_below(tmp_path)]
    assert found == ["b", "a/c", "1/2/3/4/in"]
    assert files_below(tmp_path / "b") == [tmp_path / "b"]


def test_too_many_files_and_closed_folders_are_sentences(tmp_path, monkeypatch):
    made(tmp_path, "a", "b")
    monkeypatch.setattr(sources, "_MOST_FILES", 1)
    with pytest.raises(FormatError, match="holds more than 1 files"):
        files_below(tmp_path)

    def closed(path):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(type(tmp_path), "iterdir", closed)
    with pytest.raises(FormatError, match="cannot be listed: permission denied"):
        files_below(tmp_path)


@pytest.mark.parametrize(
    ("names", "kind"),
    [
        (["labels.json", "a.csv"], "json"),
        (["names.csv", "a.png"], "painted"),
        (["cvg/ground_truth/a-mask.png"], "ch1"),
        (["masks/a.png", "b.csv"], "csv"),
        (["masks/a.png", "readme.txt"], "mask"),
    ],
)
def test_the_format_of_a_folder(tmp_path, names, kind):
    made(tmp_path, *names)
    for file in tmp_path.rglob("*.csv"):
        file.write_text("column,row,visible\n")
    assert format_of(tmp_path, files_below(tmp_path)) == kind


def test_a_folder_of_no_format_says_what_it_holds(tmp_path):
    made(tmp_path, "notes.md")
    with pytest.raises(FormatError, match=r"of no known format: it holds notes\.md"):
        format_of(tmp_path, files_below(tmp_path))
    (tmp_path / "a.txt").write_text("0 0.1 0.1 0.5 0.5 0.9 0.1")
    with pytest.raises(FormatError, match=r"no known format: a\.txt is YOLO text"):
        format_of(tmp_path, files_below(tmp_path))


def test_a_damaged_file_among_others_is_a_problem_and_one_of_another_kind_a_note(tmp_path):
    written(tmp_path / "a.json", labelme(shape(line())))
    written(tmp_path / "b.json", coco([[FLAT]]))
    (tmp_path / "c.json").write_text("{")
    found = Found()
    drawn = list(drawings_in(files_below(tmp_path), "labelme", found))
    assert len(drawn) == 1
    assert drawn[0].names[0] == "ridge.png"
    assert found.notes == ["not read, because it is COCO: b.json."]
    assert "c.json" in found.problems[0]


def test_where_nothing_is_of_the_format_it_is_said(tmp_path):
    file = written(tmp_path / "b.json", coco([[FLAT]]))
    found = Found()
    assert list(drawings_in([file], "labelme", found)) == []
    assert found.problems == [f"{file} is COCO, not LabelMe."]
    found = Found()
    assert list(drawings_in([file, file.with_name("x")], "cvat", found)) == []
    assert found.problems == ["there is no .xml file in it."]
