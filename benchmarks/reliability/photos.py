"""Photographs in every file that people have of them, damaged ones, and names."""

import contextlib
import io
import os
import resource
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

import skyline_viz as sv
from benchmarks.reliability import Trial
from skyline_viz.cli import main
from skyline_viz.photo import photo_size
from skyline_viz.system.names import printable
from testing import photo_files

MUTATIONS = 4000
_ALPHABET = "ab .-_#?%&'\"<>[]*$`;\n\r\t\x1b\x07\\\u202e\u200b\u0308üé富山한⛰\U0001f3d4"


def measured() -> list[Trial]:
    """Try all of it."""
    with tempfile.TemporaryDirectory() as folder:
        return [
            _formats(Path(folder)),
            _refusals(Path(folder)),
            _mutations(Path(folder)),
            _names(Path(folder)),
        ]


def _formats(folder: Path) -> Trial:
    """Every file of the same photo against the line of the photo itself."""
    detector = sv.Detector()
    tried, wrong = 0, []
    for height, width in ((160, 240), (300, 420), (400, 640)):
        photo, rows = photo_files.scene(height, width)
        base = np.abs(detector.detect(photo).skyline.rows - rows).mean()
        for name, make in photo_files.READ.items():
            path = folder / name
            make(path, photo)
            read = sv.read_photo(path)
            found = np.abs(detector.detect(read).skyline.rows - rows).mean()
            tried += 1
            if photo_size(path) != read.shape[:2] or found > base + 1:
                wrong.append(name)
    return Trial(
        "the same photo in another file",
        f"{len(photo_files.READ)} formats, depths, encodings and small damages, in three sizes; "
        "line within 1 px of that of the photo, size as said beforehand",
        tried,
        _lost(wrong, "misread"),
    )


def _refusals(folder: Path) -> Trial:
    """Files whose photo is not there, or has no defined white."""
    photo, _ = photo_files.scene()
    wrong = []
    for name, (make, reason) in photo_files.REFUSED.items():
        make(folder / name, photo)
        try:
            sv.read_photo(folder / name)
            wrong.append(name)
        except sv.PhotoError as error:
            if reason not in str(error):
                wrong.append(name)
    return Trial(
        "a file that cannot be read rightly",
        "raw files by name and by content, floating-point numbers, cut JPEGs, JPEG XL, ...",
        len(photo_files.REFUSED),
        _lost(wrong, "read, or refused for another reason"),
    )


def _mutations(folder: Path) -> Trial:
    """Damaged bytes; sentences only."""
    random = np.random.default_rng(5)
    photo, _ = photo_files.scene(48, 64)
    originals = {}
    for name, make in photo_files.READ.items():
        make(folder / name, photo)
        originals[name] = (folder / name).read_bytes()
    names = sorted(originals)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    wrong = []
    for number in range(MUTATIONS):
        name = names[number % len(names)]
        data = bytearray(originals[name])
        for _ in range(random.integers(1, 12)):
            data[int(random.random() ** 3 * len(data))] = random.integers(256)
        keep = len(data) if random.random() < 0.7 else random.integers(1, len(data))
        path = folder / name
        path.write_bytes(data[:keep])
        wrong += [name for read in (photo_size, sv.read_photo) if not _sound(read, path)]
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    return Trial(
        "a damaged photo",
        "1 to 11 bytes changed, most in the header, a third cut off; a photo or one sentence, "
        f"nothing on the screen; memory grew by {grown:.0f} MB",
        MUTATIONS,
        _lost(wrong, "ended otherwise"),
    )


def _sound(read: Callable[[Path], object], path: Path) -> bool:
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
            read(path)
    except sv.PhotoError as error:
        text = str(error)
        return text.startswith(str(path)) and "\n" not in text and not said.getvalue()
    except Exception:
        return False
    return not said.getvalue()


def _names(folder: Path) -> Trial:
    """Random names through commands."""
    random = np.random.default_rng(7)
    photo, rows = photo_files.scene(64, 96)
    mask = (np.arange(len(photo))[:, None] >= rows).astype(np.uint8) * np.uint8(255)
    there = folder / "names"
    for part in ("images", "masks"):
        (there / part).mkdir(parents=True)
    wanted = set()
    while len(wanted) < 300:
        letters = "".join(random.choice(list(_ALPHABET), random.integers(1, 40)))
        name = letters if random.random() < 0.8 else letters + os.fsdecode(b"\xfc\xff")
        if not name.startswith(".") and name.casefold() not in {one.casefold() for one in wanted}:
            wanted.add(name)
    for name in wanted:
        Image.fromarray(photo).save(there / "images" / f"{name}.png")
        Image.fromarray(mask).save(there / "masks" / f"{name}.png")
    cards = ["--screenshot", str(folder / "cards.png")]
    commands = [
        ["detect", str(there), "--out", str(folder / "lines"), "--workers", "1"],
        ["evaluate", str(there), "--out", str(folder / "figures"), "--workers", "1"],
        ["train", str(there), "--out", str(folder / "bank.npz"), "--workers", "1"],
        ["diagnose", str(there), "--no-remedies", "--workers", "1"],
        ["gallery", str(there), "--out", str(folder / "g"), "--workers", "1", *cards],
    ]
    wrong = []
    for command in commands:
        said = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            status = main(command)
        said.flush()
        lines = said.buffer.getvalue().decode().split("\n")
        if status or any(printable(line) != line for line in lines):
            wrong.append(command[0])
    lines_there = len(list((folder / "lines").glob("*.csv"))) - 1  # without the table of the run
    if lines_there != len(wanted):
        wrong.append(f"{len(wanted) - lines_there} skylines")
    return Trial(
        "an odd name",
        "escapes, line ends, quotes, markup, signs of addresses, right-to-left marks, Chinese, "
        "Korean, emoji and bytes that are no text, through detect, evaluate, train, diagnose and "
        "the cards of gallery in the real viewer",
        len(wanted) * len(commands),
        _lost(wrong, "failed, or printed what a terminal obeys"),
    )


def _lost(wrong: list[str], how: str) -> str:
    return f"{len(wrong)} {how}: {', '.join(sorted(set(wrong)))}" if wrong else "nothing"
