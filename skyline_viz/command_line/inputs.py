"""From the photos and folders of a command line to what to work on, and where it may be written."""

import os
from collections.abc import Callable, Iterable, Sequence
from itertools import count
from pathlib import Path

from skyline_viz.command_line.messages import UsageError, say, say_last
from skyline_viz.command_line.sources import Missing, named
from skyline_viz.command_line.truth_options import Truths
from skyline_viz.datasets.dataset import Dataset, DatasetError, DatasetItem
from skyline_viz.datasets.layouts import truth_names
from skyline_viz.datasets.matching import IMAGE_FOLDERS, TRUTH_FOLDERS
from skyline_viz.datasets.named_item import NamedItem
from skyline_viz.datasets.tables.parquet_files import is_label_table
from skyline_viz.photo import PhotoError
from skyline_viz.running.batch import Failure
from skyline_viz.storage.addresses import is_address
from skyline_viz.system.names import listed, shortened

_LONGEST = 255 - len("-overlay.jpg")
"""Bytes of an output's name, without the longest ending that we put to it."""


_MOST_SAID = 5  # sentences of a kind that are said one by one
_NO_PHOTO = " has no photo."

NO_PHOTOS = "which photos? Name at least one photo or folder."


def collect(
    paths: Sequence[str | Path], truths: Truths | None = None, taken: Sequence[str] = ()
) -> list[NamedItem]:
    """Photos of a command line: files as they are, folders as data sets; each path once.

    A file that does not exist is an input, too: it fails when its turn comes. So does a folder
    that holds no photo, beside others that do.

    Args:
        paths: Files, folders, patterns, addresses and lists, see `sources.named`.
        truths: How to read the truths of data sets.
        taken: Names that no photo's outputs may have.

    Raises:
        DatasetError: None of the folders holds a photo.
        UsageError: A list cannot be read.
    """
    found: dict[str, DatasetItem] = {}
    missing: list[Missing] = []
    for one in named(paths):
        for item in _opened(one, truths or Truths()):
            if isinstance(item, Missing):
                missing.append(item)
            where = item.where
            where = where if is_address(where) else os.path.abspath(where)  # noqa: PTH100  # links stay
            found.setdefault(where, item)
    if len(missing) == len(found):
        raise DatasetError(" ".join(one.reason for one in missing[:_MOST_SAID]))
    items = list(found.values())
    plain = [_plain_name(item) for item in items]
    names = output_names(items, taken)
    pairs = list(zip(names, plain, strict=True))
    if long := [name for name, stem in pairs if name != stem and not _fits(stem)]:
        say(f"names too long for those of outputs are cut: {listed([*map(shortened, long)])}.")
    if renamed := [name for name, stem in pairs if name != stem and _fits(stem)]:
        say(f"photos whose names are taken are told apart in those of outputs: {listed(renamed)}.")
    return [NamedItem(name, item) for name, item in zip(names, items, strict=True)]


def output_names(items: Sequence[DatasetItem], taken: Sequence[str] = ()) -> list[str]:
    """A name for the outputs of each photo: its stem, and more only where stems clash.

    Names that differ in upper and lower case only clash, because on some disks their files do.
    """
    names = [_fitting(_plain_name(item)) for item in items]
    reserved = {name.casefold() for name in taken}
    names = [f"{name}-photo" if name.casefold() in reserved else name for name in names]
    longer: tuple[Callable[[DatasetItem], str], ...] = (
        lambda item: item.name.replace("/", "-"),
        lambda item: f"{item.photo_path.parent.name}-{item.photo_path.stem}".lstrip("-"),
        lambda item: item.photo_path.name,
    )
    for longer_name in longer:
        for clash in _clashes(names):
            others = [_fitting(longer_name(items[index])) for index in clash]
            if not _clashes(others):
                for index, name in zip(clash, others, strict=True):
                    names[index] = name
    for clash in _clashes(names):
        for number, index in enumerate(clash[1:], start=2):
            used = {name.casefold() for name in names}
            free = (f"{names[index]}-{more}" for more in count(number))
            names[index] = next(name for name in free if name.casefold() not in used)
    return names


def _fits(name: str) -> bool:
    return len(os.fsencode(name)) <= _LONGEST


def _fitting(name: str) -> str:
    """A name, cut where no file system would take it with an ending."""
    return name if _fits(name) else os.fsdecode(os.fsencode(name)[: _LONGEST - 4]) + "-cut"


def _clashes(names: Sequence[str]) -> list[list[int]]:
    """Groups of places in a list that hold the same name."""
    places: dict[str, list[int]] = {}
    for place, name in enumerate(names):
        places.setdefault(name.casefold(), []).append(place)
    return [group for group in places.values() if len(group) > 1]


def with_truth(dataset: Dataset) -> list[DatasetItem]:
    """Photos of a data set that have a truth; says what is wrong with others.

    Of those without a truth only the headers are read.

    Raises:
        UsageError: No photo has a truth.
    """
    _tell(dataset)
    usable = [item for item in dataset if item.has_truth]
    without = []
    for item in dataset:
        if item.has_truth:
            continue  # what is wrong with its photo is said when its turn comes
        try:
            item.size()
            without.append(item.name)
        except PhotoError as error:
            say(f"{str(Failure(item.name, str(error))).rstrip('.')}; it has no truth either.")
    if not usable:
        raise UsageError(
            f"{dataset.name} holds no truth for any of its {len(dataset)} photos; "
            f"one is found as {truth_names(dataset.items[0])}."
        )
    if without:
        say(f"left out, because there is no truth: {listed(without)}.")
    return usable


def output_folder(out: Path, items: Iterable[DatasetItem]) -> Path:
    """Make a folder for outputs.

    Raises:
        UsageError: It cannot be made or written to, or what is written there would later be taken
            for the truth of a photo.
    """
    target = out.resolve()
    photos = [item.photo_path for item in items if not isinstance(item, Missing)]
    for place in {photo.resolve().parent for photo in photos}:
        homes = [place, place.parent] if place.name.lower() in IMAGE_FOLDERS else [place]
        truths = target.name.lower() in TRUTH_FOLDERS and target.parent in homes
        if target == place or truths:
            raise UsageError(
                f"files written into {out} would be taken for the truth of the photos in {place}; "
                f"choose another --out."
            )
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise UsageError(f"the folder {out} cannot be made: {reason}.") from error
    if not os.access(out, os.W_OK | os.X_OK):
        raise UsageError(f"the folder {out} may not be written to.")
    return out


def _tell(dataset: Dataset) -> None:
    """Say what is wrong with a data set, and at the very end what was not taken."""
    lost = [one for one in dataset.problems if one.endswith(_NO_PHOTO)]
    many = len(lost) > _MOST_SAID
    for problem in dataset.problems:
        if not (many and problem in lost):
            say(f"{dataset.name}: {problem}")
    if many:
        names = listed([one.removesuffix(_NO_PHOTO) for one in lost])
        say(f"{dataset.name}: {len(lost)} truths have no photo: {names}.")
    for sentence in dataset.left_out:
        say_last(f"{dataset.name}: {sentence}")


def _opened(named: Path | str | Missing, truths: Truths) -> Iterable[DatasetItem]:
    """The photos of what was named."""
    if isinstance(named, Missing):
        return [named]
    path = Path(named)
    if not is_label_table(named) and not path.is_dir():
        return [DatasetItem(path.stem, path)]
    try:
        datasets = truths.open_all(named)
    except DatasetError as error:
        return [Missing(path.name, path, reason=str(error))]
    for dataset in datasets:
        _tell(dataset)
    return [item for dataset in datasets for item in dataset]


def _plain_name(item: DatasetItem) -> str:
    """The photo's stem; where a folder holds one photo, and all have the same stem, its folder."""
    own, path = item.name.rpartition("/")[2], item.photo_path
    return path.stem if own in (path.stem, path.name) else own
