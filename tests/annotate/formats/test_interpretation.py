"""From what was drawn on a photo to its skyline."""

import numpy as np

from testing import label_files as made
from testing.imports import imported, is_right, said_about
from testing.label_documents import OUTLINE
from testing.label_files import HEIGHT, ROWS, SKY, WIDTH, coco, labelme, shape


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


def test_a_photo_that_has_tags_alone_is_named(tmp_path, photos):
    folder = tmp_path / "labels"
    folder.mkdir()
    made.written(folder / "a.json", labelme(shape(OUTLINE, "sky", "polygon")))
    bare = {**labelme(), "imagePath": "b.png", "flags": {"no visible skyline": True}}
    made.written(folder / "b.json", bare)
    found = imported(folder, photos)
    assert found.notes == ("left out, with tags but without a line or a region: b.png.",)
    made.written(folder / "b.json", {**bare, "flags": {"no visible skyline": False}})
    assert imported(folder, photos).notes == ()  # nothing was said of it
