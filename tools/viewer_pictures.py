"""Draw the pictures of single tabs for the docs: python -m tools.viewer_pictures FOLDER."""

import sys
import tempfile
from pathlib import Path

from skyline_viz.cli import main as skyline_viz
from skyline_viz.viewer.program.process import headless_viewer, settled_picture, show_tab

SAMPLES = Path(__file__).parents[1] / "sample_data"
BAR = 37  # rows of the window's own bar


def main(folder):
    """Draw the tabs Sweep, of a hazy sample, and Methods, of a clear one."""
    # the Canny thresholds dragged to where the far ridge is found
    draw("hazy-1", ["--sweep"], "Sweep", ("canny_thresholds", 40), folder / "inspect-sweep.jpg")
    methods = ["--method", "default", "paper", "edges", "gradient"]
    draw("clear-2", methods, "Methods", None, folder / "inspect-methods.jpg")


def draw(sample, options, tab, at, file):
    """Draw one tab of a sample, at a place of a timeline."""
    photo, truth = SAMPLES / "images" / f"{sample}.jpg", SAMPLES / "masks" / f"{sample}.png"
    with tempfile.TemporaryDirectory() as place:
        recording = Path(place) / "sample.rrd"
        words = ["inspect", photo, "--truth", truth, *options, "--save", recording]
        skyline_viz(list(map(str, words)))
        with headless_viewer([recording]) as viewer:
            show_tab(viewer, tab)
            if at:
                viewer.set_time(at[0], sequence=at[1], play_state="paused")
            picture = settled_picture(viewer)
    picture.crop((0, BAR, *picture.size)).save(file, quality=88)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
