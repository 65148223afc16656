"""Draw the picture of a report for the docs: python -m tools.report_picture FOLDER."""

import io
import shutil
import sys
import tempfile
from pathlib import Path

from PIL import Image

from skyline_viz.cli import main as command
from testing import SAMPLES
from testing.programs.browser import chromium

NAMES = ("cloudy-4", "cloudy-5", "hazy-1", "snow-5")
"""Samples that are shown."""


def main(folder):
    """Report on samples as they are found without the sky model, and open the worst."""
    with tempfile.TemporaryDirectory() as place, chromium() as browser:
        file, photos = Path(place) / "report.html", Path(place) / "samples"
        for name in NAMES:
            for kind in ("images", "masks"):
                (photos / kind).mkdir(parents=True, exist_ok=True)
                for source in (SAMPLES / kind).glob(f"{name}.*"):
                    shutil.copy(source, photos / kind)
        command(["diagnose", str(photos), "--config.sky-weight", "0", "--report", str(file)])
        page = browser.new_page(viewport={"width": 1440, "height": 1080}, color_scheme="light")
        page.goto(file.as_uri())
        page.locator(".inside > summary").first.click()
        page.locator("#controls").evaluate("one => one.scrollIntoView()")
        picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    picture.save(folder / "report.jpg", quality=85)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
