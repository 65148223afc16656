"""Labelling: clicks of a robot, and what a person waits for."""

import shutil
import tempfile
from collections import defaultdict
from pathlib import Path
from time import perf_counter, sleep

import cv2
import numpy as np

from annotate.engine.live_wire import LiveWire
from benchmarks.table import markdown
from skyline_viz import Detector, Skyline, open_dataset, train
from skyline_viz.evaluation.metrics import column_errors
from skyline_viz.photo import PHOTO_SUFFIXES, PhotoError, photo_size, write_photo
from skyline_viz.sky_model import SkyModel
from testing.labelling import asked, hills, served

GOAL = 1.0  # A_err in pixels at which the robot stops
MOST = 100  # clicks after which it gives up


def clicks(web: Path, sky: SkyModel) -> str:
    """A robot clicks the worst column at the true row until A_err is at most 1 px, two folds.

    Args:
        web: Folder of the Web photographs.
        sky: A sky model that has not seen them.
    """
    data = [(item.photo(), item.truth()) for item in open_dataset(web) if item.truth_path]
    needed = {"A_err at most 1 px": [], "and no column off by more than 5 px": []}
    vertices = []
    for fold in range(2):
        bank = train([one for at, one in enumerate(data) if at % 2 != fold])
        detector = Detector(bank, sky=sky)
        for photo, truth in data[fold::2]:
            vertices.append(polyline_vertices(truth))
            for worst, counts in zip((np.inf, 5.0), needed.values(), strict=True):
                counts.append(robot(LiveWire(photo, detector), truth, worst))
    rows = [
        [name, np.mean(one), np.median(one), np.percentile(one, 90), f"{np.count_nonzero(one)}"]
        for name, one in needed.items()
    ]
    cells = [
        [name, f"{mean:.2f}", f"{mid:.0f}", f"{p90:.0f}", n] for name, mean, mid, p90, n in rows
    ]
    table = markdown(["clicks until", "mean", "median", "90th percentile", "photos > 0"], cells)
    return (
        f"## Clicks of a robot, on {len(data)} photographs of `{web.name}`, two folds\n\n"
        "It clicks the worst column of the current line at the true row.\n\n"
        f"{table}\n\nA polyline drawn by hand needs {np.median(vertices):.0f} vertices (median; "
        f"mean {np.mean(vertices):.0f}) to stay within 1 px of the truth.\n"
    )


def robot(wire: LiveWire, truth: Skyline, worst: float) -> int:
    """Number of clicks until the line is good."""
    for count in range(MOST):
        errors = column_errors(wire.skyline, truth)
        if np.nanmean(errors) <= GOAL and np.nanmax(errors) <= worst:
            return count
        column = int(np.nanargmax(errors))
        wire.anchor(column, min(round(float(truth.rows[column])), wire.height - 1))
    return MOST


def polyline_vertices(truth: Skyline) -> int:
    """Vertices that Douglas and Peucker keep within 1 px."""
    points = np.column_stack([np.arange(truth.width), truth.rows])[truth.visible]
    return len(cv2.approxPolyDP(points.astype(np.float32).reshape(-1, 1, 2), 1.0, closed=False))


def waiting(photos: dict[str, list[Path]]) -> str:
    """Previews, clicks and next photos through a real server on this machine."""
    rows = []
    for size, files in photos.items():
        with tempfile.TemporaryDirectory() as folder:
            for file in files:
                shutil.copy(file, folder)
            with served(Path(folder)) as client:
                for what, seconds in _used(client, len(files), size).items():
                    middle, late = np.percentile(np.array(seconds) * 1000, [50, 95])
                    rows.append([size, what, f"{middle:.1f}", f"{late:.1f}", str(len(seconds))])
    table = markdown(["photo", "what", "median ms", "95th percentile", "times"], rows)
    return f"## What a person waits for, through the server on this machine\n\n{table}\n"


def measured(web: Path | None, data: Path | None, sky: SkyModel) -> str:
    """Everything; the robot only where there are real photographs, which `sky` has not seen."""
    parts = [clicks(web, sky)] if web and web.is_dir() else []
    with tempfile.TemporaryDirectory() as scratch:
        parts.append(waiting(_photos(Path(scratch), data)))
    return "\n".join(parts).rstrip()


def _photos(folder: Path, source: Path | None) -> dict[str, list[Path]]:
    """Photos of 0.7 and 12 megapixels: real ones where there are any, else noise on hills."""
    found: dict[str, list[Path]] = {}
    for size, (height, width), count in (
        ("1388x519", (519, 1388), 8),
        ("4032x3024", (3024, 4032), 5),
    ):
        files = sorted(source.rglob("*")) if source else []
        real = [file for file in files if _size(file) == (height, width)]
        if len(real) < count:
            real = [folder / f"{size}-{seed}.png" for seed in range(count)]
            for seed, path in enumerate(real):
                write_photo(path, hills(seed, height, width))
        found[size] = real[:count]
    return found


def _size(path: Path) -> tuple[int, int] | None:
    if path.suffix.lower() not in PHOTO_SUFFIXES or "ground_truth" in path.parts:
        return None
    try:
        return photo_size(path)
    except PhotoError:
        return None


def _used(client, photos: int, size: str) -> dict[str, list[float]]:
    chance = np.random.default_rng(0)
    seconds: dict[str, list[float]] = defaultdict(list)

    def timed(what, method, path, **body):
        start = perf_counter()
        answer = client.request(method, path, **body)
        seconds[what].append(perf_counter() - start)
        answer.raise_for_status()
        return answer

    document = client.get("/api/photos/1").json()
    for _ in range(20):
        for _ in range(10):  # a hand on its way to the place of the click
            column = int(chance.integers(document["width"]))
            aim = document["rows"][column] + int(chance.integers(-60, 61))
            row = min(max(aim, 0), document["height"] - 1)
            timed("preview", "POST", "/api/photos/1/preview", json={"column": column, "row": row})
        operation = {"kind": "anchor", "column": column, "row": row}
        body = asked(document["revision"], operation=operation)
        where = "/api/photos/1/operations"
        document = timed("click to new line", "POST", where, json=body).json()
    for stage in client.get("/api/legend").json()["stages"]:
        where = f"/api/photos/1/stages/{stage}"
        tag = timed("a stage, first", "GET", where).headers["etag"]
        start = perf_counter()
        client.get(where, headers={"If-None-Match": tag})  # as a browser asks that has it
        seconds["a stage, again"].append(perf_counter() - start)
    for photo in range(1, photos + 1):
        timed("thumbnail, first", "GET", f"/api/photos/{photo}/thumbnail")
        timed("thumbnail, again", "GET", f"/api/photos/{photo}/thumbnail")
    for photo in range(2, photos + 1):
        sleep(1.0 if size == "1388x519" else 6.0)  # the person looks at the photo before it
        start = perf_counter()
        client.get(f"/api/photos/{photo}").raise_for_status()
        client.get(f"/api/photos/{photo}/image").raise_for_status()
        seconds["next photo"].append(perf_counter() - start)
    return seconds
