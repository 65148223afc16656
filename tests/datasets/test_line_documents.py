"""Documents that hold the lines of many photos."""

import json

import skyline_viz as sv
from skyline_viz.datasets.line_documents import documents_in, lines_in
from testing.datasets import SKYLINE, put


class Reports(list):
    def problem(self, sentence):
        self.append(sentence)

    def note(self, text, of=None):
        self.append(text)


def labels(*more):
    line = {"rows": SKYLINE.rows.tolist(), "visible": SKYLINE.visible.tolist()}
    told = [{"name": "a.jpg", "skyline": line}, *more]
    return {"format": "skyline-labels", "version": 2, "labels": told}


def test_documents_are_known_by_their_content_and_the_exact_one_counts(tmp_path):
    coco = {"images": [], "annotations": []}
    for name, told in (
        ("labels.json", labels()),
        ("annotations-rle.json", coco),
        ("annotations-polygon.json", coco),
        ("run.json", {"labels": []}),
    ):
        (tmp_path / name).write_text(json.dumps(told))
    (tmp_path / "broken.json").write_text("{")
    found = documents_in(sorted(tmp_path.iterdir()))
    assert [file.name for file, _ in found] == ["annotations-rle.json", "labels.json"]
    (tmp_path / "annotations-rle.json").unlink()
    assert len(documents_in(sorted(tmp_path.iterdir()))) == 2


def test_labels_give_their_lines_and_damaged_ones_are_told(tmp_path):
    reports = Reports()
    told = labels({"name": "b.jpg"}, 4)
    ((names, line),) = lines_in(tmp_path / "labels.json", told, reports)
    assert (names, line) == (["a.jpg"], SKYLINE)
    assert [one.rpartition("/")[2] for one in reports] == [
        f"labels.json: label {place} has no name or no line." for place in (2, 3)
    ]


def test_predictions_take_them_by_the_names_of_photos(tmp_path):
    put(tmp_path / "set" / "images" / "a.jpg")
    items = list(sv.open_dataset(tmp_path / "set"))
    zebra = {**labels()["labels"][0], "name": "zebra.jpg"}
    (tmp_path / "labels.json").write_text(json.dumps(labels(zebra)))
    found = sv.open_predictions(tmp_path / "labels.json", items)
    assert found.extra == ("zebra.jpg in labels.json",)
    assert found.line(items[0]) == SKYLINE
