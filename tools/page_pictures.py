"""Draw the pictures of the labelling page for the docs: python -m tools.page_pictures FOLDER."""

import shutil
import sys
import tempfile
from pathlib import Path

from PIL import Image

from skyline_viz.datasets.truths import read_truth
from testing.labelling import served
from testing.programs.browser import Page, chromium

SAMPLES = Path(__file__).parents[1] / "sample_data" / "images"


def main(out):
    """Take pictures of the page as it is used, in both sizes and both themes."""
    with tempfile.TemporaryDirectory() as place, chromium() as browser:
        folder = Path(place) / "alps"
        folder.mkdir()
        for photo in SAMPLES.glob("*.jpg"):
            shutil.copy(photo, folder)
        for width, height in ((1440, 900), (1024, 768)):
            for scheme in ("light", "dark"):
                with served(folder, annotator=f"{scheme}-{width}") as client:
                    viewport = {"width": width, "height": height}
                    page = Page(browser, client, viewport=viewport, color_scheme=scheme)
                    use(page, out, f"{width}-{scheme}")
                    page.close()


def use(page, out, name):
    """Accept two photos, correct a third where the line is worst, and look at the sheet."""
    page.keys("Space")
    page.shows("clear-3")
    page.keys("Space")
    page.shows("cloudy-4")
    page.page.locator(".item", has_text="spires-5").click()
    page.shows("spires-5")
    chosen = page.page.locator("[aria-selected=true]", has_text="spires-5")
    photo = int(chosen.get_attribute("data-photo"))
    truth = read_truth(SAMPLES.parent / "masks" / "spires-5.png").rows
    for last in (False, True):
        column = int(abs(page.document(photo)["rows"] - truth).argmax())
        if last:
            page.page.mouse.move(*page.at(column, int(truth[column])))
        else:
            page.click(column, int(truth[column]))
    page.page.wait_for_timeout(1200)
    picture(page, out / f"label-{name}.jpg")
    if name == "1440-light":
        page.keys("w")
        page.page.locator(".card img[src]").last.wait_for()
        page.page.wait_for_timeout(2500)
        picture(page, out / "label-sheet.jpg")


def picture(page, path):
    """Write what is seen."""
    raw = path.with_suffix(".png")
    page.page.screenshot(path=raw)
    Image.open(raw).convert("RGB").save(path, quality=88)
    raw.unlink()
    print(path)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
