"""A sky model from many photos: memory, disk and time.

    python -m benchmarks.scale.sky [PHOTOS]

Makes links to a few rendered photos with their truth (2,000 unless given), and learns from them as
``train --learn-sky small`` does, in as few steps as see each of them. Prints the figures of
docs/scale.md:

1. what one example takes: bytes, time to make it, to keep it and to read it, and to draw it;
2. with ``--workers 2``, from an eighth of the photos and from all of them, the memory of the first
   process;
3. with ``--cluster local:2``, the same, and whether the model is the same file.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from time import process_time

import cv2
import numpy as np

from benchmarks.scale.measuring import KINDS, SIZE, Cost, measured
from skyline_viz.datasets.layouts import DatasetItem
from skyline_viz.photo import write_photo
from skyline_viz.rendering import render
from skyline_viz.sky_training import example_file
from skyline_viz.sky_training.choosing import most_photos
from skyline_viz.sky_training.example_file import RECORD, ExampleFile
from skyline_viz.sky_training.examples import example_of
from skyline_viz.sky_training.fitting import drawn, shares
from skyline_viz.sky_training.sizes import BATCH, STEPS
from skyline_viz.storage.copies import CACHE
from skyline_viz.system.memory import keep_freed


def write_links(folder: Path, photos: int) -> Path:
    """A data set of so many names of a few photos, with their truth."""
    for kind in ("images", "masks"):
        (folder / kind).mkdir(parents=True)
    for number, kind in enumerate(KINDS):
        scene = render(kind, number, *SIZE)
        write_photo(folder.parent / f"{kind}.jpg", scene.photo)
        scene.truth.write_csv(folder.parent / f"{kind}.csv")
    for number in range(photos):
        kind, name = KINDS[number % len(KINDS)], f"photo-{number:06}"
        os.link(folder.parent / f"{kind}.jpg", folder / "images" / f"{name}.jpg")
        os.link(folder.parent / f"{kind}.csv", folder / "masks" / f"{name}.csv")
    return folder


def main(photos: int = 2_000) -> None:
    """Measure, compare and print."""
    parts()
    steps = -(-photos // BATCH)
    with tempfile.TemporaryDirectory() as place:
        here = Path(place)
        os.environ[CACHE] = str(here / "cache")
        few, many = (write_links(here / str(n) / "set", n) for n in (photos // 8, photos))
        runs = {
            "few": _learn(few, here / "few.onnx", steps, "--workers", "2"),
            "pool": _learn(many, here / "pool.onnx", steps, "--workers", "2"),
            "cluster": _learn(many, here / "cluster.onnx", steps, "--cluster", "local:2"),
        }
        for name, cost in runs.items():
            print(
                f"{name}: {cost.seconds:.0f} s, {cost.processor:.0f} s of a processor, "
                f"{max(cost.memory) / 1e6:.0f} MB at the most",
                flush=True,
            )
        more = (runs["cluster"].processor - runs["pool"].processor) / photos
        print(f"a cluster takes {1000 * more:.1f} ms of a processor more a photo")
        growth = max(runs["pool"].memory) - max(runs["few"].memory)
        held = (photos - photos // 8) * RECORD
        print(f"memory grew by {growth / 1e6:.0f} MB, the examples by {held / 1e6:.0f} MB")
        same = (here / "pool.onnx").read_bytes() == (here / "cluster.onnx").read_bytes()
        print(f"the model of the cluster is the same file: {same}")
        if not same:
            sys.exit("the models differ")


def _learn(folder: Path, out: Path, steps: int, *more: str) -> Cost:
    words = ["train", str(folder), "--out", str(out), "--learn-sky", "small"]
    found = measured([sys.executable, "-m", "skyline_viz", *words, "--steps", str(steps), *more])
    if not out.exists():
        sys.exit(found.said)
    return found


def parts() -> None:
    """What one example takes, and to draw among as many as there are at the most."""
    cv2.setNumThreads(1)
    keep_freed()
    print(f"an example: {RECORD:,} bytes")
    most, rng = most_photos(STEPS), np.random.default_rng(0)
    share = shares(["hills"] * most, {})
    upto = share.cumsum()
    adding = _each(lambda: rng.choice(most, BATCH, p=share), 50)
    searching = _each(lambda: drawn(upto, BATCH, rng), 1000)
    print(
        f"drawing {BATCH} of {most:,}: {1e6 * searching:.0f} us, and {1e6 * adding:.0f} us where "
        f"the shares are added up each time"
    )
    example_file.IN_MEMORY = 0
    with tempfile.TemporaryDirectory() as place:
        os.environ[CACHE] = place
        for size in (SIZE, (1600, 1200)):
            item = _scene(Path(place), *size)
            making = _each(lambda one=item: example_of(one, "hills"), 10)
            print(f"an example of {size[0]} x {size[1]}: {1000 * making:.1f} ms of a processor")
        one = example_of(item, "hills")
        with closing(ExampleFile(1000)) as file:
            if one is not None:
                print(f"to keep it: {1000 * _each(lambda: file.append(one), 200):.2f} ms")
            places = rng.integers(0, len(file), 1000).tolist()
            reading = _each(lambda: file[places.pop()], 1000)
            print(f"to read it, which the system has in memory: {1000 * reading:.2f} ms")


def _scene(folder: Path, width: int, height: int) -> DatasetItem:
    scene = render("clear", 1, width, height)
    photo, truth = (folder / f"{width}.{suffix}" for suffix in ("jpg", "csv"))
    write_photo(photo, scene.photo)
    scene.truth.write_csv(truth)
    return DatasetItem(str(width), photo, truth)


def _each(action: Callable[[], object], times: int) -> float:
    """Seconds of a processor that an action takes."""
    began = process_time()
    for _ in range(times):
        action()
    return (process_time() - began) / times


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
