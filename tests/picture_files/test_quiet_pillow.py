"""Pillow without its global limit and its warnings."""

import subprocess
import sys
import threading
import warnings

from PIL import Image

from skyline_viz.photo import PhotoError, read_photo
from testing import photo_files
from testing.pictures import NOISE, refusal, save


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


def test_libtiff_does_not_speak_on_the_screen(tmp_path):
    path = tmp_path / "a.tif"
    Image.fromarray(photo_files.scene()[0]).save(path, compression="tiff_lzw")
    data = bytearray(path.read_bytes())
    data[200:2000] = bytes(1800)
    path.write_bytes(data)
    code = (
        f"from skyline_viz.photo import *\ntry: read_photo({str(path)!r})\nexcept PhotoError: pass"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
    assert (done.stdout, done.stderr) == (b"", b"")
