"""COCO documents: regions of sky or terrain become lines; what is wrong is a sentence."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.datasets.coco import is_coco, photos_of_coco
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.skyline import SkylineError
from testing.examples import examples

HEIGHT, WIDTH = 12, 8


class Reports:
    def __init__(self):
        self.problems, self.notes = [], []

    def problem(self, sentence):
        self.problems.append(sentence)

    def note(self, text, of=None):
        self.notes.append((text, of))


def document(*segmentations, category="sky", **image):
    image = {"id": 1, "file_name": "a.jpg", "height": HEIGHT, "width": WIDTH, **image}
    return {
        "images": [image],
        "categories": [{"id": 7, "name": category}],
        "annotations": [
            {"id": place, "image_id": 1, "category_id": 7, "segmentation": one}
            for place, one in enumerate(segmentations, 1)
        ],
    }


def only(told, reports=None):
    (one,) = photos_of_coco(told, "d.json", reports or Reports())
    return one


def counts(mask):
    """Run lengths down the columns, the first of them outside."""
    lengths, inside = [0], False
    for pixel in mask.T.ravel().tolist():
        if pixel != inside:
            lengths.append(0)
            inside = pixel
        lengths[-1] += 1
    return {"size": [*mask.shape], "counts": lengths}


@examples(40)
@given(st.lists(st.integers(0, HEIGHT), min_size=WIDTH, max_size=WIDTH), st.booleans())
def test_run_lengths_of_sky_or_terrain_give_the_line(rows, terrain):
    mask = np.arange(HEIGHT)[:, None] < np.array(rows)
    drawn = only(document(counts(~mask if terrain else mask), category="Region"))
    asked = (None, "region") if terrain else ("region", None)
    assert drawn.line((HEIGHT, WIDTH), *asked).rows.tolist() == rows


def test_polygons_are_one_region():
    halves = [[0, 0, 4, 0, 4, 5, 0, 5]], [[4, 0, 8, 0, 8, 3, 4, 3]]
    drawn = only(document(*halves))
    assert drawn.names == ("a.jpg",)
    assert drawn.line((HEIGHT, WIDTH), None, None).rows.tolist() == [5] * 4 + [3] * 4


def test_what_does_not_fit_is_refused():
    box = only(document([]))
    with pytest.raises(SkylineError, match="no region is called sky; its regions are sky"):
        box.line((HEIGHT, WIDTH), None, None)
    with pytest.raises(SkylineError, match="no region is called rock; its regions are tree"):
        only(document([[0, 0, 4, 0, 4, 5]], category="tree")).line((HEIGHT, WIDTH), None, "rock")
    with pytest.raises(SkylineError, match="drawn on 8x12 pixels, and the photo has 8x13"):
        box.line((HEIGHT + 1, WIDTH), None, None)
    runs = only(document({"size": [3, 3], "counts": [9]}, height=None))
    with pytest.raises(SkylineError, match="run lengths are for 3x3 pixels"):
        runs.line((HEIGHT, WIDTH), None, None)


def test_what_is_damaged_is_left_out_and_told():
    told = document([[0, 0, 4]], {"size": [1], "counts": []})
    told["images"] += [{"id": 1, "file_name": "b"}, {"id": 2, "file_name": 5}, {}]
    told["annotations"].append({"image_id": 9})
    reports = Reports()
    assert only(told, reports).regions == ()
    assert len(reports.problems) == 5
    assert reports.notes[0][0].startswith("d.json: annotations whose image is not in the file")
    with pytest.raises(FormatError, match="its images are no list of objects"):
        only({"images": 4, "annotations": []})


def test_only_documents_with_images_and_annotations_are_coco():
    assert is_coco(document())
    assert not any(map(is_coco, ({}, [], None, {"images": []})))
