"""Galleries on disk: what is detected again and what is not, and what survives."""

import json
from pathlib import Path

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.command_line.inputs import collect
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.datasets.named_item import NamedItem
from skyline_viz.gallery.documents import GalleryError
from skyline_viz.gallery.entry import by_need
from skyline_viz.gallery.flags import Change, Flag, change_flags, read_flags
from skyline_viz.gallery.store import Gallery
from skyline_viz.running.batch import Failure
from skyline_viz.viewer import entities
from testing.recordings import Read, verify


def scene(level, width=70):
    photo = np.full((60, width, 3), (150, 190, 230), np.uint8)
    photo[level:] = (60, 70, 40)
    return photo


@pytest.fixture
def photos(tmp_path):
    """Three photos; the truth of the second one is 9 rows off."""
    folder = tmp_path / "data"
    for number, off in enumerate((0, 9, 2)):
        photo = scene(25 + number)
        sv.write_photo(folder / "images" / f"p{number}.png", photo)
        rows = np.full(70, 25.0 + number + off)
        sv.Skyline(rows).write_csv(folder / "masks" / f"p{number}.csv")
    return folder


def build(gallery, folder, detector=None):
    """Outcomes, and the names of the recordings that were written."""
    recordings = gallery.folder / "recordings"
    before = {path: path.stat().st_mtime_ns for path in recordings.glob("*.rrd")}
    shots = collect([folder])
    outcomes = list(gallery.build(shots, detector or sv.Detector(), workers=1))
    after = {path: path.stat().st_mtime_ns for path in recordings.glob("*.rrd")}
    return outcomes, sorted(path.stem for path in after if after[path] != before.get(path))


def test_a_gallery_holds_a_whole_recording_and_an_entry_a_photo(photos, tmp_path):
    gallery = Gallery(tmp_path / "g")
    outcomes, written = build(gallery, photos)
    assert written == ["p0", "p1", "p2"]
    assert {one.name: one for one in outcomes} == gallery.entries()
    for entry in outcomes:
        verify(gallery.recording(entry.name))
        read = Read(gallery.recording(entry.name))
        assert read.array("metrics/a_err", "scalars") == pytest.approx([entry.verdict.a_err])
    assert [one.name for one in by_need(outcomes)] == ["p1", "p2", "p0"]
    assert [one.verdict.a_err for one in by_need(outcomes)] == pytest.approx([9, 2, 0])
    assert by_need(outcomes)[0].wrong == "0 to 69"
    assert {(one.height, one.width) for one in outcomes} == {(60, 70)}


def test_what_went_wrong_is_diagnosed(photos, tmp_path):
    sv.write_photo(photos / "images" / "p3.png", scene(20))
    sv.write_photo(photos / "images" / "p4.png", scene(20))
    unseen = sv.Skyline(np.full(70, 20.0), np.zeros(70, bool))
    unseen.write_csv(photos / "masks" / "p4.csv")
    gallery = Gallery(tmp_path / "g")
    build(gallery, photos)
    entries = gallery.entries()
    (cause,) = entries["p1"].causes
    truth = sv.Skyline.read_csv(photos / "masks" / "p1.csv")
    detection = sv.Detector().detect(sv.read_photo(photos / "images" / "p1.png"))
    assert entries["p1"].cause == cause == sv.diagnose(detection, truth).main.cause
    told = {name: (one.causes, one.cause) for name, one in entries.items() if name != "p1"}
    (title,) = entries["p1"].titles
    assert title.startswith(cause)
    right, unknown = ((), None), (None, None)
    assert told == {"p0": right, "p2": right, "p3": unknown, "p4": unknown}
    for name, says in (("p1", f"**{cause}"), ("p0", "Right"), ("p3", None), ("p4", None)):
        read = Read(gallery.recording(name))
        assert (entities.DIAGNOSIS in read.entities()) == (says is not None)
        assert says is None or says in read.last(entities.DIAGNOSIS, "text").as_py()[0]
        assert (f"{entities.SEGMENTS}/largest" in read.entities()) == (name == "p1")


def test_an_older_gallery_is_done_again_and_keeps_its_reviews(photos, tmp_path):
    gallery = Gallery(tmp_path / "g")
    first, _ = build(gallery, photos)
    change_flags(gallery.folder, {"p0": Change(reviewed=True, comment="fine")})
    index = gallery.folder / "gallery.json"
    document = json.loads(index.read_text())
    for one in document["photos"]:
        del one["causes"]
    index.write_text(json.dumps(document | {"version": 1}))
    assert json.loads((gallery.folder / "flags.json").read_text())["version"] == 1
    again, written = build(gallery, photos)
    assert written == ["p0", "p1", "p2"]
    assert again == first
    assert read_flags(gallery.folder) == {"p0": Flag(reviewed=True, comment="fine")}


def test_nothing_is_done_twice(photos, tmp_path):
    gallery = Gallery(tmp_path / "g")
    first, _ = build(gallery, photos)
    again, written = build(gallery, photos)
    assert written == []
    assert again == first


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is read from /proc")
def test_memory_does_not_grow_with_the_number_of_photos(tmp_path):
    photo = np.random.default_rng(0).integers(0, 255, (300, 400, 3)).astype(np.uint8)
    sv.write_photo(tmp_path / "a.png", photo)
    shots = [NamedItem(f"p{number}", DatasetItem("a", tmp_path / "a.png")) for number in range(120)]
    outcomes = Gallery(tmp_path / "g").build(shots, sv.Detector(), workers=1)
    pages = [int(Path("/proc/self/statm").read_text().split()[1]) for _ in outcomes]
    assert (pages[-1] - pages[40]) * 4096 < 40e6  # each recording holds 2 MB before it is written


def change_photo(photos):
    sv.write_photo(photos / "images" / "p1.png", scene(30))
    return sv.Detector()


def change_truth(photos):
    sv.Skyline(np.full(70, 20.0)).write_csv(photos / "masks" / "p1.csv")
    return sv.Detector()


def drop_truth(photos):
    (photos / "masks" / "p1.csv").unlink()
    return sv.Detector()


def change_configuration(photos):
    return sv.Detector(config=sv.DetectorConfig(delta=2))


def change_bank(photos):
    old = sv.FilterBank.default()
    return sv.Detector(sv.FilterBank(old.filters * 0.9, old.samples, old.bins))


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (change_photo, ["p1"]),
        (change_truth, ["p1"]),
        (drop_truth, ["p1"]),
        (change_configuration, ["p0", "p1", "p2"]),
        (change_bank, ["p0", "p1", "p2"]),
    ],
)
def test_what_changed_is_done_again(photos, tmp_path, change, expected):
    gallery = Gallery(tmp_path / "g")
    build(gallery, photos)
    _, written = build(gallery, photos, change(photos))
    assert written == expected


@pytest.mark.parametrize("file", [Gallery.recording, Gallery.thumbnail])
def test_what_is_lost_of_a_photo_is_made_again(photos, tmp_path, file):
    gallery = Gallery(tmp_path / "g")
    build(gallery, photos)
    file(gallery, "p2").unlink()
    assert build(gallery, photos)[1] == ["p2"]
    assert file(gallery, "p2").exists()


def test_a_run_that_is_cut_short_goes_on_where_it_stopped(photos, tmp_path):
    gallery = Gallery(tmp_path / "g")
    shots = collect([photos])
    outcomes = gallery.build(shots, sv.Detector(), workers=1)
    next(outcomes)
    outcomes.close()
    assert list(gallery.entries()) == ["p0"]
    assert build(gallery, photos)[1] == ["p1", "p2"]


def test_a_bad_photo_does_not_stop_the_others(photos, tmp_path):
    (photos / "images" / "p0.png").write_bytes(b"no photo")
    gallery = Gallery(tmp_path / "g")
    outcomes, written = build(gallery, photos)
    assert written == ["p1", "p2"]
    assert [one.name for one in outcomes if isinstance(one, Failure)] == ["p0"]
    assert list(gallery.entries()) == ["p1", "p2"]


def test_photos_that_are_gone_leave_the_gallery_but_not_the_reviews(photos, tmp_path):
    gallery = Gallery(tmp_path / "g")
    build(gallery, photos)
    change_flags(gallery.folder, {"p0": Change(reviewed=True, comment="fine")})
    (photos / "images" / "p0.png").unlink()
    (photos / "masks" / "p0.csv").unlink()
    build(gallery, photos)
    assert list(gallery.entries()) == ["p1", "p2"]
    assert read_flags(gallery.folder) == {"p0": Flag(reviewed=True, comment="fine")}


@pytest.mark.parametrize("content", ["", "{}", '{"version": 99, "photos": []}', '{"version": 1}'])
def test_a_damaged_index_is_one_sentence(photos, tmp_path, content):
    (tmp_path / "g").mkdir()
    (tmp_path / "g" / "gallery.json").write_text(content)
    with pytest.raises(GalleryError, match=r"gallery\.json is damaged"):
        build(Gallery(tmp_path / "g"), photos)


def test_items_can_be_put_in_by_hand(tmp_path):
    sv.write_photo(tmp_path / "a.png", scene(20))
    shot = NamedItem("mine", DatasetItem("a", Path(tmp_path / "a.png")))
    (entry,) = Gallery(tmp_path / "g").build([shot], sv.Detector(), workers=1)
    assert (entry.name, entry.verdict.a_err) == ("mine", None)
