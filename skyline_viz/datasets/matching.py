"""How truths are called, and which one of a photo counts.

The names decide, and then the sizes. `tree` says which folders are looked at, `pairing` which truth
belongs to which photo.
"""

import os
import re
from pathlib import Path

from skyline_viz.datasets.label_picture import label_size
from skyline_viz.datasets.truths import SKYLINE_SUFFIXES, truth_with_notes
from skyline_viz.photo import PhotoError, photo_size
from skyline_viz.skyline import SkylineError

_MAP_NAMES = ("label", "pinhole_label")

NUMBERED = re.compile(r"(?:gt_)?(?:(marsim)|r_gimag|googleimage)(\d+)(?:_edge)?", re.IGNORECASE)
"""Names of photos and truths of Basalt (group 1) and Web, and their numbers (group 2)."""

ADDED = re.compile(r"[-_](masks?|edge|gt|truth|labels?)$", re.IGNORECASE)
"""What the name of a truth has besides that of its photo."""

TRUTH_FOLDERS = (
    "ground_truth",
    "masks",
    "truth",
    "labels",
    "annotations",
    "groundtruth",
    "gt",
    "mask",
)
"""Folders (lower case) beside photos, or beside their ``images/``, that hold truths."""

IMAGE_FOLDERS = ("images", "image", "imgs", "img", "photos")
"""Folders (lower case) of photos that say no more than that: they are in no name."""

_TRUTH_WORD = re.compile(
    r"(pinhole_)?labels?(_.*)?|masks?|sky|skyline|truth|ground_?truth|gt|edge|segmentation",
    re.IGNORECASE,
)


def bare_stem(stem: str) -> str:
    """The name of a truth without what is added to that of its photo.

    >>> bare_stem("a_mask"), bare_stem("b-Edge"), bare_stem("c")
    ('a', 'b', 'c')
    """
    return ADDED.sub("", stem)


def is_label_map(stem: str) -> bool:
    """Whether a file beside a photo of GeoPose3K is called as its label maps are."""
    return stem.lower().startswith(_MAP_NAMES)


def is_truth_word(stem: str) -> bool:
    """Whether a file that lies with its photo in a folder of their own is called as a truth is.

    >>> is_truth_word("mask"), is_truth_word("labels_crop"), is_truth_word("north")
    (True, True, False)
    """
    return _TRUTH_WORD.fullmatch(stem) is not None


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
