"""One photo in every file that people have of it: the same line, or a sentence."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

import skyline_viz as sv
from skyline_viz.photo import photo_size, read_photo, read_photo_with_notes
from skyline_viz.picture_files.pixel_depth import white_of
from skyline_viz.picture_files.transparency import without_transparency
from testing import photo_files

PHOTO, ROWS = photo_files.scene()


def apart(photo):
    return np.abs(sv.Detector().detect(photo).skyline.rows - ROWS).mean()


@pytest.mark.parametrize("name", photo_files.READ)
def test_the_same_line_in_every_file(tmp_path, name):
    photo_files.READ[name](tmp_path / name, PHOTO)
    photo, notes = read_photo_with_notes(tmp_path / name)
    assert photo.shape == PHOTO.shape
    assert photo_size(tmp_path / name) == PHOTO.shape[:2]
    assert apart(photo) <= apart(PHOTO) + 1
    assert np.array_equal(photo, read_photo(tmp_path / name))
    assert all(note.startswith(f"{tmp_path / name} ") and note.endswith(".") for note in notes)
    assert photo_files.NOTED.get(name, "") in " ".join(notes)
    if name in ("heic.heic", "exif_6.jpg", "16.png", "big_text.png", "xmp.jpg"):
        assert notes == ()


def test_a_jpeg_without_its_last_rows_is_read_with_a_note(tmp_path):
    photo, rows = photo_files.scene(height=400)
    path = tmp_path / "a.jpg"
    photo_files.jpeg_cut(0.993)(path, photo)
    read, (note,) = read_photo_with_notes(path)
    assert "rows are missing" in note
    assert np.abs(sv.Detector().detect(read).skyline.rows - rows).mean() < 3
    assert np.abs(read[:380].astype(int) - photo[:380]).mean() < 6
    assert (read[-1] == read[-8]).all()


@pytest.mark.parametrize("name", ["16.png", "12.png", "10.tif", "12_deflate.tif", "linear.png"])
def test_depths_come_back_as_they_were(tmp_path, name):
    photo_files.READ[name](tmp_path / name, PHOTO)
    assert np.abs(read_photo(tmp_path / name).astype(int) - PHOTO).max() <= 2


@pytest.mark.parametrize("name", photo_files.REFUSED)
def test_what_is_not_read_is_refused_by_name(tmp_path, name, capfd):
    make, reason = photo_files.REFUSED[name]
    make(tmp_path / name, PHOTO)
    with pytest.raises(sv.PhotoError) as caught:
        read_photo(tmp_path / name)
    assert reason in str(caught.value)
    assert str(caught.value).startswith(str(tmp_path / name))
    assert "\n" not in str(caught.value)
    assert capfd.readouterr() == ("", "")


@settings(deadline=None, max_examples=150)
@given(
    name=st.sampled_from(sorted(photo_files.READ)),
    places=st.lists(st.tuples(st.floats(0, 1), st.integers(0, 255)), min_size=1, max_size=6),
    keep=st.sampled_from([1.0, 1.0, 0.9, 0.5]),
)
def test_a_damaged_file_ends_in_a_photo_or_a_sentence(tmp_path_factory, name, places, keep):
    path = tmp_path_factory.getbasetemp() / f"damaged-{name}"
    photo_files.READ[name](path, PHOTO[:40, :48])
    data = bytearray(path.read_bytes())
    for place, value in places:
        data[int(place**3 * (len(data) - 1))] = value  # mostly in the header
    path.write_bytes(data[: int(len(data) * keep)])
    for read in (photo_size, read_photo):
        try:
            read(path)
        except sv.PhotoError as error:
            assert str(path) in str(error)


def test_libtiff_does_not_speak_on_the_screen(tmp_path):
    path = tmp_path / "a.tif"
    Image.fromarray(PHOTO).save(path, compression="tiff_lzw")
    data = bytearray(path.read_bytes())
    data[200:2000] = bytes(1800)
    path.write_bytes(data)
    code = (
        f"from skyline_viz.photo import *\ntry: read_photo({str(path)!r})\nexcept PhotoError: pass"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
    assert (done.stdout, done.stderr) == (b"", b"")


def test_a_hole_takes_the_colours_around_it():
    photo = np.full((20, 30, 3), 90, np.uint8)
    alpha = np.full((20, 30), 255, np.uint8)
    alpha[8:12, 10:20] = 0
    photo[8:12, 10:20] = 3
    filled, note = without_transparency(photo, alpha)
    assert (filled == 90).all()
    assert note


def test_what_is_cut_off_becomes_white_and_half_transparent_pixels_stay():
    photo = np.full((20, 30, 3), 90, np.uint8)
    alpha = np.full((20, 30), 120, np.uint8)
    alpha[:5] = 0
    filled, _ = without_transparency(photo, alpha)
    assert (filled[:5] == 255).all()
    assert (filled[5:] == 90).all()
    everything, note = without_transparency(photo.copy(), np.zeros((20, 30), np.uint8))
    assert np.array_equal(everything, photo)
    assert "all over" in note


@given(st.integers(0, 65535), st.sampled_from([None, 1023, 4095, 65535]))
def test_white_holds_every_sample_and_a_guess_is_noted(brightest, said):
    white, note = white_of(np.array([0, brightest], np.uint16), said)
    assert white >= brightest
    assert white in (255, 1023, 4095, 16383, 65535)
    assert (note is None) == (white in (said, 65535))


def test_a_dark_photo_of_16_bits_that_says_so_stays_dark(tmp_path):
    path = tmp_path / "a.png"
    bits = photo_files.chunk(b"sBIT", bytes([16]))
    photo_files.deep(12, "png", colour=False)(path, PHOTO)
    data = path.read_bytes()
    path.write_bytes(data[:33] + bits + data[33:])
    photo, notes = read_photo_with_notes(path)
    assert photo.max() < 16
    assert notes == ()


def test_a_page_is_turned_as_the_first_page_says(tmp_path):
    import tifffile  # noqa: PLC0415

    path = Path(tmp_path / "a.tif")
    turned = np.ascontiguousarray(np.rot90(PHOTO))
    with tifffile.TiffWriter(path) as tiff:
        tags = [(274, 3, 1, 6, True)]
        small = np.ascontiguousarray(turned[::4, ::4])
        tiff.write(small, photometric="rgb", subfiletype=1, subifds=1, extratags=tags)
        tiff.write(turned, photometric="rgb", subfiletype=0)
    assert np.array_equal(read_photo(path), PHOTO)
    assert photo_size(path) == PHOTO.shape[:2]
