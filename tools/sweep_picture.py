"""Draw the picture of the tab Sweep for the docs: python -m tools.sweep_picture FILE.jpg."""

import sys
import tempfile
from pathlib import Path

from skyline_viz.cli import main as skyline_viz
from skyline_viz.viewer import headless_viewer, settled_picture, show_tab

SAMPLES = Path(__file__).parents[1] / "sample_data"
BAR = 37  # rows of the window's own bar


def main(file):
    """Drag the Canny thresholds of a hazy sample to where its far ridge is found."""
    photo, truth = SAMPLES / "images" / "hazy-1.jpg", SAMPLES / "masks" / "hazy-1.png"
    with tempfile.TemporaryDirectory() as place:
        recording = Path(place) / "hazy.rrd"
        words = ["inspect", photo, "--truth", truth, "--sweep", "--save", recording]
        skyline_viz(list(map(str, words)))
        with headless_viewer([recording]) as viewer:
            show_tab(viewer, "Sweep")
            viewer.set_time("canny_thresholds", sequence=40, play_state="paused")
            picture = settled_picture(viewer)
    picture.crop((0, BAR, *picture.size)).save(file, quality=88)


if __name__ == "__main__":
    main(sys.argv[1])
