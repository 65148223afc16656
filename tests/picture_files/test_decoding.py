"""One photo in every file that people have of it: the same line, or a sentence."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

import skyline_viz as sv
from skyline_viz.photo import photo_size, read_photo, read_photo_with_notes
from skyline_viz.picture_files import decoding
from testing import photo_files
from testing.examples import examples

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


@examples(150)
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


@pytest.mark.parametrize("mode", ["RGB", "L", "CMYK", "YCbCr", "P", "1"])
@pytest.mark.parametrize("strip", [1, 4 * 30 * 7, 1 << 20])
def test_a_picture_copied_in_strips_is_the_whole_picture(mode, strip, monkeypatch):
    monkeypatch.setattr(decoding, "_STRIP", strip)
    noise = np.random.default_rng(1).integers(0, 256, (20, 30, 3), np.uint8)
    image = Image.fromarray(noise).convert(mode)
    pixels = decoding._rgb(image)
    assert np.array_equal(pixels, np.array(image.convert("RGB")))
    assert pixels.flags.writeable
    assert pixels.flags.c_contiguous
