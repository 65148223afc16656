"""Opening data sets: the layouts that their authors publish, and plain folders of photographs.

=========  =================================  ====================================================
layout     photos                             truth
=========  =================================  ====================================================
Basalt     ``images/marsim0001.pgm``          ``ground_truth/GT_marsim001_Edge.bmp``
Web        ``images/R_GImag0001.bmp``         ``ground_truth/GT_GoogleImage001_Edge.bmp``
CH1        ``PART/images/NAME.EXT``           ``PART/ground_truth/NAME-mask.EXT``
GeoPose3K  ``NAME/photo.jpg``                 ``NAME/pinhole/labels*.png``, ``NAME/labels*.png``
plain      wherever they lie in the folder    in a folder of truths, or beside the photo
=========  =================================  ====================================================

A file whose name ends in ``.parquet`` is a table of labels, see `datasets.tables.label_table`.

What a truth may be, `skyline_viz.truths` says. Folders of truths are ``ground_truth/``, ``masks/``,
``truth/``, ``labels/`` and others, see `matching.TRUTH_FOLDERS`. A truth has the photo's name,
to which ``_mask``, ``_edge``, ``_gt``, ``_truth`` or ``_label`` may be added, with ``-`` or ``_``.
Basalt and Web go by number. Of several truths of a photo the first counts, CSV and JSON before
pictures.

GeoPose3K's maps in ``cyl/`` are in a cylindrical projection, to which the photo does not fit, and
are not used.
"""

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from skyline_viz.datasets.dataset import Dataset, DatasetError, DatasetItem, Layout
from skyline_viz.datasets.lost_item import with_lost
from skyline_viz.datasets.matching import (
    IMAGE_FOLDERS,
    NUMBERED,
    TRUTH_FOLDERS,
    choose,
    folder_named,
    is_label_map,
)
from skyline_viz.datasets.pairing import item_names, paired
from skyline_viz.datasets.tables.label_table import open_label_table
from skyline_viz.datasets.tables.parquet_files import is_label_table
from skyline_viz.datasets.tables.table_item import TableItem
from skyline_viz.datasets.tree import Tree
from skyline_viz.picture_files.kinds import left_out
from skyline_viz.storage.addresses import is_address
from skyline_viz.storage.copies import copied
from skyline_viz.storage.copy_names import by_address

_GEOPOSE3K_DEEP = 2  # parts of NAME/photo.jpg
_CH1_PARTS = ("cvg", "panoramio", "poor_edge_images")


def open_dataset(
    folder: str | os.PathLike[str], *, sky: str | None = None, terrain: str | None = None
) -> Dataset:
    """Open a data set, or the folder in which a single one lies, and match photos with truths.

    Photos are also looked for in the folders below, see `skyline_viz.datasets.tree`. Looks at names
    and headers and reads no pixels, but for masks of numbers that no photo has. A photo without
    truth is fine. A truth without photo, or of another size than its photo, is left out and named
    in `Dataset.problems`. Hidden files are ignored. A table of labels is a data set, too, see
    `skyline_viz.datasets.tables.label_table`.

    Args:
        folder: The folder, or the table, which ends in ``.parquet``; by a path or an address. What
            lies at the address of a folder is copied, see `skyline_viz.storage.copies`.
        sky: Which value of masks is sky, as `skyline_viz.truths.read_truth` takes it; told by each
            mask itself unless given.
        terrain: Which value of masks is terrain, instead of `sky`.

    Raises:
        DatasetError: The folder is missing, is a file, cannot be listed, holds no photograph, or
            holds several data sets; or the table is damaged.
        StorageError: The address leads nowhere, or cannot be copied.
    """
    found = open_datasets(folder, sky=sky, terrain=terrain)
    if len(found) > 1:
        names = ", ".join(dataset.name for dataset in found)
        raise DatasetError(f"{Path(folder)} holds several data sets, {names}; open one of them.")
    return found[0]


def open_datasets(
    folder: str | os.PathLike[str], *, sky: str | None = None, terrain: str | None = None
) -> list[Dataset]:
    """Open a folder as `open_dataset` does; where it holds several published data sets, each one.

    Raises:
        DatasetError: The folder is missing, is a file, cannot be listed, or holds no photograph; or
            the table is damaged.
        StorageError: The address leads nowhere, or cannot be copied.
    """
    if is_label_table(folder):
        return [open_label_table(os.fspath(folder))]
    if is_address(folder):
        try:
            return open_datasets(copied(os.fspath(folder)), sky=sky, terrain=terrain)
        except DatasetError as error:
            raise DatasetError(by_address(str(error))) from error
    root = Path(folder)
    try:
        if not root.is_dir():
            reason = "is a file, not a folder" if root.exists() else "does not exist"
            raise DatasetError(f"{root} {reason}.")
        tree = Tree.of(root)
        if not tree.photos:
            others = left_out(tree.unread, root)
            raise DatasetError(f"{root} holds no photograph{f'; {others[:-1]}' if others else ''}.")
        inside = [Tree.of(one, named=False) for one in _several(tree)]
        found = [_opened(one) for one in inside or [tree]]
        found[0] = replace(found[0], left_out=tree.said())  # also of what lies beside them
    except OSError as error:
        reason = error.strerror or str(error)
        raise DatasetError(f"{root} cannot be read: {reason.lower()}.") from error
    return with_lost(
        (
            replace(one, items=tuple(replace(item, sky=sky, terrain=terrain) for item in one))
            for one in found
        ),
        root,
    )


def truth_names(item: DatasetItem) -> str:
    """Names by which the truth of a photo would be found, in words."""
    if isinstance(item, TableItem):
        return "a list of numbers in the column rows"
    stem = item.photo_path.stem
    if item.label_map:
        return f"labels.png in {item.photo_path.parent.name} or its folder pinhole"
    places = ", ".join(f"{one}/" for one in TRUTH_FOLDERS[:4])
    return f"{stem}.png, {stem}_mask.png, {stem}.csv or the like, in {places} or beside the photo"


def _several(tree: Tree) -> list[Path]:
    """Folders of a folder that are data sets of their own: published ones, or a single one."""
    root = tree.root
    inside: dict[Path, list[Path]] = {}
    for photo in tree.photos:
        inside.setdefault(root / photo.relative_to(root).parts[0], []).append(photo)
    near = [one for one in tree.photos if len(one.relative_to(root).parts) <= _GEOPOSE3K_DEEP]
    whole = _layout(root, tree.photos, tree) == "CH1" or _layout(root, near, tree) == "GeoPose3K"
    if whole or any(
        one.name.lower() in IMAGE_FOLDERS or photos == [one] for one, photos in inside.items()
    ):
        return []
    published = [one for one, photos in inside.items() if _layout(one, photos, tree) != "plain"]
    return published if len(published) > 1 else [*inside] if len(inside) == 1 else []


def _layout(root: Path, photos: Sequence[Path], tree: Tree) -> Layout:
    """The published layout that photos of a folder follow."""
    parts = {photo.relative_to(root).parts[0] for photo in photos}
    if any(one.lower() in _CH1_PARTS and folder_named(root / one, "images") for one in parts):
        return "CH1"
    if any(_is_geopose3k(photo, tree) for photo in photos):
        return "GeoPose3K"
    numbered = [match for photo in photos if (match := NUMBERED.fullmatch(photo.stem))]
    if 2 * len(numbered) > len(photos):
        return "Basalt" if numbered[0][1] else "Web"
    return "plain"


def _is_geopose3k(photo: Path, tree: Tree) -> bool:
    return photo in tree.lone and photo.stem.lower() == "photo"


def _opened(tree: Tree) -> Dataset:
    """The photos of a folder with their truths."""
    root = tree.root
    problems: list[str] = []
    matched = paired(tree, problems)
    items = []
    for name, photo in zip(item_names(tree), tree.photos, strict=True):
        truth = choose(root, photo, matched[photo], problems)
        label_map = _is_geopose3k(photo, tree) and (truth is None or is_label_map(truth.stem))
        items.append(DatasetItem(name, photo, truth, label_map=label_map))
    items.sort(key=lambda item: item.name)
    layout = _layout(root, tree.photos, tree)
    return Dataset(root.absolute().name, layout, tuple(items), tuple(sorted(problems)))
