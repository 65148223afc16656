"""Draw the picture of the page for flags for the docs: python -m tools.flag_picture FOLDER."""

import io
import sys
import tempfile
from pathlib import Path

from PIL import Image

from skyline_viz.command_line.inputs import collect
from skyline_viz.commands.gallery import build
from skyline_viz.detector import Detector
from skyline_viz.gallery.flag_page import flag_page
from skyline_viz.gallery.flags import Change, change_flags
from skyline_viz.gallery.store import Gallery
from testing import SAMPLES
from testing.programs.browser import chromium

SAID = {
    "hazy-2": Change(True, "the far ridge is hardly to be seen"),
    "foreground-3": Change(True, "a dip in the snow is bridged, cloud behind it"),
    "spires-5": Change(comment="towers cut off; ask for a larger delta"),
}


def main(folder):
    """Review some samples, and draw the page."""
    with tempfile.TemporaryDirectory() as place, chromium() as browser:
        gallery = Gallery(Path(place) / "samples")
        entries, _ = build(gallery.folder, collect([SAMPLES]), Detector(), workers=1)
        change_flags(gallery.folder, SAID)
        with flag_page(gallery, entries) as address:
            page = browser.new_page(viewport={"width": 1280, "height": 760}, color_scheme="dark")
            page.goto(address)
            page.locator("#saving[data-state=saved]").wait_for()
            page.evaluate("document.getElementById('folder').textContent = 'Flags of samples'")
            page.wait_for_load_state("networkidle")
            picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    picture.save(folder / "gallery-flags.jpg", quality=88)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
