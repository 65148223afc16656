"""Reading photographs: every common format, and everything that can be wrong with one."""

import os

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from skyline_viz.photo import MAX_MEGAPIXELS, PhotoError, photo_size, read_photo, write_photo
from testing.examples import examples
from testing.pictures import EVERY_FORMAT, LOSSLESS, NOISE, PHOTO, bomb, close, refusal, save


@pytest.mark.parametrize("name", LOSSLESS)
def test_lossless_formats_come_back_exactly(tmp_path, name):
    photo = read_photo(save(tmp_path / name, NOISE))
    assert photo.dtype == np.uint8
    assert photo.flags.writeable
    assert np.array_equal(photo, NOISE)


@pytest.mark.parametrize("name", ["a.jpg", "a.jpeg", "a.JPG"])
def test_jpeg(tmp_path, name):
    Image.fromarray(PHOTO).save(tmp_path / name, "JPEG", quality=100, subsampling=0)
    assert close(read_photo(tmp_path / name), PHOTO)


def test_a_path_may_be_a_string(tmp_path):
    assert np.array_equal(read_photo(str(save(tmp_path / "a.png", NOISE))), NOISE)


def test_content_counts_and_not_the_name(tmp_path):
    save(tmp_path / "a.png", NOISE).rename(tmp_path / "a.jpg")
    assert np.array_equal(read_photo(tmp_path / "a.jpg"), NOISE)


def test_a_symlink_is_followed(tmp_path):
    (tmp_path / "b.png").symlink_to(save(tmp_path / "a.png", NOISE))
    assert np.array_equal(read_photo(tmp_path / "b.png"), NOISE)


@pytest.mark.parametrize("kind", ["png", "tif", "bmp", "pgm"])
def test_grey_becomes_rgb(tmp_path, kind):
    grey = np.ascontiguousarray(NOISE[:, :, 1])
    photo = read_photo(save(tmp_path / f"a.{kind}", grey))
    assert np.array_equal(photo, grey[:, :, None].repeat(3, axis=2))


@pytest.mark.parametrize("kind", ["png", "tif", "bmp"])
def test_one_bit_becomes_black_and_white(tmp_path, kind):
    bits = NOISE[:, :, 0] > 127
    photo = read_photo(save(tmp_path / f"a.{kind}", bits))
    assert np.array_equal(photo, bits[:, :, None].repeat(3, axis=2) * np.uint8(255))


@pytest.mark.parametrize("kind", ["jpg", "tif"])
def test_cmyk_becomes_rgb(tmp_path, kind):
    Image.fromarray(PHOTO).convert("CMYK").save(tmp_path / f"a.{kind}", quality=100)
    assert close(read_photo(tmp_path / f"a.{kind}"), PHOTO, tolerance=10)


def test_a_plain_text_pgm(tmp_path):
    values = " ".join(str(value) for value in NOISE[:, :, 0].ravel())
    (tmp_path / "a.pgm").write_text(f"P2\n# comment\n32 24\n255\n{values}\n")
    assert np.array_equal(read_photo(tmp_path / "a.pgm")[:, :, 2], NOISE[:, :, 0])


@pytest.mark.parametrize("share", [0.02, 0.3, 0.6, 0.9])
@pytest.mark.parametrize("name", EVERY_FORMAT)
def test_a_truncated_photo_is_refused(tmp_path, name, share):
    path = save(tmp_path / name, NOISE)
    data = path.read_bytes()
    path.write_bytes(data[: max(1, int(len(data) * share))])
    message = refusal(path)
    assert "damaged" in message or "not an image" in message


@pytest.mark.parametrize("name", EVERY_FORMAT)
def test_an_empty_file_is_refused(tmp_path, name):
    (tmp_path / name).touch()
    assert "0 bytes" in refusal(tmp_path / name)


@pytest.mark.parametrize(
    "content", [b"hello\n", b"\0" * 100, b"%PDF-1.7", b"GIF89a" + b"\0" * 90, b"\xff\xd8"]
)
def test_what_is_no_photo_is_refused(tmp_path, content):
    (tmp_path / "a.jpg").write_bytes(content)
    refusal(tmp_path / "a.jpg")


@examples(40)
@given(
    data=st.binary(min_size=1, max_size=200),
    start=st.sampled_from(
        [b"", b"\x89PNG\r\n\x1a\n", b"BM", b"P5 9 9 255\n", b"II*\0", b"\xff\xd8\xff"]
    ),
)
def test_no_bytes_at_all_raise_anything_else(tmp_path_factory, data, start):
    path = tmp_path_factory.mktemp("bytes") / "a"
    path.write_bytes(start + data)
    for read in (read_photo, photo_size):
        try:
            read(path)
        except PhotoError as error:
            assert str(path) in str(error)


@pytest.mark.parametrize("shape", [(1, 1), (1, 100), (100, 1), (7, 100)])
def test_a_tiny_photo_is_refused(tmp_path, shape):
    path = save(tmp_path / "a.png", np.zeros((*shape, 3), np.uint8))
    assert f"{shape[1]}x{shape[0]}" in refusal(path)


def test_the_smallest_photo(tmp_path):
    assert read_photo(save(tmp_path / "a.png", NOISE[:8, :8])).shape == (8, 8, 3)


def test_a_missing_photo_is_refused(tmp_path):
    assert "no such file" in refusal(tmp_path / "a.jpg")


def test_a_folder_is_refused(tmp_path):
    assert "folder" in refusal(tmp_path)


@pytest.mark.parametrize("name", ["a\0b", "a" * 5000])
def test_an_impossible_name_is_refused(name):
    refusal(name)


def test_a_loop_of_links_is_refused(tmp_path):
    (tmp_path / "a.jpg").symlink_to(tmp_path / "a.jpg")
    refusal(tmp_path / "a.jpg")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_is_refused_without_waiting(tmp_path):
    os.mkfifo(tmp_path / "a.jpg")
    assert "pipe" in refusal(tmp_path / "a.jpg")


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="needs devices")  # noqa: PTH110
def test_a_device_is_refused():
    assert "device" in refusal("/dev/zero")


def test_a_photo_that_may_not_be_read_is_refused(tmp_path, monkeypatch):
    path = save(tmp_path / "a.png", NOISE)

    def closed(*args, **kwargs):
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Image, "open", closed)
    assert refusal(path) == f"{path} cannot be read: permission denied."


def test_a_folder_that_may_not_be_entered(tmp_path, monkeypatch):
    def closed(*args, **kwargs):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(type(tmp_path), "stat", closed)
    assert "permission denied" in refusal(tmp_path / "a.jpg")


def test_a_photo_that_does_not_fit_into_memory(tmp_path, monkeypatch):
    path = save(tmp_path / "a.png", NOISE)

    def full(*args, **kwargs):
        raise MemoryError

    monkeypatch.setattr(Image.Image, "crop", full)
    assert refusal(path) == f"{path} does not fit into memory."


def test_a_decompression_bomb_is_refused_undecoded(tmp_path, monkeypatch):
    path = bomb(tmp_path / "a.png", 60_000, 60_000)
    monkeypatch.setattr(Image.Image, "load", lambda self: pytest.fail("decoded"))
    message = refusal(path)
    assert "60000x60000" in message
    assert f"{MAX_MEGAPIXELS:g} megapixels" in message


def test_the_pixel_limit_is_the_callers(tmp_path):
    path = save(tmp_path / "a.png", NOISE)
    pixels = NOISE.shape[0] * NOISE.shape[1]
    assert read_photo(path, max_megapixels=pixels / 1e6).shape == NOISE.shape
    assert "limit" in refusal(path, max_megapixels=(pixels - 1) / 1e6)


def test_photo_size_reads_no_pixels(tmp_path, monkeypatch):
    paths = [save(tmp_path / name, NOISE) for name in EVERY_FORMAT]
    monkeypatch.setattr(Image.Image, "load", lambda self: pytest.fail("decoded"))
    assert {photo_size(path) for path in paths} == {NOISE.shape[:2]}
    assert photo_size(bomb(tmp_path / "bomb.png", 60_000, 50_000)) == (50_000, 60_000)


@pytest.mark.parametrize("name", LOSSLESS[:5])
def test_write_photo_round_trip(tmp_path, name):
    write_photo(tmp_path / "new" / name, NOISE)
    assert np.array_equal(read_photo(tmp_path / "new" / name), NOISE)
    write_photo(tmp_path / "new" / name, NOISE[:, :, 0])
    assert np.array_equal(read_photo(tmp_path / "new" / name)[:, :, 1], NOISE[:, :, 0])


def test_write_photo_quality(tmp_path):
    write_photo(tmp_path / "low.jpg", NOISE, quality=10)
    write_photo(tmp_path / "high.jpg", NOISE, quality=95)
    assert (tmp_path / "low.jpg").stat().st_size < (tmp_path / "high.jpg").stat().st_size


def test_write_photo_refuses_an_unknown_ending_and_leaves_nothing(tmp_path):
    with pytest.raises(ValueError, match="extension"):
        write_photo(tmp_path / "a.xyz", NOISE)
    assert list(tmp_path.iterdir()) == []
