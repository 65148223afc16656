"""Pictures of photos at work: made once, and never of what was there before."""

import shutil
from dataclasses import replace

import pytest

from annotate.store.operations import SetAnchor
from annotate.work import images, shown
from annotate.work.shown import NoPictureError, Pictures
from skyline_viz.config import DetectorConfig
from skyline_viz.photo import PhotoError, write_photo
from testing.labelling import DETECTOR, hills, workbench

KINDS = {
    "whole": lambda pictures: pictures.whole(1),
    "tile": lambda pictures: pictures.tile(1, 0, 0),
    "stage": lambda pictures: pictures.stage(1, "cost"),
    "thumbnail": lambda pictures: pictures.thumbnail(1),
    "strip": lambda pictures: pictures.strip(1, 64),
}


@pytest.fixture
def folder(tmp_path):
    write_photo(tmp_path / "one.jpg", hills(1))
    return tmp_path


@pytest.fixture
def bench(folder):
    found = workbench(folder)
    yield found
    found.close()


@pytest.mark.parametrize("kind", KINDS)
def test_a_picture_is_made_once(bench, kind):
    pictures = Pictures(bench)
    assert KINDS[kind](pictures) is KINDS[kind](pictures)


@pytest.mark.parametrize("kind", KINDS)
def test_another_photo_has_other_pictures_whatever_it_is_called(folder, kind):
    found = []
    for seed in (1, 2):
        write_photo(folder / "one.jpg", hills(seed))
        shutil.rmtree(folder / ".skyline", ignore_errors=True)
        (folder / "skyline-labels.sqlite").unlink(missing_ok=True)
        bench = workbench(folder)
        found.append(KINDS[kind](Pictures(bench)).tag)
        bench.close()
    assert found[0] != found[1]


@pytest.mark.parametrize("kind", ["thumbnail", "strip"])
def test_a_picture_of_a_file_that_was_replaced_or_went_is_not_shown_again(folder, bench, kind):
    pictures = Pictures(bench)
    bench.session(1)
    bench.close_photo(1)
    KINDS[kind](pictures)
    kept = (folder / "one.jpg").read_bytes()
    write_photo(folder / "one.jpg", hills(2))
    with pytest.raises(PhotoError, match="another photo now"):
        KINDS[kind](pictures)
    (folder / "one.jpg").unlink()
    with pytest.raises(PhotoError, match=r"one\.jpg"):
        KINDS[kind](pictures)
    (folder / "one.jpg").write_bytes(kept)
    assert KINDS[kind](pictures).data


def test_another_detector_has_other_stages_and_the_same_one_again_the_same(bench):
    pictures = Pictures(bench)
    before = pictures.stage(1, "cost")
    other = replace(DETECTOR, config=DetectorConfig(non_edge_cost=0.2, clear_sky=0.2))
    assert bench.propose_again(other) == 1
    assert pictures.stage(1, "cost").tag != before.tag
    bench.propose_again(replace(other, config=DETECTOR.config))
    assert pictures.stage(1, "cost") is before


def test_a_strip_follows_the_line(bench):
    pictures = Pictures(bench)
    before = pictures.strip(1, 64)
    bench.session(1).apply(SetAnchor(column=30, row=40), -1)
    after = pictures.strip(1, 64)
    assert after.tag != before.tag
    bench.session(1).undo(-1)
    assert pictures.strip(1, 64) is before


def test_the_lock_of_a_photo_is_free_while_its_pictures_are_made(bench, monkeypatch):
    lock = bench.session(1).lock
    seen = []
    for name in ("view", "tile", "thumbnail", "thumbnail_of_file", "strip"):
        real = getattr(images, name)

        def made(*words, real=real, name=name):
            seen.append((name, lock._is_owned()))
            return real(*words)

        monkeypatch.setattr(images, name, made)
    real = shown.overlay
    monkeypatch.setattr(
        shown, "overlay", lambda *words: seen.append(("stage", lock._is_owned())) or real(*words)
    )
    for make in KINDS.values():
        make(Pictures(bench))
    assert {name for name, _ in seen} >= {"view", "tile", "strip", "stage"}
    assert not any(owned for _, owned in seen)


def test_what_there_is_not_is_said(bench):
    pictures = Pictures(bench)
    with pytest.raises(NoPictureError, match="no such tile"):
        pictures.tile(1, 1, 0)
    with pytest.raises(NoPictureError, match="no such stage; there are sky, edges"):
        pictures.stage(1, "x")


def test_a_photo_over_the_limit_has_no_thumbnail(bench, monkeypatch):
    monkeypatch.setattr(shown, "photo_limit", lambda: 0.001)
    monkeypatch.setattr("skyline_viz.system.memory._Limit.megapixels", 0.001)
    with pytest.raises(PhotoError, match=r"over the limit of 0\.001 megapixels"):
        Pictures(bench).thumbnail(1)


@pytest.mark.parametrize("kind", ["thumbnail", "strip"])
def test_the_file_of_another_photo_in_its_place_is_refused_though_its_picture_is_kept(folder, kind):
    write_photo(folder / "two.jpg", hills(2))
    bench = workbench(folder)
    pictures = Pictures(bench)
    show = {"thumbnail": pictures.thumbnail, "strip": lambda photo: pictures.strip(photo, 64)}[kind]
    for photo in (1, 2):
        session = bench.session(photo)
        session.apply(SetAnchor(column=30, row=40), -1)
        bench.close_photo(photo)
        show(photo)
    shutil.copy(folder / "one.jpg", folder / "two.jpg")
    with pytest.raises(PhotoError, match="another photo"):
        show(2)
    bench.close()
