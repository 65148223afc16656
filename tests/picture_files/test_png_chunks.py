"""The chunks of a PNG: what its pixels need is kept, and the rest passed over."""

import io

import numpy as np
import pytest
from PIL import Image

from skyline_viz.picture_files.png_chunks import clean_png, png_chunks
from testing.photo_files import chunk

PIXELS = np.random.default_rng(0).integers(0, 256, (9, 13, 3), np.uint8)


def png(*chunks, **options):
    """A PNG with chunks behind its header."""
    file = io.BytesIO()
    Image.fromarray(PIXELS).save(file, format="PNG", **options)
    data = file.getvalue()
    return io.BytesIO(data[:33] + b"".join(chunks) + data[33:])


def test_it_says_its_size_depth_and_colours():
    found = png_chunks(png())
    assert (found.size, found.depth, found.colour) == ((13, 9), 8, 2)
    assert found.notes == ()
    assert found.exif is None
    assert found.gamma is None
    assert found.significant_bits is None


def test_what_it_says_of_its_samples_is_read():
    found = png_chunks(png(chunk(b"gAMA", (45455).to_bytes(4)), chunk(b"sBIT", bytes([5, 6, 5]))))
    assert found.gamma == pytest.approx(0.45455)
    assert found.significant_bits == 6
    with_profile = png(chunk(b"gAMA", (100_000).to_bytes(4)), chunk(b"sRGB", b"\0"))
    assert png_chunks(with_profile).gamma is None  # a profile says more


def test_a_damaged_chunk_is_noted_and_passed_over():
    file = png(chunk(b"gAMA", (45455).to_bytes(4), checksum=0), chunk(b"tEXt", b"a\0b"))
    found = png_chunks(file)
    assert found.gamma is None
    assert found.notes == ("has a damaged gAMA chunk, which was passed over",)
    assert b"tEXt" not in [kind for kind, _, _ in found.pixels]


def test_the_clean_file_has_the_same_pixels_and_no_text():
    file = png(chunk(b"tEXt", b"comment\0" + b"x" * 5000))
    clean = clean_png(file, png_chunks(file))
    assert b"comment" not in clean.getvalue()
    np.testing.assert_array_equal(np.asarray(Image.open(clean)), PIXELS)


def test_a_missing_end_is_noted_and_a_missing_header_is_an_error():
    data = png().getvalue()
    cut = io.BytesIO(data[:-12])
    found = png_chunks(cut)
    assert "without its end marker" in found.notes[0]
    np.testing.assert_array_equal(np.asarray(Image.open(clean_png(cut, found))), PIXELS)
    with pytest.raises(ValueError, match="no header"):
        png_chunks(io.BytesIO(data[:8]))
