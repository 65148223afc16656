"""What a label picture tells apart: grey levels, palette colours, colours, transparency.

People name a class as the file shows it: ``0``, ``#4682b4``, ``steelblue``, ``transparent``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import ImageColor

from skyline_viz.arrays import U8, Bool, in_colour
from skyline_viz.datasets.label_picture import LabelPicture, numbered
from skyline_viz.skyline import SkylineError

_MOST = 64
"""A label picture with more classes than that is a photograph."""

_SAME = 16
"""Largest difference of a channel that JPEG makes within a region."""

_FLAT = 6
"""So many pixels that lie inside one value are a class, however small a share of the picture."""

_KEY = np.array([65536, 256, 1], np.int32)
"""Makes one number of a colour."""

_NEAR = 40
"""Largest difference of a channel between a colour and the class that it belongs to."""


@dataclass(frozen=True)
class Class:
    """One of the things that a picture tells apart."""

    shown: str
    """What it is called, and a value by which it can be asked for."""

    low: float = 1.0
    high: float = 0.0
    """Grey levels, or the palette index, that it stands for; none where `low` is above `high`."""

    colour: tuple[int, int, int] | None = None
    """Its colour."""

    exact: bool = True
    """Whether it is of this very colour, and not of all that are near."""

    def is_meant_by(self, value: str) -> bool:
        """Whether somebody who says `value` means this class."""
        said = value.strip().lower()
        if said == self.shown:
            return True
        try:
            return self.low <= float(said) <= self.high
        except ValueError:
            pass
        try:
            wanted = ImageColor.getrgb(said)[:3]
        except ValueError:
            return False
        if self.colour is None:
            return len(set(wanted)) == 1 and self.low <= wanted[0] <= self.high
        apart = max(abs(a - b) for a, b in zip(wanted, self.colour, strict=True))
        return apart <= (0 if self.exact else _NEAR)


@dataclass(frozen=True)
class Classes:
    """A picture as regions."""

    regions: U8
    """``(H, W)`` number of the class of each pixel."""

    found: tuple[Class, ...]
    """The classes, by number; there is at least one pixel of each."""

    kind: str
    """What the classes are: grey levels, palette colours, colours."""

    soft: bool = False
    """Whether two grey classes are the two sides of a cut."""

    @property
    def said(self) -> str:
        """The classes with their shares, the largest first, in words."""
        counts = np.bincount(self.regions.ravel(), minlength=len(self.found))
        order = np.argsort(-counts, kind="stable")[:8].tolist()
        parts = [
            f"{self.found[one].shown} ({_percent(counts[one] / self.regions.size)})"
            for one in order
        ]
        if (more := len(self.found) - len(order)) > 0:
            parts.append(f"{more} more")
        return (
            f"the {self.kind} {' and '.join([', '.join(parts[:-1]), parts[-1]])}" * (len(parts) > 1)
            or f"nothing but {parts[0]}"
        )

    def region(self, values: str) -> Bool:
        """Where the classes lie that `values` names, separated by commas.

        Raises:
            SkylineError: There is no such class.
        """
        chosen: Bool = np.zeros(len(self.found), np.bool_)
        for value in values.split(","):
            hits = [one.is_meant_by(value) for one in self.found]
            if not any(hits):
                raise SkylineError(f"there is no {value.strip()} in it; it holds {self.said}")
            chosen |= np.array(hits)
        return chosen[self.regions]


def classes_of(picture: LabelPicture) -> Classes | None:
    """Tell the classes of a picture apart; None for a photograph.

    Raises:
        SkylineError: It is grey, and neither of few levels nor dark and bright.
    """
    grey = picture.grey
    few = picture.counts is not None and len(picture.counts) <= 2
    if picture.palette is not None and picture.counts and len(picture.counts) <= _MOST:
        classes: Classes | None = None
        if grey is not None and not few:
            classes = _levels(grey, None)
        if classes is None or not classes.soft:
            classes = _indices(picture)
    elif grey is not None and not (few and picture.values.ndim == 3 and not _is_grey(picture)):
        direct = grey is picture.values
        classes = _levels(grey, picture.counts if direct else None)
    else:
        classes = _colours(picture)
    if picture.opaque is None:
        return classes
    return _with_transparency(classes, picture.opaque)


def _with_transparency(classes: Classes | None, opaque: Bool) -> Classes:
    """Let what cannot be seen be a class of its own, whatever its colour is."""
    if classes is None:  # a photo that was cut out
        found = (Class("transparent"), Class("opaque"))
        return Classes(opaque.astype(np.uint8), found, "parts")
    seen = np.unique(classes.regions[opaque]).tolist()
    numbers = np.zeros(256, np.uint8)
    numbers[seen] = np.arange(1, len(seen) + 1)
    kept = [classes.found[one] for one in seen]
    if len(kept) == 1:
        kept = [Class("opaque", kept[0].low, kept[0].high, kept[0].colour, kept[0].exact)]
    found = (Class("transparent"), *kept)
    return Classes(np.where(opaque, numbers[classes.regions], 0), found, classes.kind)


def _levels(grey: npt.NDArray[Any], counts: dict[Any, int] | None) -> Classes:
    """Classes of grey levels: each level where they are few, else what is dark and what is bright.

    Raises:
        SkylineError: There are many levels, and all are dark, or all are bright.
    """
    values = np.unique(grey) if counts is None else np.array(sorted(counts))
    low, high = values[0].item(), values[-1].item()
    cut = _cut(grey.dtype, high)
    plain = len(values) <= 2
    if not plain and (cut is None or not low < cut <= high):
        flat = sum(_flat_sums(grey).values())
        if len(values) > _MOST or (cut is not None and flat < 0.3 * grey.size):
            raise SkylineError(
                f"its brightest value is {high:g}, its darkest {low:g}, "
                f"and in a mask terrain is 255 and sky 0"
            )
        plain = True
    if not plain and cut is not None and not _has_plateau(grey, values):
        if not _is_soft_mask(grey):
            raise SkylineError("it is grey, and neither painted nor a mask of few levels")
        found = (_between(low, cut, cut), _between(cut, high, cut))
        return Classes((grey >= cut).astype(np.uint8), found, "grey levels", soft=True)
    if len(values) > _MOST:
        raise SkylineError("it is grey, and neither painted nor a mask of few levels")
    numbers = numbered(grey, values)
    single = tuple(Class(f"{value:g}", value, value) for value in values.tolist())
    return Classes(numbers, single, "grey levels")


def _between(low: float, high: float, cut: float) -> Class:
    """A class of grey levels on one side of a cut; named by the end that is far from it."""
    return Class(f"{low if high == cut else high:g}", low, high - 1e-9 if high == cut else high)


def _cut(kind: np.dtype[Any], high: float) -> float | None:
    """Where dark ends and bright begins; None where the scale of the values is not known."""
    if kind.kind == "f" and high <= 1:
        return 0.5
    if high <= 255:
        return 128
    return 32768 if high >= 32768 and kind.kind != "f" else None


def _has_plateau(grey: npt.NDArray[Any], values: npt.NDArray[Any]) -> bool:
    """Whether a grey between the darkest and the brightest fills a region, as a third class does.

    A soft edge goes through all of them alike, and through each in a few rows. A mast or a rim
    may have few pixels: it is told by being flat, and thicker than an edge.
    """
    low, high = float(values[0]), float(values[-1])
    if len(values) <= _MOST:
        numbers = np.searchsorted(values, grey)
        shares = np.bincount(numbers.ravel())[1:-1] / numbers.size
        if _is_region(numbers == 1 + np.argmax(shares)):
            return True
    if _has_flat_step(grey, low, high):
        return True
    steps = np.clip((grey.astype(np.float32) - low) * (16 / (high - low)), 0, 15).astype(np.uint8)
    shares = np.bincount(steps.ravel(), minlength=16)[1:15] / steps.size
    return bool(shares.max() > 5 * np.median(shares)) and _is_region(steps == 1 + shares.argmax())


def _has_flat_step(grey: npt.NDArray[Any], low: float, high: float) -> bool:
    """Whether one of the middle greys, and not each of them, has places that are flat."""
    import cv2  # noqa: PLC0415  # not needed for help

    scaled = ((grey.astype(np.float32) - low) * (256 / (high - low))).clip(0, 255).astype(np.uint8)
    middle = (scaled >= 2 * _SAME) & (scaled < 256 - 2 * _SAME)
    if np.count_nonzero(middle) < _FLAT:
        return False
    around = np.ones((3, 3), np.uint8)
    apart = cv2.dilate(scaled, around) - cv2.erode(scaled, around)
    sums = np.bincount(scaled[apart <= _SAME // 2] // 16, minlength=16)
    usual = 5 * np.median(sums[2:14])
    return any(  # a peak: from the ends of a slow edge the sums only fall
        sums[step] >= max(_FLAT, usual + 1)
        and sums[step] > 2 * max(sums[max(1, step - 2)], sums[min(14, step + 2)])
        for step in range(2, 14)
    )


def _flat_sums(keys: npt.NDArray[Any]) -> dict[Any, int]:
    """How many pixels of each value have nothing but it around them: edges have none."""
    alike = keys[1:] == keys[:-1]
    across = keys[:, 1:] == keys[:, :-1]
    tall, wide = alike[1:] & alike[:-1], across[:, 1:] & across[:, :-1]
    flat = tall[:, 1:-1] & wide[1:-1] & wide[:-2] & wide[2:]
    found, sums = np.unique(keys[1:-1, 1:-1][flat], return_counts=True)
    return dict(zip(found.tolist(), sums.tolist(), strict=True))


def _is_region(inside: Bool) -> bool:
    """Whether pixels are more than those of an edge."""
    runs = inside[:-3] & inside[1:-2] & inside[2:-1] & inside[3:]
    return bool(inside.mean() >= 0.02 and runs.sum() > 0.5 * inside.sum())


def _is_soft_mask(grey: npt.NDArray[Any]) -> bool:
    """Whether most pixels are as dark or as bright as any, and not of all greys as in a photo."""
    sample = grey[:: max(1, len(grey) // 500)].astype(np.float32)
    low, high = np.percentile(sample, [1, 99])
    near = max(0.08 * float(high - low), 1e-6)
    return bool(((sample <= low + near) | (sample >= high - near)).mean() > 0.6)


def _is_grey(picture: LabelPicture) -> bool:
    """Whether the few colours of a picture are greys."""
    return all(len(set(colour)) == 1 for colour in picture.counts or ())


def _indices(picture: LabelPicture) -> Classes:
    """A class for each palette index."""
    assert picture.counts is not None
    assert picture.palette is not None
    numbers = np.zeros(256, np.uint8)
    used = sorted(picture.counts)
    numbers[used] = np.arange(len(used))
    hexes = [_hex(picture.palette[one]) for one in used]
    found = tuple(
        Class(
            name if hexes.count(name) == 1 else str(index),
            index,
            index,
            _triple(picture.palette[index]),
        )
        for index, name in zip(used, hexes, strict=True)
    )
    return Classes(numbers[picture.values], found, "palette colours")


def _colours(picture: LabelPicture) -> Classes | None:
    """A class for each main colour; what is mixed at an edge goes to the nearest one."""
    colours = picture.colours
    fine = picture.counts is not None and picture.palette is None
    centres = _few(picture) if fine else _clusters(colours)
    if centres is None:
        return None
    if fine and picture.counts is not None:
        told = np.array(sorted(picture.counts), np.int64)
        keys = told @ _KEY
        number = _nearest(told, centres)[0].astype(np.uint8)
        places = np.searchsorted(keys, colours.astype(np.int32) @ _KEY)
        regions = number[places]
    else:
        regions, near = _quantised(colours, centres)
        if near < 0.85:
            return None
    exact = len(picture.counts or ()) == len(centres)
    present = np.unique(regions)
    if len(present) < len(centres):
        regions = np.searchsorted(present, regions).astype(np.uint8)
    found = tuple(Class(_hex(one), colour=_triple(one), exact=exact) for one in centres[present])
    return Classes(regions, found, "colours")


def _few(picture: LabelPicture) -> npt.NDArray[np.int64] | None:
    """Main colours of a picture whose colours could be counted; None where they are no classes."""
    assert picture.counts is not None
    counts = picture.counts
    total = sum(counts.values())
    least = 0.005 * total if len(counts) > 16 else 1
    flat = _flat_sums(picture.colours.astype(np.int32) @ _KEY)
    inside = {one: flat.get(int(np.array(one) @ _KEY), 0) for one in counts}
    main = [one for one, count in counts.items() if count >= least or inside[one] >= _FLAT]
    if len(counts) <= 2 or not main:
        main = list(counts)
    elif 2 < len(main) <= _MOST:
        main = [one for one in main if inside[one] >= _FLAT or not _is_mixed(one, main, picture)]
    if len(main) > _MOST or sum(counts[one] for one in main) < 0.9 * total:
        return None
    return np.array(sorted(main), np.int64)


def _is_mixed(
    colour: tuple[int, int, int], main: list[tuple[int, int, int]], picture: LabelPicture
) -> bool:
    """Whether a colour is that of an edge: a blend of two others, and nowhere a region."""
    told = np.array(main, np.float64)
    sums = {one: (picture.counts or {})[one] for one in main}
    larger = told[[sums[one] > 2 * sums[colour] for one in main]]
    for place, first in enumerate(larger):
        for second in larger[place + 1 :]:
            along = second - first
            share = float((np.array(colour) - first) @ along / (along @ along))
            off = np.abs(first + share * along - colour).max()
            if 0 < share < 1 and off <= 4:
                return not _is_region(in_colour(picture.values, colour))
    return False


def _clusters(colours: U8) -> npt.NDArray[np.int64] | None:
    """Centres of the main colours of a picture with many, as JPEG leaves them."""
    cells = _cells(colours, 4)
    counts = np.bincount(cells.ravel(), minlength=4096)
    centres: list[npt.NDArray[np.int64]] = []
    for cell in np.argsort(-counts).tolist():
        if counts[cell] < 0.01 * cells.size or len(centres) > _MOST:
            break
        middle = colours[cells == cell].mean(axis=0).astype(np.int64)
        if all(np.abs(middle - one).max() > 2 * _NEAR for one in centres):
            centres.append(middle)
    return np.array(centres) if centres else None


def _quantised(colours: U8, centres: npt.NDArray[np.int64]) -> tuple[U8, float]:
    """The nearest centre of each pixel, and the share of pixels that are of its colour.

    In a mask that was saved as JPEG these are nearly all; in a photo they are few.
    """
    steps = np.arange(32) * 8 + 4
    grid = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    number, apart = _nearest(grid, centres)
    cells = _cells(colours, 5)
    return number.astype(np.uint8)[cells], float((apart <= _SAME)[cells].mean())


def _cells(colours: U8, bits: int) -> npt.NDArray[np.int32]:
    high = (colours >> (8 - bits)).astype(np.int32)
    return (high[:, :, 0] << 2 * bits) | (high[:, :, 1] << bits) | high[:, :, 2]


def _nearest(
    colours: npt.NDArray[np.int64], centres: npt.NDArray[np.int64]
) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.int64]]:
    apart = np.abs(colours[:, None] - centres[None]).max(axis=2)
    return apart.argmin(axis=1), apart.min(axis=1)


def _triple(colour: npt.NDArray[Any]) -> tuple[int, int, int]:
    red, green, blue = (int(one) for one in colour)
    return red, green, blue


def _hex(colour: npt.NDArray[Any]) -> str:
    return "#{:02x}{:02x}{:02x}".format(*_triple(colour))


def _percent(share: float) -> str:
    return f"{100 * share:.0f} %" if share >= 0.01 else "under 1 %"
