"""Dealing photos into folds: one after the other, in groups that stay together, or as a file says.

Frames of a clip, crops of a photograph and pictures of one place resemble each other. With one of
them to learn from, another is no test.
"""

from __future__ import annotations

import csv
import io
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.datasets.item import Item, listed
from skyline_viz.files import write_text
from skyline_viz.running.batch import Failure, run
from skyline_viz.system.fingerprints import fingerprint, near_groups

GROUPINGS = ("folder", "near")
"""Ways to group photos by a name; any other text is a pattern for their names."""

SPLIT = "folds.csv"
"""Name of the file that says which fold each photo is in."""

_HEADER = ["name", "fold"]


def deal(
    items: Iterable[Item], folds: int = 2, groups: Mapping[str, str] | None = None
) -> dict[str, int]:
    """The fold of each photo by its name; photos of a group are in the same one.

    Groups are dealt in the order of their first names, each into the fold with the fewest photos
    so far. Photos that are no group are so dealt one after the other.

    Args:
        items: The photos.
        folds: Number of folds.
        groups: The group of each photo by its name, see `grouped`; without, each is one of its own.

    Raises:
        ValueError: There are too few photos or groups for so many folds.

    Examples:
        >>> from skyline_viz.datasets.item import LoadedItem
        >>> items = [LoadedItem(name, None) for name in ("a1", "a2", "b1", "c1")]
        >>> deal(items)
        {'a1': 0, 'a2': 1, 'b1': 0, 'c1': 1}
        >>> deal(items, 2, grouped(items, "[a-z]"))
        {'a1': 0, 'a2': 0, 'b1': 1, 'c1': 1}
    """
    names = sorted(item.name for item in listed(items))
    together: dict[str, list[str]] = {}
    for place, name in enumerate(names):
        together.setdefault(f"{place}" if groups is None else groups[name], []).append(name)
    if not 2 <= folds <= len(together):
        of_them = "photos" if groups is None else f"groups of the {len(names)} photos"
        raise ValueError(f"folds is a number from 2 to the {len(together)} {of_them}, not {folds}")
    sizes, dealt = [0] * folds, {}
    for members in together.values():
        fold = sizes.index(min(sizes))
        sizes[fold] += len(members)
        dealt.update(dict.fromkeys(members, fold))
    return {name: dealt[name] for name in names}


def grouped(items: Iterable[Item], by: str) -> dict[str, str]:
    """The group of each photo by its name.

    Args:
        items: The photos.
        by: ``folder`` for the folder that a photo lies in; ``near`` for photos that are nearly the
            same, resized and compressed copies and neighbouring frames among them; or a regular
            expression: what it finds in the names, or what its first group does. ``clip[0-9]+``
            keeps ``clip07-001`` and ``clip07-002`` together. A name without it is a group.

    Raises:
        ValueError: It is no regular expression, or finds nothing in any name.
    """
    found = listed(items)
    if by == "folder":
        return {item.name: _folder(item) for item in found}
    if by == "near":
        return kept_together(found)
    try:
        pattern = re.compile(by)
    except re.error as error:
        raise ValueError(f"{by} is no pattern for names: {error}") from error
    hits = {item.name: pattern.search(item.name) for item in found}
    if not any(hits.values()):
        raise ValueError(
            f"{by} is in no name of a photo; groups are folder, near or a pattern for names, "
            f"such as clip[0-9]+"
        )
    return {
        name: f"={name}" if hit is None else hit[1 if pattern.groups and hit[1] else 0]
        for name, hit in hits.items()
    }


def fingerprints(items: Iterable[Item], *, workers: int = 1) -> dict[str, str]:
    """The fingerprint of each photo by its name; photos that cannot be read have none.

    Args:
        items: The photos.
        workers: Number of processes, see `batch.run`.
    """
    found = listed(items)
    outcomes = run(_fingerprint, found, workers=workers, title="comparing photos")
    return {
        item.name: one
        for item, one in zip(found, outcomes, strict=True)
        if not isinstance(one, Failure)
    }


def kept_together(
    items: Iterable[Item], groups: Mapping[str, str] | None = None, *, workers: int = 1
) -> dict[str, str]:
    """The group of each photo by its name, where those that are nearly the same are in one.

    Resized and compressed copies are nearly the same, and so are frames of a clip, by their names:
    see `system.fingerprints`. Groups that have such photos in common are one group.

    Args:
        items: The photos.
        groups: What stays together besides, see `grouped`.
        workers: Number of processes, see `batch.run`.
    """
    found = listed(items)
    prints = fingerprints(found, workers=workers)
    near = dict(zip(prints, near_groups([*prints.values()]), strict=True))
    joined = {item.name: item.name for item in found}
    for ways in (near, groups or {}):
        first: dict[object, str] = {}
        for name, group in ways.items():
            one, other = joined[first.setdefault(group, name)], joined[name]
            if one != other:
                joined = {each: one if of == other else of for each, of in joined.items()}
    return joined


def groups_for(
    items: Iterable[Item],
    folds: int,
    groups: Mapping[str, str] | None = None,
    *,
    workers: int = 1,
) -> Mapping[str, str] | None:
    """Groups to deal into folds: those of `kept_together`, if there are enough of them.

    A data set of copies has too few. Its folds are then dealt as was asked, and the results say
    that photos were seen in training.

    Args:
        items: The photos.
        folds: Number of folds.
        groups: What stays together besides, see `grouped`.
        workers: Number of processes, see `batch.run`.

    Returns:
        The group of each photo by its name; None where each is one of its own.
    """
    found = listed(items)
    near = kept_together(found, groups, workers=workers)
    number = len(set(near.values()))
    if number < folds or (groups is None and number == len(found)):
        return groups
    return near


def read_split(path: str | os.PathLike[str], items: Sequence[Item]) -> dict[str, int]:
    """The fold of each photo as a file says that `write_split` or somebody else wrote.

    It is CSV with the columns ``name`` and ``fold``; folds may be numbers or words, such as
    ``train`` and ``test``. Photos that are not in it are left out.

    Args:
        path: The file.
        items: The photos.

    Returns:
        The fold of each photo that is in the file, from 0 on, in the order of the folds' names.

    Raises:
        ValueError: It is no such file, names a photo twice, or has fewer than two folds.
    """
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
        rows = list(csv.reader(io.StringIO(text)))
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise ValueError(f"{path} cannot be read: {reason}") from error
    except (ValueError, csv.Error) as error:
        raise ValueError(f"{path} is no CSV of names and folds: {error}") from error
    if not rows or rows[0][:2] != _HEADER:
        raise ValueError(f"{path} is no list of name and fold: its first line is not name,fold")
    known, told = {item.name for item in items}, {}
    for row in filter(None, rows[1:]):
        if len(row) < 2:
            raise ValueError(f"{path} has no fold for {row[0]}")
        if row[0] in told:
            raise ValueError(f"{path} names {row[0]} twice")
        told[row[0]] = row[1].strip()
    told = {name: fold for name, fold in told.items() if name in known}
    folds = sorted(set(told.values()), key=_in_order)
    if len(folds) < 2:
        raise ValueError(
            f"{path} puts the photos into {len(folds)} folds, and there are two at least"
        )
    return {name: folds.index(fold) for name, fold in sorted(told.items())}


def write_split(path: str | os.PathLike[str], folds: Mapping[str, int]) -> None:
    """Write the fold of each photo, whole or not at all."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows([_HEADER, *([name, str(fold)] for name, fold in folds.items())])
    write_text(path, text.getvalue())


def _in_order(fold: str) -> tuple[bool, int, str]:
    """Numbers by their size, words by their letters."""
    number = fold.isdecimal()
    return not number, int(fold) if number else 0, fold


def _fingerprint(item: Item) -> str:
    return fingerprint(item.photo(), item.name)


def _folder(item: Item) -> str:
    if isinstance(item, DatasetItem):
        return str(item.photo_path.parent)
    return item.name.rpartition("/")[0]
