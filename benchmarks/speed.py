"""Time and memory: ratios to ``cv2.Canny`` in one process, growth with size, whole processes."""

import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import cv2
import numpy as np

from benchmarks import around, one_thread
from benchmarks.table import markdown
from skyline_viz import Detector, open_dataset, read_photo, train, write_photo
from skyline_viz.arrays import U8
from skyline_viz.networks.onnx_files import Network
from skyline_viz.photo import find_photos
from skyline_viz.sky_model import SHIPPED, SkyModel

REPEATS = 7

_PEAK = """
import sys
from pathlib import Path
from skyline_viz import Detector, read_photo
photo = read_photo(sys.argv[1])
Detector().detect(photo)
status = Path("/proc/self/status").read_text()  # not getrusage: that inherits the parent's peak
print(status.split("VmHWM:")[1].split()[0])
"""


def measured(web: Path | None, samples: Path) -> str:
    """All measurements; on the real photographs where they are, else on the rendered samples."""
    folder = web if web and web.is_dir() else samples
    items = list(open_dataset(folder))
    photos = [item.photo() for item in items]
    parts = [f"## Speed, on {len(photos)} photographs of `{folder.name}`", _ratios(photos)]
    large = find_photos(web.parent / "new_dataset") if web and web.is_dir() else []
    pictures = [read_photo(path) for path in large]
    parts.append(one_thread.measured(photos, pictures))
    parts.append(_sky(photos))
    parts.append(around.measured(folder))
    parts.append(_growth(photos, pictures))
    with tempfile.TemporaryDirectory() as scratch:
        one = Path(scratch) / "photo.bmp"
        write_photo(one, photos[0])
        parts.append(_whole_process(one, Path(scratch) / "out"))
        twelve = large[0] if large else Path(scratch) / "large.bmp"
        if not large:
            write_photo(twelve, cv2.resize(photos[0], (4032, 3024), interpolation=cv2.INTER_CUBIC))
        parts.append(_peak_memory(twelve))
    if web and web.is_dir():
        examples = [(item.photo(), item.truth()) for item in items]
        seconds = _best(lambda: train(examples), 2)
        parts.append(f"Training on {len(examples)} photographs, one process: {seconds:.1f} s.")
    return "\n\n".join(parts)


def _best(action: Callable[[], object], repeats: int = REPEATS) -> float:
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return min(times)


def _ratios(photos: list[U8]) -> str:
    detector = Detector()
    detector.detect(photos[0])
    ratios, stages, edges = [], [], []
    for photo in photos:
        grey = cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY)
        canny = _best(lambda image=grey: cv2.Canny(image, 50, 220))
        ratios.append(_best(lambda image=photo: detector.detect(image)) / canny)
        detection = detector.detect(photo)
        stages.append({name: value / canny for name, value in detection.seconds.items()})
        edges.append(len(detection.edge_rows))
    medians = {name: statistics.median(one[name] for one in stages) for name in stages[0]}
    table = markdown(
        ["", "whole detection", *medians],
        [["multiple of Canny", f"**{statistics.median(ratios):.1f}**"]
         + [f"{value:.1f}" for value in medians.values()]],
    )  # fmt: skip
    return (
        "A detection against `cv2.Canny` on the same photo in grey, same process, fastest of "
        f"{REPEATS} each, median over the photos (range {min(ratios):.1f} to {max(ratios):.1f}; "
        f"median {statistics.median(edges):,.0f} edge pixels):\n\n{table}"
    )


def _sky(photos: list[U8]) -> str:
    """The sky models alone, from the photo to the map, and their networks without all else."""
    rows = []
    for name in SHIPPED:
        model = SkyModel.named(name)
        network = Network(model.network, name, classic=True)
        blob = np.zeros(network.header.inputs[0].shape, np.float32)
        whole, alone = [], []
        for photo in photos:
            grey = cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY)
            canny = _best(lambda image=grey: cv2.Canny(image, 50, 220))
            whole.append(_best(partial(model.sky, photo)) / canny)
            alone.append(_best(partial(network.run, blob)) / canny)
        cells = [f"{statistics.median(one):.2f}" for one in (whole, alone)]
        rows.append([name, *cells, f"{len(model.network) / 1e3:.0f} kB"])
    table = markdown(["multiple of Canny", "photo to map", "network alone", "file"], rows)
    return f"The sky models, as multiples of the same `cv2.Canny`:\n\n{table}"


def _growth(photos: list[U8], large: list[U8]) -> str:
    detector = Detector()
    if not large:
        large = [cv2.resize(photos[0], (4032, 3024), interpolation=cv2.INTER_CUBIC)]
    by_size: dict[str, list[float]] = {}
    for photo in large:
        factor = (photos[0][..., 0].size / photo[..., 0].size) ** 0.5
        small = cv2.resize(photo, None, fx=factor, fy=factor, interpolation=cv2.INTER_AREA)
        seconds = [
            _best(lambda image=image: detector.detect(image), 3) / image[..., 0].size
            for image in (photo, small)
        ]
        size = f"{photo.shape[1]}x{photo.shape[0]}"
        by_size.setdefault(size, []).append(seconds[0] / seconds[1])
    rows = [
        [size, str(len(found)), f"{statistics.median(found):.2f}"]
        for size, found in sorted(by_size.items())
    ]
    table = markdown(["size", "photographs", "time a pixel"], rows)
    return f"Time a pixel, relative to the same photograph reduced to 0.7 megapixels:\n\n{table}"


def _whole_process(photo: Path, out: Path) -> str:
    """Wall time; processor time stands in `benchmarks.around`."""
    detect = ["detect", str(photo), "--out", str(out)]
    _run(detect)  # compiles, where this is the first run
    seconds = [
        statistics.median(_best(lambda words=words: _run(words), 1) for _ in range(5))
        for words in (detect, ["--help"])
    ]
    return (
        f"Whole processes, median of 5: `skyline-viz detect` on one photo {seconds[0]:.2f} s, "
        f"`skyline-viz --help` {seconds[1]:.2f} s."
    )


def _run(words: list[str]) -> None:
    command = [sys.executable, "-m", "skyline_viz", *words]
    subprocess.run(command, check=True, capture_output=True)


def _peak_memory(photo: Path) -> str:
    if not Path("/proc/self/status").exists():
        return "Peak memory: **not run**, it is read from Linux's /proc."
    done = subprocess.run(
        [sys.executable, "-c", _PEAK, str(photo)],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    height, width = read_photo(photo).shape[:2]
    return (
        f"Peak memory of a process that reads and detects one photo of {width}x{height}: "
        f"{int(done.stdout) * 1024 / 1e6:.0f} MB."
    )
