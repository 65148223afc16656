"""The picture that a scene is drawn into, and the shapes that are drawn flat."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.rendering.filters import mix
from skyline_viz.rendering.terrain import Frame, Terrain, project

Substance: TypeAlias = Literal["terrain", "air", "thing"]
"""Terrain, with all that is rooted in it; air, clouds and lights; things that hide both."""


@dataclass(frozen=True)
class Picture:
    """Linear light, and what each pixel shows; drawn into in place, from far to near."""

    frame: Frame
    photo: F32
    """``(H, W, 3)`` linear light."""

    cover: F32
    """``(H, W)`` share of the pixel that is terrain, 0 to 1, also behind what hides it."""

    hidden: F32
    """``(H, W)`` how much of it is hidden, 0 to 1, by what is neither sky nor terrain."""

    @classmethod
    def of(cls, frame: Frame, photo: F32) -> "Picture":
        """A picture of sky alone."""
        empty: F32 = np.zeros((frame.height, frame.width), np.float32)
        return cls(frame, photo, empty, empty.copy())

    def ground(self, terrain: Terrain) -> None:
        """Draw terrain that hides what is behind it."""
        outline = project(terrain, self.photo)
        ends = np.arange(1, self.frame.height + 1).astype(np.float32)[:, None]
        self.note(np.clip(ends - outline, 0, 1), "terrain")

    def note(self, share: F32, substance: Substance) -> None:
        """Remember ``(H, W)`` `share` of a substance that has been drawn over the picture."""
        if substance == "terrain":
            self.cover[:] = np.maximum(self.cover, share)
            self.hidden[:] = self.hidden * (1 - share)
        else:
            self.hidden[:] = np.maximum(self.hidden, share)

    def paint(self, share: F32, colour: F32, substance: Substance) -> None:
        """Draw ``(H, W)`` `share` of `colour`, ``(3,)`` or ``(H, W, 3)``, over it."""
        self.photo[:] = mix(self.photo, colour, share[..., None])
        self.note(share, substance)

    def line(self) -> F32:
        """``(W,)`` row of the first pixel of each column that is at least half terrain; H: none."""
        terrain = self.cover >= np.float32(0.5)
        rows = np.where(terrain.any(axis=0), terrain.argmax(axis=0), self.frame.height)
        return rows.astype(np.float32)

    def window(self, left: float, top: float, right: float, bottom: float) -> "Window":
        """The piece between these edges, in reference pixels, as far as it is in the picture."""
        unit = self.frame.unit
        columns = slice(max(0, round(left * unit)), max(0, round(right * unit)))
        rows = slice(max(0, round(top * unit)), max(0, round(bottom * unit)))
        x = ((np.arange(self.frame.width) + 0.5) / unit).astype(np.float32)[None, columns]
        y = ((np.arange(self.frame.height) + 0.5) / unit).astype(np.float32)[rows, None]
        part = Frame(x.size, y.size)
        pieces = (field[rows, columns] for field in (self.photo, self.cover, self.hidden))
        return Window(Picture(part, *pieces), x, y, unit)

    def everywhere(self) -> "Window":
        """All of it."""
        return self.window(0, 0, self.frame.across + 1, self.frame.down + 1)

    def root(self, x: float, base: float) -> float:
        """`base`, in reference pixels downwards, or what is below it and stands on terrain."""
        column = min(max(round(x * self.frame.unit), 0), self.frame.width - 1)
        terrain = self.cover[:, column] >= np.float32(0.5)
        row = int(terrain.argmax()) if terrain.any() else self.frame.height
        return max(base, (row + 1.5) / self.frame.unit + 0.02 * self.frame.down)


@dataclass(frozen=True)
class Window:
    """A piece of a picture, and where it is."""

    picture: Picture
    x: F32
    """``(1, w)`` middles of the pixels, to the right, in reference pixels of the whole."""

    y: F32
    """``(h, 1)`` downwards."""

    unit: float
    """Pixels in a reference pixel."""

    @property
    def empty(self) -> bool:
        """Whether it has no pixels."""
        return self.x.size == 0 or self.y.size == 0

    def share(self, depth: F32) -> F32:
        """Share of each pixel inside a shape, from how deep its middle lies in reference pixels."""
        share: F32 = np.clip(depth * np.float32(self.unit) + np.float32(0.5), 0, 1)
        return share

    def polygon(self, *corners: tuple[float, float]) -> F32:
        """Share ``(h, w)`` of each pixel in a convex polygon; corners ``(x, y)`` clockwise."""
        depth: F32 = np.full((self.y.size, self.x.size), 1e6, np.float32)
        for (x, y), (x_next, y_next) in zip(corners, corners[1:] + corners[:1], strict=True):
            across, along = x_next - x, y_next - y
            length = float(np.sqrt(across * across + along * along)) + 1e-6
            side = (self.y - y) * (across / length) - (self.x - x) * (along / length)
            depth = np.minimum(depth, side)
        return self.share(depth)

    def box(self, left: float, top: float, right: float, bottom: float) -> F32:
        """Share of each pixel in an upright rectangle; thin ones keep their area."""
        shares = []
        for place, low, high in ((self.x, left, right), (self.y, top, bottom)):
            half = np.float32(0.5 / self.unit)
            inside = np.minimum(place + half, high) - np.maximum(place - half, low)
            shares.append(np.clip(inside * np.float32(self.unit), 0, 1))
        across, along = shares
        product: F32 = across * along
        return product

    def disc(self, x: float, y: float, radius: float) -> F32:
        """Share of each pixel in a disc."""
        off = (self.x - np.float32(x)) * (self.x - np.float32(x))
        lift = (self.y - np.float32(y)) * (self.y - np.float32(y))
        return self.share(np.float32(radius) - np.sqrt(off + lift))

    def limb(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        radii: tuple[float, float],
    ) -> F32:
        """Share of each pixel in a rounded rod, of one radius at its start, another at its end."""
        across, along = end[0] - start[0], end[1] - start[1]
        length = across * across + along * along + 1e-6
        x, y = self.x - np.float32(start[0]), self.y - np.float32(start[1])
        part = np.clip(x * np.float32(across / length) + y * np.float32(along / length), 0, 1)
        off, lift = x - part * np.float32(across), y - part * np.float32(along)
        radius = np.float32(radii[0]) + part * np.float32(radii[1] - radii[0])
        return self.share(radius - np.sqrt(off * off + lift * lift))
