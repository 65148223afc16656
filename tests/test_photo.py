"""Reading photographs: every common format, and everything that can be wrong with one."""

import os
import struct
import threading
import warnings
import zlib

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from skyline_viz.photo import (
    MAX_MEGAPIXELS,
    PhotoError,
    find_photos,
    photo_size,
    read_photo,
    write_photo,
)
from skyline_viz.picture_files.listing import find_unread

# A picture that survives JPEG: 16x16 blocks of one colour, no two rotations of it alike.
BLOCKS = np.array(
    [
        [[200, 40, 40], [40, 200, 40], [40, 40, 200]],
        [[220, 220, 40], [30, 30, 30], [230, 230, 230]],
    ],
    np.uint8,
)
PHOTO = BLOCKS.repeat(16, axis=0).repeat(16, axis=1)  # (32, 48, 3)
NOISE = np.random.default_rng(7).integers(0, 256, (24, 32, 3), dtype=np.uint8)

LOSSLESS = ["a.png", "a.bmp", "a.ppm", "a.tif", "a.tiff", "a.webp"]
EVERY_FORMAT = ["a.jpg", "a.jpeg", *LOSSLESS, "a.pgm"]

# Where the first row and the first column of the stored pixels lie in the upright photo.
STORED = {
    1: lambda a: a,  # top, left
    2: lambda a: a[:, ::-1],  # top, right
    3: lambda a: a[::-1, ::-1],  # bottom, right
    4: lambda a: a[::-1],  # bottom, left
    5: lambda a: a.transpose(1, 0, 2),  # left, top
    6: lambda a: np.rot90(a, 1),  # right, top
    7: lambda a: np.rot90(a, 1)[:, ::-1],  # right, bottom
    8: lambda a: np.rot90(a, -1),  # left, bottom
}


def save(path, pixels, **options):
    if path.suffix == ".webp":
        options.setdefault("lossless", True)
    if path.suffix in (".jpg", ".jpeg"):
        options = {"quality": 100, "subsampling": 0} | options
    if path.suffix == ".pgm" and pixels.ndim == 3:
        pixels = pixels[:, :, 1]
    Image.fromarray(np.ascontiguousarray(pixels)).save(path, **options)
    return path


def refusal(path, **options):
    """The sentence with which a photo is refused."""
    with pytest.raises(PhotoError) as caught:
        read_photo(path, **options)
    message = str(caught.value)
    assert message.startswith(str(path))
    assert message.endswith(".")
    assert not message.endswith("..")
    assert "\n" not in message
    return message


def close(photo, expected, tolerance=6):
    return photo.shape == expected.shape and (
        np.abs(photo.astype(int) - expected).max(initial=0) <= tolerance
    )


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


@pytest.mark.parametrize("kind", ["jpg", "png", "tif", "webp"])
@pytest.mark.parametrize("orientation", STORED)
def test_exif_orientation_is_applied(tmp_path, orientation, kind):
    exif = Image.Exif()
    exif[0x0112] = orientation
    path = save(tmp_path / f"a.{kind}", STORED[orientation](PHOTO), exif=exif)
    assert close(read_photo(path), PHOTO)
    assert photo_size(path) == PHOTO.shape[:2]


@pytest.mark.parametrize("orientation", [0, 9, 65535])
def test_an_unknown_orientation_is_upright(tmp_path, orientation):
    exif = Image.Exif()
    exif[0x0112] = orientation
    path = save(tmp_path / "a.png", NOISE, exif=exif)
    assert np.array_equal(read_photo(path), NOISE)
    assert photo_size(path) == NOISE.shape[:2]


def test_orientation_in_16_bit_grey(tmp_path):
    grey = (NOISE[:, :, 0].astype(np.uint16) << 8) | 0x7F
    exif = Image.Exif()
    exif[0x0112] = 6
    Image.fromarray(np.ascontiguousarray(np.rot90(grey))).save(tmp_path / "a.png", exif=exif)
    assert np.array_equal(read_photo(tmp_path / "a.png"), NOISE[:, :, :1].repeat(3, axis=2))


@pytest.mark.parametrize("kind", ["jpg", "png", "webp"])
@pytest.mark.parametrize("exif", [b"Exif\0\0garbage", b"Exif\0\0II*\0\xff\xff\xff\xff", b"\0"])
def test_a_damaged_exif_block_does_not_cost_the_photo(tmp_path, kind, exif):
    path = save(tmp_path / f"a.{kind}", PHOTO, exif=exif)
    assert close(read_photo(path), PHOTO)
    assert photo_size(path) == PHOTO.shape[:2]


@pytest.mark.parametrize("kind", ["png", "tif", "bmp", "pgm"])
def test_grey_becomes_rgb(tmp_path, kind):
    grey = np.ascontiguousarray(NOISE[:, :, 1])
    photo = read_photo(save(tmp_path / f"a.{kind}", grey))
    assert np.array_equal(photo, grey[:, :, None].repeat(3, axis=2))


@pytest.mark.parametrize("kind", ["png", "tif", "webp"])
def test_alpha_is_dropped(tmp_path, kind):
    alpha = np.full((*NOISE.shape[:2], 1), 128, np.uint8)
    path = save(tmp_path / f"a.{kind}", np.concatenate([NOISE, alpha], axis=2), exact=True)
    assert np.array_equal(read_photo(path), NOISE)


def test_grey_with_alpha(tmp_path):
    path = save(
        tmp_path / "a.png", np.ascontiguousarray(NOISE[:, :, :2] | [[[0, 64]]]).astype("u1")
    )
    assert np.array_equal(read_photo(path), NOISE[:, :, :1].repeat(3, axis=2))


@pytest.mark.parametrize("transparency", [None, bytes(range(100, 116))])
def test_palette_becomes_rgb(tmp_path, transparency):
    image = Image.fromarray(NOISE).quantize(16)
    options = {} if transparency is None else {"transparency": transparency}
    image.save(tmp_path / "a.png", **options)
    expected = np.array(Image.fromarray(NOISE).quantize(16).convert("RGB"))
    assert np.array_equal(read_photo(tmp_path / "a.png"), expected)


@pytest.mark.parametrize("kind", ["png", "tif", "bmp"])
def test_one_bit_becomes_black_and_white(tmp_path, kind):
    bits = NOISE[:, :, 0] > 127
    photo = read_photo(save(tmp_path / f"a.{kind}", bits))
    assert np.array_equal(photo, bits[:, :, None].repeat(3, axis=2) * np.uint8(255))


@pytest.mark.parametrize("kind", ["jpg", "tif"])
def test_cmyk_becomes_rgb(tmp_path, kind):
    Image.fromarray(PHOTO).convert("CMYK").save(tmp_path / f"a.{kind}", quality=100)
    assert close(read_photo(tmp_path / f"a.{kind}"), PHOTO, tolerance=10)


@pytest.mark.parametrize("kind", ["png", "tif", "pgm"])
def test_16_bit_grey_keeps_the_high_byte(tmp_path, kind):
    low = np.random.default_rng(1).integers(0, 256, NOISE.shape[:2], dtype=np.uint16)
    deep = (NOISE[:, :, 0].astype(np.uint16) << 8) | low
    assert cv2.imwrite(str(tmp_path / f"a.{kind}"), deep)
    assert np.array_equal(read_photo(tmp_path / f"a.{kind}"), NOISE[:, :, :1].repeat(3, axis=2))


@pytest.mark.parametrize("kind", ["png", "tif", "ppm"])
def test_16_bit_colour_keeps_the_high_byte(tmp_path, kind):
    deep = (NOISE.astype(np.uint16) << 8) | 0x5A
    options = [cv2.IMWRITE_TIFF_COMPRESSION, 1] if kind == "tif" else []
    assert cv2.imwrite(str(tmp_path / f"a.{kind}"), deep[:, :, ::-1], options)
    assert close(read_photo(tmp_path / f"a.{kind}"), NOISE, tolerance=1)


def test_a_pgm_of_10_bits_fills_the_range(tmp_path):
    ten = np.linspace(0, 1023, 8 * 16).round().astype(">u2").reshape(8, 16)
    (tmp_path / "a.pgm").write_bytes(b"P5 16 8 1023\n" + ten.tobytes())
    photo = read_photo(tmp_path / "a.pgm")
    assert photo.min() == 0
    assert photo.max() == 255
    assert close(photo[:, :, 0], ten.astype(float) * 255 / 1023, tolerance=1)


def test_a_plain_text_pgm(tmp_path):
    values = " ".join(str(value) for value in NOISE[:, :, 0].ravel())
    (tmp_path / "a.pgm").write_text(f"P2\n# comment\n32 24\n255\n{values}\n")
    assert np.array_equal(read_photo(tmp_path / "a.pgm")[:, :, 2], NOISE[:, :, 0])


def test_floating_point_pixels_are_refused(tmp_path):
    Image.fromarray(np.zeros((16, 16), np.float32)).save(tmp_path / "a.tif")
    assert "floating-point" in refusal(tmp_path / "a.tif")


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


@settings(deadline=None, max_examples=40)
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

    monkeypatch.setattr(Image.Image, "convert", full)
    assert refusal(path) == f"{path} does not fit into memory."


def bomb(path, width, height):
    """A PNG of a few bytes that says it is huge."""

    def chunk(kind, data):
        checksum = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + checksum

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"\0")) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunks)
    return path


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


def test_pillows_own_limit_neither_counts_nor_changes(tmp_path, monkeypatch):
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 10)
    assert read_photo(save(tmp_path / "a.png", NOISE)).shape == NOISE.shape
    assert Image.MAX_IMAGE_PIXELS == 10
    refusal(tmp_path / "missing.png")
    assert Image.MAX_IMAGE_PIXELS == 10


def test_readers_in_threads_leave_pillow_and_warnings_as_they_were(tmp_path):
    image = Image.fromarray(NOISE).quantize(16)
    image.save(tmp_path / "a.png", transparency=bytes(range(16)))  # Pillow warns of this one
    limit, filters = Image.MAX_IMAGE_PIXELS, list(warnings.filters)
    start, failures = threading.Barrier(4), []

    def read():
        start.wait()
        try:
            for _ in range(20):
                read_photo(tmp_path / "a.png")
        except PhotoError as error:
            failures.append(error)

    threads = [threading.Thread(target=read) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60)
    assert failures == []
    assert limit == Image.MAX_IMAGE_PIXELS
    assert warnings.filters == filters


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


def test_find_photos(tmp_path):
    wanted = ["B.JPG", "a.jpeg", "c.Png", "d.bmp", "e.pgm", "f.tif", "g.TIFF", "h.webp", "i.ppm"]
    others = [".hidden.jpg", "._a.jpeg", ".DS_Store", "Thumbs.db", "a.csv", "readme", "jpg"]
    for name in wanted + others:
        (tmp_path / name).touch()
    (tmp_path / "folder.jpg").mkdir()
    (tmp_path / "dangling.jpg").symlink_to(tmp_path / "nothing.jpg")
    (tmp_path / "link.jpg").symlink_to(tmp_path / "B.JPG")
    assert [file.name for file in find_photos(tmp_path)] == sorted([*wanted, "link.jpg"])


def test_find_photos_in_a_missing_folder(tmp_path):
    with pytest.raises(FileNotFoundError):
        find_photos(tmp_path / "missing")


def test_what_looks_like_a_picture_and_is_not_taken_is_found(tmp_path):
    picture = tmp_path / "a.jpg"
    write_photo(picture, np.zeros((16, 16, 3), np.uint8))
    for name in ("bare", "a.jpg~", "b.jpg.bak"):
        (tmp_path / name).write_bytes(picture.read_bytes())
    (tmp_path / "gone.jpg").symlink_to(tmp_path / "nothing")
    (tmp_path / "words.txt").write_text("no picture")
    (tmp_path / "x.sqlite").write_bytes(picture.read_bytes())
    for name in ("folder", "folder.raw", "folder.psd"):
        (tmp_path / name).mkdir()
    os.mkfifo(tmp_path / "pipe")
    assert [one.name for one in find_unread(tmp_path)] == [
        "a.jpg~",
        "b.jpg.bak",
        "bare",
        "gone.jpg",
    ]
