"""Recordings: time and size a photo, galleries of many photos, and the first picture."""

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import cv2

from benchmarks.table import markdown
from skyline_viz import Detector, log_detection, new_recording, open_dataset, write_photo
from skyline_viz.rendering import sample_scenes
from skyline_viz.running.warming import warm_up
from skyline_viz.viewer.contents import Fidelity

GALLERIES = (250, 1000)
"""Numbers of photos of the galleries whose memory is compared."""

_INSPECT = """
import sys
from pathlib import Path
from skyline_viz.cli import main
main(["inspect", sys.argv[1], "--save", sys.argv[2]])
print(Path("/proc/self/status").read_text().split("VmHWM:")[1].split()[0])
"""

_GALLERY = """
import resource, sys
from pathlib import Path
from skyline_viz import Detector
from skyline_viz.command_line.inputs import collect
from skyline_viz.gallery.store import Gallery
photos = collect([Path(sys.argv[1])])[:int(sys.argv[2])]
done = sum(1 for _ in Gallery(Path(sys.argv[3])).build(photos, Detector(), workers=1))
status = Path("/proc/self/status").read_text()
print(done, status.split("VmHWM:")[1].split()[0])
"""


def measured(web: Path | None, samples: Path) -> str:
    """All measurements; single photos on the real photographs where they are."""
    folder = web if web and web.is_dir() else samples
    with tempfile.TemporaryDirectory() as scratch:
        return "\n\n".join(
            [
                f"## Recordings, of the photographs of `{folder.name}`",
                _each(folder, Path(scratch)),
                _large(Path(scratch)),
                _many(Path(scratch)),
                _first_picture(samples, Path(scratch)),
            ]
        )


def _each(folder: Path, scratch: Path) -> str:
    warm_up()
    rows = []
    fidelities: tuple[Fidelity, ...] = ("lean", "full")
    for fidelity in fidelities:
        for _ in range(2):  # the first round fills caches
            ratios, milliseconds, megabytes = [], [], []
            for item in open_dataset(folder):
                detection, truth = Detector().detect(item.photo()), item.truth()
                file = scratch / f"{fidelity}.rrd"
                with new_recording(file, item.name) as recording:
                    start = time.perf_counter()
                    log_detection(recording, detection, truth, fidelity=fidelity)
                    recording.flush()
                    seconds = time.perf_counter() - start
                ratios.append(seconds / detection.total_seconds)
                milliseconds.append(1000 * seconds)
                megabytes.append(file.stat().st_size / 1e6)
        rows.append(
            [
                fidelity,
                f"{statistics.median(ratios):.2f}",
                f"{statistics.median(milliseconds):.0f}",
                f"{statistics.median(megabytes):.2f}",
                f"{max(megabytes):.2f}",
            ]
        )
    header = ["fidelity", "time / detection", "ms", "MB, median", "MB, largest"]
    return markdown(header, rows)


def _large(scratch: Path) -> str:
    """Bytes and peak memory of a whole process that records a photo of 12 megapixels in full."""
    scene = next(sample_scenes()).photo
    write_photo(scratch / "large.jpg", cv2.resize(scene, (4032, 3024)))
    file = scratch / "large.rrd"
    words = [sys.executable, "-c", _INSPECT, scratch / "large.jpg", file]
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=True)
    megabytes, kilobytes = file.stat().st_size / 1e6, int(done.stdout.split()[-1])
    return (
        f"`inspect --save` of 12 megapixels: {megabytes:.0f} MB, and {kilobytes / 1024:.0f} MB of "
        "memory at the most."
    )


def _many(scratch: Path) -> str:
    """Peak memory of galleries of different sizes, of a dozen scenes again and again."""
    photos = scratch / "many"
    scenes = list(sample_scenes())
    for number in range(max(GALLERIES)):
        photo = scenes[number % len(scenes)].photo.copy()
        photo[-1, -2:] = number // 256, number % 256, 0
        write_photo(photos / f"p{number:04d}.jpg", photo)
    rows = []
    for count in GALLERIES:
        start = time.perf_counter()
        words = [sys.executable, "-c", _GALLERY, photos, str(count), scratch / f"g{count}"]
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=True)
        took = time.perf_counter() - start
        finished, kilobytes = map(int, done.stdout.split())
        rows.append([str(finished), f"{kilobytes / 1024:.0f}", f"{1000 * took / count:.0f}"])
    return markdown(
        ["photos in the gallery, one process", "peak MB", "ms a photo, all in all"], rows
    )


def _first_picture(samples: Path, scratch: Path) -> str:
    """Whole processes, from nothing to a picture."""
    photo = next(iter(open_dataset(samples))).photo_path
    start = time.perf_counter()
    words = ["inspect", photo, "--save", scratch / "one.rrd"]
    _program(words)
    saved = time.perf_counter() - start
    start = time.perf_counter()
    _program(["gallery", samples, "--out", scratch / "g", "--screenshot", scratch / "g.png"])
    cards = time.perf_counter() - start
    return (
        f"`inspect --save` of a photo: {saved:.1f} s as a whole process; "
        f"`gallery --screenshot` of the samples, from nothing to the picture, without a screen or "
        f"a graphics card: {cards:.1f} s."
    )


def _program(words: list[object]) -> None:
    command = [sys.executable, "-m", "skyline_viz", *map(str, words)]
    subprocess.run(command, capture_output=True, check=True)
