"""Which files of a folder are photos and which are truths, and which belong together.

The names decide, and then the sizes. `layouts` says which folders are looked at.
"""

import os
import re
from collections.abc import Sequence
from pathlib import Path

from skyline_viz.datasets.label_picture import label_size
from skyline_viz.datasets.truths import SKYLINE_SUFFIXES, begins_like_a_skyline, truth_with_notes
from skyline_viz.photo import PhotoError, find_photos, photo_size
from skyline_viz.skyline import SkylineError

_MAP_NAMES = ("label", "pinhole_label")

NUMBERED = re.compile(r"(?:gt_)?(?:(marsim)|r_gimag|googleimage)(\d+)(?:_edge)?", re.IGNORECASE)
"""Names of photos and truths of Basalt (group 1) and Web, and their numbers (group 2)."""

ADDED = re.compile(r"[-_](masks?|edge|gt|truth|labels?)$", re.IGNORECASE)
"""What the name of a truth has besides that of its photo."""

TRUTH_FOLDERS = ("ground_truth", "masks", "truth", "labels")
"""Folders (lower case) beside photos, or beside their ``images/``, that hold truths."""


def bare_stem(stem: str) -> str:
    """The name of a truth without what is added to that of its photo.

    >>> bare_stem("a_mask"), bare_stem("b-Edge"), bare_stem("c")
    ('a', 'b', 'c')
    """
    return ADDED.sub("", stem)


def is_truth_folder(place: Path) -> bool:
    """Whether a folder holds the truths of the photos beside it, and not photos."""
    named = place.name.lower() in TRUTH_FOLDERS
    return named and bool(folder_named(place.parent, "images") or find_photos(place.parent))


def without_truths(files: Sequence[Path]) -> list[Path]:
    """The photos among the pictures of a folder: what has a photo's name and ``_mask`` is none."""
    stems = {file.stem for file in files}
    maps = any(stem.lower() == "photo" for stem in stems)
    return [
        file
        for file in files
        if bare_stem(file.stem) == file.stem or bare_stem(file.stem) not in stems
        if not (maps and file.stem.lower().startswith(_MAP_NAMES))
    ]


def truths_in(root: Path, place: Path, problems: list[str]) -> list[Path]:
    """Files of a folder of truths; ``labels/`` may be full of other programs' files."""
    texts = skyline_files(place)
    if place.name.lower() == "labels":
        for file in [file for file in texts if not begins_like_a_skyline(file)]:
            problems.append(
                f"{file.relative_to(root)} holds no skyline; skyline-annotate import reads files "
                f"of other programs."
            )
            texts.remove(file)
    return [*texts, *find_photos(place)]


def choose(root: Path, photo: Path, truths: list[Path], problems: list[str]) -> Path | None:
    """Return the first truth that has the photo's size; name the others."""
    chosen = None
    for truth in truths:
        if misfit := _misfit(photo, truth):
            problems.append(f"{truth.relative_to(root)} {misfit}.")
        elif chosen:
            used = chosen.relative_to(root)
            problems.append(f"{truth.relative_to(root)} is not used, because {used} is there.")
        else:
            chosen = truth
    return chosen


def _misfit(photo: Path, truth: Path) -> str | None:
    """How sizes differ; None where they agree, or where a damaged file does not tell its size."""
    try:
        height, width = photo_size(photo)
        if truth.suffix.lower() in SKYLINE_SUFFIXES:
            found, wanted = f"{truth_with_notes(truth).skyline.width} columns", f"{width}"
        else:
            found, wanted = "{1}x{0} pixels".format(*label_size(truth)), f"{width}x{height}"
    except (PhotoError, SkylineError):
        return None  # told when it is read
    return None if found.split()[0] == wanted else f"has {found}, and its photo {wanted}"


def common_name(stem: str) -> str:
    """What photo and truth have in common: the series and its number, else the name itself."""
    numbered = NUMBERED.fullmatch(stem)
    return f"{'marsim' if numbered[1] else 'web'} {int(numbered[2])}" if numbered else stem


def folders_in(folder: Path) -> list[Path]:
    """Folders in a folder that are not hidden and may be read, by name."""
    inside = (child for child in folder.iterdir() if not child.name.startswith("."))
    return sorted(child for child in inside if child.is_dir() and os.access(child, os.R_OK))


def folder_named(parent: Path, name: str) -> Path | None:
    """The folder of a name, in whatever case; None where there is none."""
    return next((child for child in folders_in(parent) if child.name.lower() == name), None)


def skyline_files(folder: Path) -> list[Path]:
    """CSV and JSON files of a folder, by name."""
    inside = (file for file in folder.iterdir() if not file.name.startswith("."))
    return sorted(f for f in inside if f.suffix.lower() in SKYLINE_SUFFIXES and f.is_file())


def photo_in(folder: Path) -> Path | None:
    """The photo of a folder of GeoPose3K; None where there is none."""
    return next((file for file in find_photos(folder) if file.stem.lower() == "photo"), None)


def label_maps_in(folder: Path) -> list[Path]:
    """Label maps of a folder of GeoPose3K, those of its ``pinhole/`` first."""
    places = [place for place in (folder_named(folder, "pinhole"), folder) if place]
    files = [file for place in places for file in find_photos(place)]
    return [file for file in files if file.stem.lower().startswith(_MAP_NAMES)]
