"""Many photos into one table: what a cluster costs beside the pool, and what a kill costs.

    python -m benchmarks.scale [PHOTOS]

Makes links to a few rendered photos (10,000 unless given), detects them three times, and prints
the figures of docs/scale.md:

1. with ``--workers 2``, processor time of all processes;
2. with ``--cluster local:2``, the same, and the memory of the process that holds client and
   scheduler;
3. with ``--cluster local:2`` where a worker is killed and then the client, and the same command
   once more. Its table is to hold each photo once, with the lines of the first.
"""

from __future__ import annotations

import os
import sys
import tempfile
import tracemalloc
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from time import process_time

import cv2
import pyarrow.parquet as pq

from benchmarks.scale import labels
from benchmarks.scale.measuring import KINDS, SIZE, Cost, measured
from skyline_viz.arrays import U8
from skyline_viz.config import TrainingConfig
from skyline_viz.detector import Detector
from skyline_viz.photo import read_photo, write_photo
from skyline_viz.rendering import render
from skyline_viz.running.line_run import LineTask, find_line
from skyline_viz.running.line_store import store_of
from skyline_viz.running.line_table import write_lines
from skyline_viz.skyline import Skyline
from skyline_viz.storage.stored_photo import StoredPhoto
from skyline_viz.system.memory import keep_freed
from skyline_viz.training import gather

A_ROW = 4500  # bytes that a run keeps of a photo of this size


def write_links(folder: Path, photos: int) -> Path:
    """So many names of a few photos."""
    folder.mkdir()
    for number, kind in enumerate(KINDS):
        write_photo(folder.parent / f"{kind}.jpg", render(kind, number, *SIZE).photo)
    for number in range(photos):
        target = folder.parent / f"{KINDS[number % len(KINDS)]}.jpg"
        os.link(target, folder / f"photo-{number:06}.jpg")
    return folder


def command(folder: Path, out: Path, *more: str) -> list[str]:
    """The command line that is measured."""
    return [sys.executable, "-m", "skyline_viz", "detect", str(folder), "--out", str(out), *more]


def lines(table: Path) -> dict[str, tuple[object, ...]]:
    """Photo, and what was found in it, of each row; a photo that is in it twice ends the benchmark.

    Raises:
        SystemExit: A photo is in the table twice, or has failed.
    """
    names = ["photo", "sha256", "rows", "confidence", "error"]
    rows = pq.read_table(table, columns=names).to_pylist()
    twice = [photo for photo, count in Counter(row["photo"] for row in rows).items() if count > 1]
    failed = [row["photo"] for row in rows if row["error"]]
    if twice or failed:
        sys.exit(f"twice: {twice[:3]}, failed: {failed[:3]}")
    return {row["photo"]: (row["sha256"], row["rows"], row["confidence"]) for row in rows}


def main(photos: int = 10_000) -> None:
    """Measure, compare and print."""
    parts()
    with tempfile.TemporaryDirectory() as place:
        here = Path(place)
        folder = write_links(here / "photos", photos)
        pool_out, out, broken = (here / f"{one}.parquet" for one in ("pool", "cluster", "broken"))
        measured(command(here / "clear.jpg", here / "first.parquet"))  # compiles, once
        pool = measured(command(folder, pool_out, "--workers", "2"))
        _tell("--workers 2", pool, photos)
        whole = measured(command(folder, out, "--cluster", "local:2"))
        _tell("--cluster local:2", whole, photos)
        more = whole.processor / pool.processor - 1
        print(f"overhead of the cluster: {more:+.1%} of processor time a photo")
        early, late = (whole.memory[len(whole.memory) * part // 10] for part in (3, 9))
        print(
            f"client and scheduler: {early / 1e6:.0f} MB after 30 % of the time, {late / 1e6:.0f} "
            f"MB after 90 %, {max(whole.memory) / 1e6:.0f} MB at the most"
        )
        size = out.stat().st_size
        print(f"table: {size / 1e6:.1f} MB, {size / photos:.0f} bytes a photo of {SIZE[0]} columns")
        words = command(folder, broken, "--cluster", "local:2")
        store = store_of(broken).name

        def kept() -> int:
            return sum(one.stat().st_size for one in here.glob(f"{store}*"))

        all_of_it = photos * A_ROW
        killed = measured(words, kept, (0.3 * all_of_it, 0.6 * all_of_it))
        print(killed.said.strip())
        print(f"killed after {killed.seconds:.0f} s; {kept() / 1e6:.1f} MB are kept")
        again = measured(words)
        _tell("the same command again", again, photos)
        print(again.said.strip())
        found = lines(broken)
        same = found == lines(out) == lines(pool_out)
        print(f"photos in the table: {len(found)}, each once; the lines are the same: {same}")
        if len(found) != photos or not same:
            sys.exit("the tables differ")


def parts() -> None:
    """What does not depend on the machine's load: sizes, and what adding two sums takes."""
    config = TrainingConfig()
    gram = gather(*_scene(0), 0, config)
    began = process_time()
    for _ in range(10):
        gram + gram
    adding = (process_time() - began) / 10
    print(f"Gram matrices: {gram.sums.nbytes / 1e6:.1f} MB; adding two {1000 * adding:.0f} ms")
    tracemalloc.start()
    named = [
        StoredPhoto(f"s3://photos/2026/11/26/webcam-{at:09}.jpg", at, f'ETag "{at:032x}"')
        for at in range(100_000)
    ]
    print(f"the name of a photo: {tracemalloc.get_traced_memory()[0] / len(named):.0f} bytes")
    tracemalloc.stop()
    labels.main()
    cv2.setNumThreads(1)
    keep_freed()
    detector = Detector()
    with tempfile.TemporaryDirectory() as place:
        rows: list[bytes] = []
        for at in range(24):
            photo = Path(place, f"{at}.jpg")
            write_photo(photo, _scene(at)[0])
            rows.append(find_line(detector, LineTask(StoredPhoto(str(photo)))).row or b"")
        table = Path(place, "t.parquet")
        write_lines(table, rows, {})
        print(f"a row of {SIZE[0]} columns: {table.stat().st_size / len(rows):.0f} bytes")
        for size in (SIZE, (1600, 1200)):
            photo, scene = Path(place, "photo.jpg"), render("clear", 1, *size)
            write_photo(photo, scene.photo)
            task = LineTask(StoredPhoto(str(photo)))
            detecting = _best(lambda task=task: find_line(detector, task))
            gathering = _best(
                lambda file=photo, truth=scene.truth: gather(read_photo(file), truth, 0, config)
            )
            print(
                f"a photo of {size[0]} x {size[1]}: {detecting:.0f} ms of a processor to detect, "
                f"{gathering:.0f} ms to gather from"
            )


def _best(work: Callable[[], object]) -> float:
    """Milliseconds of a processor that work takes, the best of six."""
    each = []
    for _ in range(6):
        began = process_time()
        work()
        each.append(process_time() - began)
    return 1000 * min(each)


def _scene(number: int) -> tuple[U8, Skyline]:
    scene = render(KINDS[number % len(KINDS)], number, *SIZE)
    return scene.photo, scene.truth


def _tell(what: str, cost: Cost, photos: int) -> None:
    each = cost.processor / photos * 1000
    print(
        f"{what}: {cost.seconds:.0f} s, {photos / cost.seconds:.1f} photos a second, "
        f"{each:.1f} ms of a processor a photo",
        flush=True,
    )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
