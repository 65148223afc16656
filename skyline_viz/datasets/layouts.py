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
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from skyline_viz.arrays import U8
from skyline_viz.datasets.matching import (
    ADDED,
    NUMBERED,
    TRUTH_FOLDERS,
    bare_stem,
    choose,
    common_name,
    folder_named,
    folders_in,
    label_maps_in,
    photo_in,
    skyline_files,
    truths_in,
)
from skyline_viz.datasets.truths import SKYLINE_SUFFIXES, begins_like_a_skyline, truth_with_notes
from skyline_viz.photo import find_photos, read_photo_with_notes
from skyline_viz.picture_files.kinds import left_out
from skyline_viz.picture_files.listing import find_unread
from skyline_viz.skyline import Skyline
from skyline_viz.system.notes import note

Layout = Literal["Basalt", "Web", "CH1", "GeoPose3K", "plain"]
"""The published layouts, and the folder of photographs that follows none of them."""

_CH1_PARTS = ("cvg", "panoramio", "poor_edge_images")


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


def truth_names(item: DatasetItem) -> str:
    """Names by which the truth of a photo would be found, in words."""
    stem = item.photo_path.stem
    if item.label_map:
        return f"labels.png in {item.photo_path.parent.name} or its folder pinhole"
    places = " or ".join([", ".join(f"{one}/" for one in TRUTH_FOLDERS[:-1]), TRUTH_FOLDERS[-1]])
    return f"{stem}.png, {stem}_mask.png, {stem}.csv or the like, in {places}/"


def _inside(root: Path) -> list[Dataset]:
    """Data sets one level down; loose photos there are somebody's pictures, not a data set."""
    found = [(child, _recognise(child)) for child in folders_in(root)]
    return [
        dataset
        for child, dataset in found
        if dataset and (dataset.layout != "plain" or folder_named(child, "images"))
    ]


def _recognise(root: Path) -> Dataset | None:
    items: list[DatasetItem] = []
    problems: list[str] = []
    layout: Layout = "GeoPose3K"
    folders = folders_in(root)
    plain = folder_named(root, "images") is not None
    parts = [part for part in folders if part.name.lower() in _CH1_PARTS]
    if parts := [part for part in parts if folder_named(part, "images")]:
        layout = "CH1"
        for part in parts:
            items += _match(root, part, f"{part.name}/", problems)
    elif not plain and photo_in(root) and label_maps_in(root):
        items += _geopose3k(root, [root], problems)
    elif not plain and any(photo_in(folder) and label_maps_in(folder) for folder in folders):
        items += _geopose3k(root, folders, problems)
    elif items := _match(root, root, "", problems):
        numbered = [match for item in items if (match := NUMBERED.fullmatch(item.name))]
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
    for folder in [root, *folders_in(root)]:
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
    others = [one for one in folders_in(root) if one.name.lower() not in TRUTH_FOLDERS]
    inside = [
        (one.name, sum(bare_stem(file.stem) == file.stem for file in find_photos(one)))
        for one in others
    ]
    if full := [f"{name} ({count})" for name, count in inside if count]:
        return f" itself, but folders in it do: {', '.join(full)}; name those"
    return ""


def _match(root: Path, folder: Path, prefix: str, problems: list[str]) -> list[DatasetItem]:
    """Photos of ``folder/images``, else of `folder`, each with the truth that has its name."""
    images = folder_named(folder, "images")
    images = images if images and find_photos(images) else folder
    files = find_photos(images)
    stems = {file.stem for file in files}

    def is_truth(file: Path) -> bool:  # but knife_edge.jpg is a photo, unless there is a knife.jpg
        added = ADDED.search(file.stem)
        mask = added is not None and added[0].lower() in ("-mask", "_mask")
        return added is not None and (mask or bare_stem(file.stem) in stems)

    photos = [file for file in files if not is_truth(file)]
    truths = [file for file in skyline_files(images) if begins_like_a_skyline(file)]
    for place in (folder_named(folder, name) for name in TRUTH_FOLDERS):
        truths += truths_in(root, place, problems) if place else []
    truths += [file for file in files if is_truth(file)]
    truths.sort(key=lambda file: file.suffix.lower() not in SKYLINE_SUFFIXES)

    matched: dict[Path, list[Path]] = {photo: [] for photo in photos}
    named: dict[str, list[list[Path]]] = {}
    for photo, candidates in matched.items():
        named.setdefault(common_name(photo.stem), []).append(candidates)
    for truth in truths:
        for candidates in (
            found := named.get(common_name(truth.stem)) or named.get(bare_stem(truth.stem), [])
        ):
            candidates.append(truth)
        if not found:
            problems.append(f"{truth.relative_to(root)} has no photo.")

    repeated = Counter(photo.stem for photo in photos)
    return [
        DatasetItem(
            prefix + (photo.name if repeated[photo.stem] > 1 else photo.stem),
            photo,
            choose(root, photo, candidates, problems),
        )
        for photo, candidates in matched.items()
    ]


def _geopose3k(root: Path, folders: list[Path], problems: list[str]) -> list[DatasetItem]:
    """One photo a folder."""
    items = []
    for folder in folders:
        photo, maps = photo_in(folder), label_maps_in(folder)
        if photo:
            truth = choose(root, photo, maps, problems)
            items.append(DatasetItem(folder.absolute().name, photo, truth, label_map=True))
        elif maps:
            problems.append(f"{maps[0].relative_to(root)} has no photo.")
    return items
