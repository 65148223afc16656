"""Which truth belongs to which photo: by where both lie, and by their names.

A truth beside a photo is called as the photo is. One in a folder of truths also lies as deep below
it as the photo lies below the folder that holds it: ``masks/day1/a.png`` is of ``day1/a.jpg``, and
of ``images/day1/a.jpg``. ``masks/day1__a.png`` is as well, and ``masks/images__day1__a.png`` of the
second, for so exports are called.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from skyline_viz.datasets.matching import (
    IMAGE_FOLDERS,
    TRUTH_FOLDERS,
    bare_stem,
    common_name,
    is_truth_word,
    skyline_files,
)
from skyline_viz.datasets.tree import Tree
from skyline_viz.datasets.truths import SKYLINE_SUFFIXES, begins_like_a_skyline
from skyline_viz.photo import find_photos

_SILENT = {*IMAGE_FOLDERS, *TRUTH_FOLDERS, "sky"}  # folders that do not tell photos apart
_OTHERS = ("labels", "annotations")  # which may be full of other programs' files

_Key = tuple[Path, tuple[str, ...] | None, str]
"""Where truths are kept, the folders below that (None beside the photo), and a name."""


def paired(tree: Tree, problems: list[str]) -> dict[Path, list[Path]]:
    """The truths that are called after each photo, the most exact first.

    Args:
        tree: What lies in the folder.
        problems: Gets a sentence for each truth that has no photo.
    """
    matched: dict[Path, list[Path]] = {photo: [] for photo in tree.photos}
    places: dict[_Key, list[Path]] = {}
    for photo in tree.photos:
        for key in _keys_of_photo(tree, photo):
            places.setdefault(key, []).append(photo)
    truths = list(_truths(tree, problems))
    truths.sort(key=lambda one: one[0].suffix.lower() not in SKYLINE_SUFFIXES)
    linked = set(tree.linked.values())
    for photo, truth in tree.linked.items():
        if photo in matched:
            matched[photo].append(truth)
    for file, keys in truths:
        photos = next(filter(None, (places.get(key) for key in keys)), [])
        for photo in photos:
            if file not in matched[photo]:
                matched[photo].append(file)
        if not photos and file not in linked:
            problems.append(f"{file.relative_to(tree.root)} has no photo.")
    return matched


def item_names(tree: Tree) -> list[str]:
    """A name for each photo: its stem after the folders it lies in, less those of `IMAGE_FOLDERS`.

    Photos of one stem keep their endings, or all their folders.
    """
    root, photos = tree.root, tree.photos
    homes = [_told(photo.parent.relative_to(root).parts, IMAGE_FOLDERS) for photo in photos]
    names = []
    for photo, home in zip(photos, homes, strict=True):
        own = home or (root.absolute().name,) if photo in tree.lone else (*home, photo.stem)
        names.append("/".join(own))
    longer = [
        ["/".join((*home, photo.name)) for photo, home in zip(photos, homes, strict=True)],
        [photo.relative_to(root).as_posix() for photo in photos],
    ]
    for others in longer:
        repeated = Counter(names)
        names = [
            other if repeated[name] > 1 else name for name, other in zip(names, others, strict=True)
        ]
    return names


def _keys_of_photo(tree: Tree, photo: Path) -> Iterator[_Key]:
    home, name = photo.parent, common_name(photo.stem)
    yield home, None, name
    above = home
    while True:
        inside = _told(home.relative_to(above).parts, IMAGE_FOLDERS)
        if photo in tree.lone:
            yield above, inside, ""
            if inside:
                yield above, inside[:-1], common_name(inside[-1])
        yield above, inside, name
        whole = home.relative_to(above).parts
        for folders in filter(None, dict.fromkeys((inside, whole))):
            yield above, (), "__".join((*folders, photo.stem))
        if above == tree.root:
            return
        above = above.parent


def _truths(tree: Tree, problems: list[str]) -> Iterator[tuple[Path, list[_Key]]]:
    """Each truth, and where its photo could be, the likeliest place first."""
    for home in dict.fromkeys(photo.parent for photo in tree.photos):
        for file in skyline_files(home):
            if begins_like_a_skyline(file):
                yield file, _keys_beside(file)
    order = {name: place for place, name in enumerate(TRUTH_FOLDERS)}
    for folder in sorted(tree.truths, key=lambda one: order.get(one.name.lower(), len(order))):
        for place, folders, _ in os.walk(folder):
            folders[:] = sorted(name for name in folders if not name.startswith("."))
            here = Path(place)
            inside = _told(here.relative_to(folder).parts, _SILENT)
            for file in _files(tree.root, here, folder.name.lower() in _OTHERS, problems):
                yield file, list(_keys_inside(folder.parent, inside, file.stem))
    for file in tree.beside:
        yield file, _keys_beside(file)


def _keys_beside(file: Path) -> list[_Key]:
    names = common_name(file.stem), bare_stem(file.stem)
    keys: list[_Key] = [(file.parent, None, name) for name in names]
    if is_truth_word(file.stem):  # in the folder of one photo, or in its pinhole/
        keys += [(place, (), "") for place in (file.parent, file.parent.parent)]
    return keys


def _keys_inside(home: Path, inside: tuple[str, ...], stem: str) -> Iterator[_Key]:
    for name in (common_name(stem), bare_stem(stem)):
        yield home, inside, name
    if inside and is_truth_word(stem):
        yield home, inside, ""


def _files(root: Path, place: Path, others: bool, problems: list[str]) -> list[Path]:
    """Files of a folder of truths; of `others`, only those that hold skylines or are pictures."""
    texts = skyline_files(place)
    if others:
        for file in [file for file in texts if not begins_like_a_skyline(file)]:
            problems.append(
                f"{file.relative_to(root)} holds no skyline; skyline-annotate import reads files "
                f"of other programs."
            )
            texts.remove(file)
    return [*texts, *find_photos(place)]


def _told(parts: Sequence[str], silent: Sequence[str] | set[str]) -> tuple[str, ...]:
    return tuple(part for part in parts if part.lower() not in silent)
