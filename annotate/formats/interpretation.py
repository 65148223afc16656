"""From what was drawn on photos to their skylines."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from annotate.formats.common import Imported, size_of
from annotate.formats.documents import misread
from annotate.formats.drawings import Drawing, Shape, Wanted, labels_found
from annotate.formats.importing import Found
from annotate.formats.photo_names import PhotoNames
from annotate.formats.rivals import refuse_rivals
from skyline_viz.datasets.outlines import FormatError, line_rows, own_rows, polygon_mask
from skyline_viz.datasets.sky_region import line_of
from skyline_viz.skyline import Skyline, SkylineError, fill
from skyline_viz.system.names import listed


def interpret(
    drawings: Sequence[Drawing], wanted: Wanted, names: PhotoNames, photos: Path, found: Found
) -> None:
    """Make a label of all that was drawn on each photo.

    Args:
        drawings: What was drawn; several drawings of a photo are one.
        wanted: Which labels count.
        names: The photos.
        photos: Their folder.
        found: Gets the labels, and what is wrong.
    """
    useful = [one for one in drawings if any(wanted.takes(shape) for shape in one.shapes)]
    others = [one for one in drawings if one.shapes and one not in useful]
    matched = names.of_references(name for one in drawings for name in one.names)
    for sentence in matched.unclear:
        found.problem(sentence)
    unclear = {name for one in drawings for name in one.names} - {*matched.photos, *matched.unknown}
    of_photo: dict[str, list[Drawing]] = {}
    lost = []
    for one in useful:
        photo = next((matched.photos[name] for name in one.names if name in matched.photos), None)
        if photo is not None:
            of_photo.setdefault(photo, []).append(one)
        elif not unclear & set(one.names):
            lost.append(one.names[0] if one.names else "(no name)")
    for photo, together in of_photo.items():
        _add(photo, together, wanted, photos, found)
    if not of_photo:
        _explain(drawings, useful, wanted, names, found)
        return
    for name in lost:
        found.note("labels belong to no photo of the folder", name)
    for one in drawings:
        if one.tags and not one.shapes:  # as of a photo in which nothing is visible
            name = one.names[0] if one.names else "(no name)"
            found.note("left out, with tags but without a line or a region", name)
    if others:
        told = labels_found(shape for one in others for shape in one.shapes)
        for one in others:
            name = one.names[0] if one.names else "(no name)"
            found.note(f"left out, with {told} but without {wanted.said}", name)


def _add(
    photo: str, drawings: Iterable[Drawing], wanted: Wanted, photos: Path, found: Found
) -> None:
    drawings = list(drawings)
    try:
        height, width = size_of(photo, photos)
        for one in drawings:
            if one.size is not None and one.size != (height, width):
                _refuse_size(photo, (height, width), one.size)
        shapes = [shape for one in drawings for shape in one.shapes]
        skyline = _skyline(
            photo, shapes, wanted, height, width, found, whole=any(one.whole for one in drawings)
        )
    except (FormatError, SkylineError) as error:
        text = str(error).rstrip(".")
        between = " " if text.startswith("has ") else ": "
        found.problem(f"{text}." if text.startswith(photo) else f"{photo}{between}{text}.")
        return
    tags = dict.fromkeys(tag for one in drawings for tag in one.tags)
    found.labels.append(Imported(photo, skyline, tuple(tags)))


def _refuse_size(photo: str, size: tuple[int, int], told: tuple[int, int]) -> None:
    turned = ", as if it were turned" if told == size[::-1] else ""
    raise FormatError(
        f"{photo} has {size[1]}x{size[0]} pixels, its label is for {told[1]}x{told[0]}{turned}"
    )


def _skyline(
    photo: str,
    shapes: list[Shape],
    wanted: Wanted,
    height: int,
    width: int,
    found: Found,
    *,
    whole: bool,
) -> Skyline:
    lines = [one for one in shapes if wanted.is_line(one)]
    skies = [one for one in shapes if wanted.is_sky(one)]
    terrains = [one for one in shapes if wanted.is_terrain(one)]
    if lines:
        rings = [ring for one in lines for ring in one.rings]
        rows, visible = line_rows(rings, height, width)
        refuse_rivals(own_rows(ring, width) for ring in rings)
        if skies or terrains:
            found.note("where there is a line, regions were left out", photo)
    elif terrains:
        region, _ = _union(terrains, height, width)
        visible = np.asarray(region.any(axis=0))
        rows = region.argmax(axis=0).astype(np.float64)
    else:
        region, visible = _union(skies, height, width)
        others = [one for one in shapes if one.kind in ("polygon", "mask") and one not in skies]
        line, visible = _below_sky(photo, region, visible | whole, others, found)
        rows = line.astype(np.float64)
    if not visible.any():
        raise FormatError("no column of it is labelled")
    if not visible.all():
        ends = np.flatnonzero(visible)[[0, -1]]
        hidden = np.flatnonzero(~visible)
        if hidden[0] < ends[0] or hidden[-1] > ends[1]:
            found.note(
                "labels do not reach the sides of the photo, and are not visible there", photo
            )
    filled = fill(rows, visible) if not visible.all() else rows.astype(np.float32)
    return Skyline(np.floor(filled + 0.5), visible)


def _union(
    shapes: Iterable[Shape], height: int, width: int
) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
    """The pixels of all shapes, and the columns that they reach."""
    region: npt.NDArray[np.bool_] = np.zeros((height, width), np.bool_)
    reached: npt.NDArray[np.bool_] = np.zeros(width, np.bool_)
    for shape in shapes:
        if shape.runs is not None:
            region |= shape.runs.mask(height, width)
        else:
            inside, there = polygon_mask(shape.rings, height, width)
            region |= inside
            reached |= there
    return region, reached | region.any(axis=0)


def _below_sky(
    photo: str,
    sky: npt.NDArray[np.bool_],
    visible: npt.NDArray[np.bool_],
    others: list[Shape],
    found: Found,
) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.bool_]]:
    """Rows where the sky ends that begins at the top, or a little below it as drawn by hand.

    What is above the sky is sky, unless something else was drawn there.
    """
    height = len(sky)
    begins = np.where(sky.any(axis=0), sky.argmax(axis=0), 0)
    filled = sky | (np.arange(height)[:, None] < begins)
    deep = begins > max(3, 0.01 * height)
    if deep.any():
        above, _ = _union(others, *sky.shape)
        covered = deep & (above & ~sky & (np.arange(height)[:, None] < begins)).any(axis=0)
        if covered.any():
            found.note("columns with something else above the sky are not visible", photo)
        if (deep & ~covered).any():
            found.note(
                "what is above the region of sky counts as sky, though it is more than a few rows",
                photo,
            )
        visible = visible & ~covered
    line = line_of(filled)
    for note in line.notes:
        found.note(note, photo)
    return line.skyline.rows, visible


def _explain(
    drawings: Sequence[Drawing],
    useful: Sequence[Drawing],
    wanted: Wanted,
    names: PhotoNames,
    found: Found,
) -> None:
    """Say what there is instead, where nothing can be imported."""
    if not drawings:
        return
    shapes = [shape for one in drawings for shape in one.shapes]
    sentence = f"found labels: {labels_found(shapes)}"
    if not useful:
        sentence += f"; looked for {wanted.said}: name yours with --label, --sky or --terrain"
    else:
        there = [one.names[0] if one.names else "(no name)" for one in useful]
        sentence += (
            f"; its photos {listed(there, 4)} are not in the folder, "
            f"which holds {listed(names.names, 4)}"
        )
        if others := [text for one in there if (text := misread(one))]:
            sentence += (
                f"; if the file is in the encoding GB2312 and not in UTF-8, they are "
                f"{listed(others, 4)}: save it as UTF-8"
            )
    found.problem(f"{sentence}.")
