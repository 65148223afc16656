"""Draw the picture of a report for the docs: python -m tools.report_picture FOLDER."""

import io
import sys
import tempfile
from pathlib import Path

from PIL import Image

from skyline_viz.cli import main as command
from testing import SAMPLES
from testing.programs.browser import chromium


def main(folder):
    """Report on the samples as they are found without the sky model, and open the worst."""
    with tempfile.TemporaryDirectory() as place, chromium() as browser:
        file = Path(place) / "report.html"
        command(["diagnose", str(SAMPLES), "--config.sky-weight", "0", "--report", str(file)])
        page = browser.new_page(viewport={"width": 1440, "height": 900}, color_scheme="light")
        page.goto(file.as_uri())
        page.locator(".inside > summary").first.click()
        page.locator("article").first.evaluate("one => one.scrollIntoView()")
        page.evaluate("document.getElementById('controls').style.position = 'static'")
        picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    picture.save(folder / "report.jpg", quality=85)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
