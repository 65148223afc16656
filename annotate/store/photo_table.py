"""The table of photos: what the store knows of each, and what it learns when it looks again."""

from __future__ import annotations

import sqlite3
from collections.abc import Sequence

from annotate.store.identity import Found, Known, Photo, Stamp, changed_files

_LABELLED = (
    "EXISTS (SELECT 1 FROM labels JOIN operations ON operations.label = labels.id"
    " WHERE labels.photo = photos.id AND kind != 'open')"
)
_WORKED_ON = "EXISTS (SELECT 1 FROM operations WHERE label = labels.id AND kind != 'open')"
_PHOTO = "photos.id, name, photos.digest, width, height, pixels"


def every_photo(database: sqlite3.Connection) -> list[Photo]:
    """Every photo that was ever seen."""
    return [Photo(*row) for row in database.execute(f"SELECT {_PHOTO} FROM photos")]  # noqa: S608


def photo_of(database: sqlite3.Connection, photo: int) -> Photo:
    """A photo by its id."""
    return Photo(
        *database.execute(f"SELECT {_PHOTO} FROM photos WHERE id = ?", (photo,)).fetchone()  # noqa: S608
    )


def known_photos(database: sqlite3.Connection) -> list[Known]:
    """Every photo that was ever seen, with what tells whether its file has changed."""
    rows = database.execute(f"SELECT size, changed, touched, {_LABELLED}, {_PHOTO} FROM photos")  # noqa: S608
    return [
        Known(Photo(*photo), size, changed, touched, bool(labelled))
        for size, changed, touched, labelled, *photo in rows
    ]


def is_news(found: Sequence[Found], known: Sequence[Known]) -> bool:
    """Whether there is anything to keep of the photos that are in the folder."""
    here = {one.digest for one in found}
    if any(one.labelled and one.photo.digest not in here for one in known):
        return True
    before = {one.photo.digest: one for one in known}
    for one in found:
        old = before.get(one.digest)
        if old is None or (old.size, old.changed, old.touched) != _stamp(one.stamp):
            return True
        photo = old.photo
        if (photo.name, photo.width, photo.height) != (one.name, one.width, one.height):
            return True
        if photo.pixels != one.pixels:
            return True
    return False


def keep_found(
    database: sqlite3.Connection, found: Sequence[Found], known: Sequence[Known]
) -> None:
    """Keep which photos are in the folder.

    Photos whose file has other bytes now, but the same pixels, keep their labels.
    """
    changed = changed_files(found, known)
    for photo, one in changed.items():
        keep_file(database, photo, one.digest, one.pixels, one.stamp, one.name)
    taken = {one.digest for one in changed.values()}
    database.executemany(
        "INSERT INTO photos (digest, name, width, height, size, changed, touched, pixels)"
        " VALUES (?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT (digest) DO UPDATE SET"
        " name = excluded.name, width = excluded.width, height = excluded.height,"
        " size = excluded.size, changed = excluded.changed, touched = excluded.touched,"
        " pixels = coalesce(excluded.pixels, pixels)",
        [
            (
                one.digest,
                one.name,
                one.width,
                one.height,
                *_stamp(one.stamp),
                one.pixels,
            )
            for one in found
            if one.digest not in taken
        ],
    )
    _follow(database, {one.digest: one.pixels for one in found if one.pixels})


def keep_file(
    database: sqlite3.Connection,
    photo: int,
    digest: str,
    pixels: str | None,
    stamp: Stamp,
    name: str,
) -> None:
    """Keep what the file of a photo is now; nothing is done where it is that of another photo."""
    database.execute(
        "UPDATE OR IGNORE photos SET digest = ?, pixels = ?, size = ?, changed = ?, touched = ?,"
        " name = ? WHERE id = ?",
        (digest, pixels, *_stamp(stamp), name, photo),
    )


def _follow(database: sqlite3.Connection, here: dict[str, str]) -> None:
    """Give labels whose photo has gone to a photo that is here and has the same pixels.

    Args:
        database: The labels.
        here: Pixels of the photos that are here, by the digests of their files.
    """
    photos: dict[str, int] = {}
    lost: list[tuple[int, str]] = []
    for one in known_photos(database):
        if one.photo.digest in here:
            photos.setdefault(here[one.photo.digest], one.photo.id)
        elif one.labelled and one.photo.pixels:
            lost.append((one.photo.id, one.photo.pixels))
    for photo, pixels in lost:
        if pixels in photos:
            _move_labels(database, photo, photos[pixels])


def _move_labels(database: sqlite3.Connection, photo: int, target: int) -> None:
    """Give the labels of a photo to another one, but where that has been worked on in the pass."""
    for label, annotator, number in database.execute(
        "SELECT id, annotator, number FROM labels WHERE photo = ?", (photo,)
    ).fetchall():
        there = database.execute(
            f"SELECT id, {_WORKED_ON} FROM labels"  # noqa: S608
            " WHERE photo = ? AND annotator = ? AND number = ?",
            (target, annotator, number),
        ).fetchone()
        if there and there[1]:
            continue
        move = "UPDATE labels SET photo = ?, number = ? WHERE id = ?"
        if there:  # it was only looked at: the two change places
            database.execute(move, (target, -there[0], there[0]))
        database.execute(move, (target, number, label))
        if there:
            database.execute(move, (photo, number, there[0]))


def _stamp(stamp: Stamp) -> tuple[int, int, int]:
    """What is kept of a stamp: one that fits nothing where the file may still change unnoticed."""
    return stamp.size, stamp.changed, stamp.touched if stamp.settled else 0
