"""Opening data sets: the layouts that their authors publish, and plain folders of photographs.

=========  =================================  ====================================================
layout     photos                             truth
=========  =================================  ====================================================
Basalt     ``images/marsim0001.pgm``          ``ground_truth/GT_marsim001_Edge.bmp``
Web        ``images/R_GImag0001.bmp``         ``ground_truth/GT_GoogleImage001_Edge.bmp``
CH1        ``PART/images/NAME.EXT``           ``PART/ground_truth/NAME-mask.EXT``
GeoPose3K  ``NAME/photo.jpg``                 ``NAME/pinhole/labels*.png``, ``NAME/labels*.png``
plain      ``images/*``, else ``*``           in a folder of truths or beside the photo
=========  =================================  ====================================================

What a truth may be, `skyline_viz.truths` says. Folders of truths are ``ground_truth/``, ``masks/``,
``truth/`` and ``labels/``. A truth has the photo's name, to which ``_mask``, ``_edge``, ``_gt``,
``_truth`` or ``_label`` may be added, with ``-`` or ``_``; Basalt and Web go by number. Several
truths of a photo: the first counts, CSV and JSON before pictures.

GeoPose3K's maps in ``cyl/`` are in a cylindrical projection, to which the photo does not fit, and
are not used.
"""

import os
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from skyline_viz.arrays import U8
from skyline_viz.datasets.label_picture import label_size
from skyline_viz.datasets.truths import SKYLINE_SUFFIXES, begins_like_a_skyline, truth_with_notes
from skyline_viz.photo import PhotoError, find_photos, photo_size, read_photo_with_notes
from skyline_viz.picture_files.kinds import left_out
from skyline_viz.picture_files.listing import find_unread
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.system.notes import note

Layout = Literal["Basalt", "Web", "CH1", "GeoPose3K", "plain"]
"""The published layouts, and the folder of photographs that follows none of them."""

_MAP_NAMES = ("label", "pinhole_label")
_CH1_PARTS = ("cvg", "panoramio", "poor_edge_images")
_NUMBERED = re.compile(r"(?:gt_)?(?:(marsim)|r_gimag|googleimage)(\d+)(?:_edge)?", re.IGNORECASE)
_ADDED = re.compile(r"[-_](masks?|edge|gt|truth|labels?)$", re.IGNORECASE)

TRUTH_FOLDERS = ("ground_truth", "masks", "truth", "labels")
"""Folders (lower case) beside photos, or beside their ``images/``, that hold truths."""


class DatasetError(ValueError):
    """A folder is not a data set; the message is one sentence naming the folder and the reason."""


@dataclass(frozen=True)
class DatasetItem:
    """One photo of a data set and its truth, both read only when asked for."""

    name: str
    """Unique in the data set: the file's stem, for CH1 ``part/stem``, for GeoPose3K the folder."""

    photo_path: Path
    """The photo's file."""

    truth_path: Path | None = None
    """The truth's file: painted photo, mask, label map, CSV or JSON. None where there is none."""

    label_map: bool = False
    """Whether the truth is a GeoPose3K label map, in which black is sky."""

    sky: str | None = None
    """Which value of a mask is sky, as `read_truth` takes it; told by the mask unless given."""

    terrain: str | None = None
    """Which value of a mask is terrain, instead of `sky`."""

    def photo(self) -> U8:
        """Read the photo, ``(H, W, 3)`` uint8 RGB; what there is to know about it is noted.

        Raises:
            PhotoError: It cannot be read.
        """
        photo, notes = read_photo_with_notes(self.photo_path)
        for one in notes:
            note(one)
        return photo

    def truth(self) -> Skyline | None:
        """Read the truth; None where there is none. What was left out of it is noted.

        Raises:
            SkylineError: The file is damaged, or is no truth; the message names it.
        """
        if self.truth_path is None:
            return None
        path, sky, terrain = self.truth_path, self.sky, self.terrain
        line = truth_with_notes(path, self.label_map, sky=sky, terrain=terrain)
        if line.notes:
            note(f"{path}: {'; '.join(line.notes)}.")
        return line.skyline


@dataclass(frozen=True)
class Dataset:
    """The photos of a folder, sorted by name: iterate over it, or ask for its length."""

    name: str
    """The name of the folder."""

    layout: Layout
    """How photos and truths were matched."""

    items: tuple[DatasetItem, ...]
    """The photos with their truths, by name."""

    problems: tuple[str, ...] = ()
    """One sentence for each truth that was left out, naming it and the reason."""

    left_out: tuple[str, ...] = ()
    """What else lies there: a sentence about pictures that cannot be read, grouped by the reason,
    and one about photos in folders in which none is looked for."""

    def __iter__(self) -> Iterator[DatasetItem]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)


def open_dataset(
    folder: str | os.PathLike[str], *, sky: str | None = None, terrain: str | None = None
) -> Dataset:
    """Open a data set, or the folder in which a single one lies, and match photos with truths.

    Looks at names and headers and reads no pixels, but for masks of numbers that no photo has. A
    photo without truth is fine. A truth without
    photo, or of another size than its photo, is left out and named in `Dataset.problems`. Hidden
    files are ignored.

    Args:
        folder: The folder.
        sky: Which value of masks is sky, as `skyline_viz.truths.read_truth` takes it; told by each
            mask itself unless given.
        terrain: Which value of masks is terrain, instead of `sky`.

    Raises:
        DatasetError: The folder is missing, is a file, cannot be listed, holds no photograph, or
            holds several data sets.
    """
    root = Path(folder)
    try:
        if not root.is_dir():
            reason = "is a file, not a folder" if root.exists() else "does not exist"
            raise DatasetError(f"{root} {reason}.")
        found = [dataset] if (dataset := _recognise(root)) else _inside(root)
    except OSError as error:
        reason = error.strerror or str(error)
        raise DatasetError(f"{root} cannot be read: {reason.lower()}.") from error
    if not found:
        raise DatasetError(f"{root} holds no photograph{_else_in(root)}.")
    if len(found) > 1:
        names = ", ".join(dataset.name for dataset in found)
        raise DatasetError(f"{root} holds several data sets, {names}; open one of them.")
    items = tuple(replace(item, sky=sky, terrain=terrain) for item in found[0])
    return replace(found[0], items=items)


def bare_stem(stem: str) -> str:
    """The name of a truth without what is added to that of its photo.

    >>> bare_stem("a_mask"), bare_stem("b-Edge"), bare_stem("c")
    ('a', 'b', 'c')
    """
    return _ADDED.sub("", stem)


def truth_names(item: DatasetItem) -> str:
    """Names by which the truth of a photo would be found, in words."""
    stem = item.photo_path.stem
    if item.label_map:
        return f"labels.png in {item.photo_path.parent.name} or its folder pinhole"
    places = " or ".join([", ".join(f"{one}/" for one in TRUTH_FOLDERS[:-1]), TRUTH_FOLDERS[-1]])
    return f"{stem}.png, {stem}_mask.png, {stem}.csv or the like, in {places}/"


def is_truth_folder(place: Path) -> bool:
    """Whether a folder holds the truths of the photos beside it, and not photos."""
    named = place.name.lower() in TRUTH_FOLDERS
    return named and bool(_folder(place.parent, "images") or find_photos(place.parent))


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


def _inside(root: Path) -> list[Dataset]:
    """Data sets one level down; loose photos there are somebody's pictures, not a data set."""
    found = [(child, _recognise(child)) for child in _folders(root)]
    return [
        dataset
        for child, dataset in found
        if dataset and (dataset.layout != "plain" or _folder(child, "images"))
    ]


def _recognise(root: Path) -> Dataset | None:
    items: list[DatasetItem] = []
    problems: list[str] = []
    layout: Layout = "GeoPose3K"
    folders = _folders(root)
    plain = _folder(root, "images") is not None
    parts = [part for part in folders if part.name.lower() in _CH1_PARTS]
    if parts := [part for part in parts if _folder(part, "images")]:
        layout = "CH1"
        for part in parts:
            items += _match(root, part, f"{part.name}/", problems)
    elif not plain and _photo_of(root) and _label_maps(root):
        items += _geopose3k(root, [root], problems)
    elif not plain and any(_photo_of(folder) and _label_maps(folder) for folder in folders):
        items += _geopose3k(root, folders, problems)
    elif items := _match(root, root, "", problems):
        numbered = [match for item in items if (match := _NUMBERED.fullmatch(item.name))]
        layout = "plain"
        if 2 * len(numbered) > len(items):
            layout = "Basalt" if numbered[0][1] else "Web"
    else:
        items += _geopose3k(root, folders, problems)
    if not items:
        return None
    items.sort(key=lambda item: item.name)
    # folders of GeoPose3K hold pictures of other kinds, too
    left = () if layout == "GeoPose3K" else _not_taken(root, items)
    return Dataset(root.absolute().name, layout, tuple(items), tuple(problems), left)


def _not_taken(root: Path, items: list[DatasetItem]) -> tuple[str, ...]:
    """See `Dataset.left_out`."""
    taken = {item.photo_path.parent for item in items}
    homes = sorted({root, *taken, *(folder.parent for folder in taken if folder != root)})
    unread = left_out((file for home in homes for file in find_unread(home)), root)
    return tuple(one for one in (unread, _photos_elsewhere(root, taken)) if one)


def _photos_elsewhere(root: Path, taken: set[Path]) -> str | None:
    """A sentence about photos in folders of a data set in which none is looked for."""
    elsewhere = {}
    for folder in [root, *_folders(root)]:
        truths = folder.name.lower() in TRUTH_FOLDERS and folder != root
        if folder not in taken and not truths and (count := len(find_photos(folder))):
            elsewhere["the folder itself" if folder == root else folder.name] = count
    if not elsewhere:
        return None
    named = ", ".join(f"{count} in {name}" for name, count in elsewhere.items())
    return f"photos in other places are not taken: {named}; name those folders to take them."


def _else_in(root: Path) -> str:
    """What a folder without photos holds instead, to end a sentence."""
    if unread := left_out(find_unread(root), root):
        return f"; {unread[:-1]}"
    others = [one for one in _folders(root) if one.name.lower() not in TRUTH_FOLDERS]
    inside = [
        (one.name, sum(bare_stem(file.stem) == file.stem for file in find_photos(one)))
        for one in others
    ]
    if full := [f"{name} ({count})" for name, count in inside if count]:
        return f" itself, but folders in it do: {', '.join(full)}; name those"
    return ""


def _match(root: Path, folder: Path, prefix: str, problems: list[str]) -> list[DatasetItem]:
    """Photos of ``folder/images``, else of `folder`, each with the truth that has its name."""
    images = _folder(folder, "images")
    images = images if images and find_photos(images) else folder
    files = find_photos(images)
    stems = {file.stem for file in files}

    def is_truth(file: Path) -> bool:  # but knife_edge.jpg is a photo, unless there is a knife.jpg
        added = _ADDED.search(file.stem)
        mask = added is not None and added[0].lower() in ("-mask", "_mask")
        return added is not None and (mask or bare_stem(file.stem) in stems)

    photos = [file for file in files if not is_truth(file)]
    truths = [file for file in _skyline_files(images) if begins_like_a_skyline(file)]
    for place in (_folder(folder, name) for name in TRUTH_FOLDERS):
        truths += _truths_in(root, place, problems) if place else []
    truths += [file for file in files if is_truth(file)]
    truths.sort(key=lambda file: file.suffix.lower() not in SKYLINE_SUFFIXES)

    matched: dict[Path, list[Path]] = {photo: [] for photo in photos}
    named: dict[str, list[list[Path]]] = {}
    for photo, candidates in matched.items():
        named.setdefault(_key(photo.stem), []).append(candidates)
    for truth in truths:
        for candidates in (
            found := named.get(_key(truth.stem)) or named.get(bare_stem(truth.stem), [])
        ):
            candidates.append(truth)
        if not found:
            problems.append(f"{truth.relative_to(root)} has no photo.")

    repeated = Counter(photo.stem for photo in photos)
    return [
        DatasetItem(
            prefix + (photo.name if repeated[photo.stem] > 1 else photo.stem),
            photo,
            _choose(root, photo, candidates, problems),
        )
        for photo, candidates in matched.items()
    ]


def _truths_in(root: Path, place: Path, problems: list[str]) -> list[Path]:
    """Files of a folder of truths; ``labels/`` may be full of other programs' files."""
    texts = _skyline_files(place)
    if place.name.lower() == "labels":
        for file in [file for file in texts if not begins_like_a_skyline(file)]:
            problems.append(
                f"{file.relative_to(root)} holds no skyline; skyline-annotate import reads files "
                f"of other programs."
            )
            texts.remove(file)
    return [*texts, *find_photos(place)]


def _geopose3k(root: Path, folders: list[Path], problems: list[str]) -> list[DatasetItem]:
    """One photo a folder."""
    items = []
    for folder in folders:
        photo, maps = _photo_of(folder), _label_maps(folder)
        if photo:
            truth = _choose(root, photo, maps, problems)
            items.append(DatasetItem(folder.absolute().name, photo, truth, label_map=True))
        elif maps:
            problems.append(f"{maps[0].relative_to(root)} has no photo.")
    return items


def _choose(root: Path, photo: Path, truths: list[Path], problems: list[str]) -> Path | None:
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


def _key(stem: str) -> str:
    """What photo and truth have in common: the series and its number, else the name itself."""
    numbered = _NUMBERED.fullmatch(stem)
    return f"{'marsim' if numbered[1] else 'web'} {int(numbered[2])}" if numbered else stem


def _folders(folder: Path) -> list[Path]:
    inside = (child for child in folder.iterdir() if not child.name.startswith("."))
    return sorted(child for child in inside if child.is_dir() and os.access(child, os.R_OK))


def _folder(parent: Path, name: str) -> Path | None:
    return next((child for child in _folders(parent) if child.name.lower() == name), None)


def _skyline_files(folder: Path) -> list[Path]:
    inside = (file for file in folder.iterdir() if not file.name.startswith("."))
    return sorted(f for f in inside if f.suffix.lower() in SKYLINE_SUFFIXES and f.is_file())


def _photo_of(folder: Path) -> Path | None:
    return next((file for file in find_photos(folder) if file.stem.lower() == "photo"), None)


def _label_maps(folder: Path) -> list[Path]:
    places = [place for place in (_folder(folder, "pinhole"), folder) if place]
    files = [file for place in places for file in find_photos(place)]
    return [file for file in files if file.stem.lower().startswith(_MAP_NAMES)]
