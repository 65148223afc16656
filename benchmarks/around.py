"""What surrounds a detection: reading, writing, and whole commands, in processor time."""

import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import cv2

from benchmarks.table import markdown
from benchmarks.turns import fastest
from skyline_viz import Detector, open_dataset, read_photo, write_photo
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.running.warming import warm_up
from skyline_viz.system.memory import keep_freed

REPEATS = 5

_COMMANDS = {
    "detect": "main(['detect', folder, '--out', out, '--workers', '1'])",
    "evaluate": "main(['evaluate', folder, '--workers', '1'])",
    "diagnose": "main(['diagnose', folder, '--workers', '1'])",
    "gallery": "build(Path(out), collect([Path(folder)]), Detector(), 1)",  # without its viewer
}
_PROGRAM = """
import sys
from pathlib import Path
from skyline_viz import Detector
from skyline_viz.cli import main
from skyline_viz.command_line.inputs import collect
from skyline_viz.commands.gallery import build
from skyline_viz.system.memory import keep_freed
keep_freed()
folder, out = sys.argv[1:]
Path(out).mkdir()
"""


def measured(folder: Path) -> str:
    """Reading and writing against detecting, and what commands take a photo and in all."""
    items = [item for item in open_dataset(folder) if item.truth_path]
    return "\n\n".join([_against_detecting(items), _one_photo(items[0]), _commands(items, folder)])


def _against_detecting(items: Sequence[DatasetItem]) -> str:
    keep_freed()  # as our programs do
    cv2.setNumThreads(1)
    warm_up()
    detector = Detector()
    ratios: dict[str, list[float]] = {}
    with tempfile.TemporaryDirectory() as scratch:
        jpeg, csv = Path(scratch, "photo.jpg"), Path(scratch, "line.csv")
        for item in items:
            photo = item.photo()
            line = detector.detect(photo).skyline
            write_photo(jpeg, photo, quality=92)
            found = fastest(
                {
                    "detecting": lambda photo=photo: detector.detect(photo),
                    "reading the truth": item.truth,
                    "reading the photo as JPEG": lambda: read_photo(jpeg),
                    "writing the CSV": lambda line=line: line.write_csv(csv),
                }
            )
            for name, seconds in found.items():
                ratios.setdefault(name, []).append(seconds / found["detecting"])
    del ratios["detecting"]
    rows = [
        [name, f"{statistics.median(found):.2f}", f"{max(found):.2f}"]
        for name, found in ratios.items()
    ]
    table = markdown(["as a part of detecting", "median", "largest"], rows)
    return f"What surrounds a detection, processor time of one thread, in turn:\n\n{table}"


def _one_photo(item: DatasetItem) -> str:
    with tempfile.TemporaryDirectory() as scratch:
        words = ["-m", "skyline_viz", "detect", str(item.photo_path), "--out", scratch]
        _processor_seconds(words)  # compiles, where this is the first run
        runs = [
            (_processor_seconds(words), _processor_seconds(["-c", "import numpy, cv2"]))
            for _ in range(REPEATS)
        ]
    ours, imports = (statistics.median(one) for one in zip(*runs, strict=True))
    return (
        f"`skyline-viz detect` of one photo, as a process: {ours:.2f} s of processor time, "
        f"{ours / imports:.1f} times that of importing numpy and OpenCV."
    )


def _commands(items: Sequence[DatasetItem], folder: Path) -> str:
    """What a photo more takes: the difference between all photos and a quarter of them."""
    few = max(len(items) // 4, 1)
    with tempfile.TemporaryDirectory() as scratch:
        parts = [
            _copied(part, folder, Path(scratch, name))
            for name, part in (("few", items[:few]), ("all", items))
        ]
        cells = []
        for number, command in enumerate(_COMMANDS.values()):
            seconds = [
                _processor_seconds(["-c", _PROGRAM + command, str(part), f"{part}-{number}"])
                for part in parts
            ]
            cells.append(f"{1e3 * (seconds[1] - seconds[0]) / (len(items) - few):.0f} ms")
    table = markdown(["a photo more", *_COMMANDS], [["processor time", *cells]])
    return f"Whole commands, one worker, from {few} to {len(items)} photos:\n\n{table}"


def _copied(items: Sequence[DatasetItem], folder: Path, to: Path) -> Path:
    """A data set of some photos."""
    for item in items:
        for file in (item.photo_path, item.truth_path):
            if file is not None:
                copy = to / file.relative_to(folder)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, copy)
    return to


def _processor_seconds(words: list[str]) -> float:
    """Processor time of a Python process and of those that it starts, which may keep bytecode."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *words], check=True, capture_output=True, env=kept)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
