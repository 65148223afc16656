"""Rendered mountain scenes with exact truth, from a seed.

Height fields of several mountain ranges are lit, seen through haze, drawn over a sky and put
through a lens, film and JPEG. The topmost drawn terrain of each column is the truth.

The same seed gives the same bytes on every CPU: all arithmetic on pixels is ``+ - * /``, square
root and rounding, one array operation at a time, which IEEE 754 fixes to the last bit; there is
no ``exp``, ``sin`` or ``pow``, no matrix product and no sum of floats, whose results depend on the
CPU. Random numbers are uniform ones, made from integers. JPEG and PNG are coded by Pillow, in
integers too; another release of it may code the same pixels differently.
"""

import io
import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, TypeAlias

import numpy as np
from PIL import Image

from skyline_viz.arrays import U8, read_only
from skyline_viz.files import replacing
from skyline_viz.photo import write_photo
from skyline_viz.rendering.air import draw_air
from skyline_viz.rendering.built import Houses, Wires, draw_built
from skyline_viz.rendering.camera import Camera, any_camera
from skyline_viz.rendering.kinds import KINDS, Kind, compose
from skyline_viz.rendering.marks import bars
from skyline_viz.rendering.mountains import Range, mountain_range
from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.people import People, draw_people
from skyline_viz.rendering.picture import Picture
from skyline_viz.rendering.plain import Plain, plain
from skyline_viz.rendering.plants import Branches, Trees, draw_branches, draw_trees
from skyline_viz.rendering.sky import paint_sky
from skyline_viz.rendering.terrain import Frame
from skyline_viz.rendering.views import View
from skyline_viz.rendering.water import Water, draw_water
from skyline_viz.skyline import Skyline
from skyline_viz.system.nearest import meant

CameraChoice: TypeAlias = Literal["plain", "any"]
"""The plain camera of a kind, or any, tilted or looking up, with its own lens and film."""


@dataclass(frozen=True, eq=False)
class Scene:
    """A rendered photograph and its true skyline."""

    kind: Kind
    seed: int
    photo: U8 = field(repr=False)
    """``(H, W, 3)`` uint8 RGB: the decoded `jpeg`."""

    truth: Skyline
    """Row of the first pixel of each column that is at least half terrain.

    Trees, houses and water are terrain. Columns where the line is not in the photo, or where
    people, masts, a frame or thick cloud hide it, are not visible.
    """

    jpeg: bytes = field(repr=False)
    """The photo as a JPEG file."""

    camera: CameraChoice = "plain"

    @property
    def name(self) -> str:
        """Kind and seed, as ``clear-1``, and ``clear-1-any`` where any camera took it."""
        return f"{self.kind}-{self.seed}{'' if self.camera == 'plain' else '-any'}"


def render(
    kind: Kind, seed: int, width: int = 960, height: int = 540, *, camera: CameraChoice = "plain"
) -> Scene:
    """Render one scene.

    Args:
        kind: One of `KINDS`.
        seed: Not negative; each seed is another place and another light.
        width: Columns of the photo.
        height: Rows of the photo.
        camera: "any" takes the same place with another camera, which the seed chooses.

    Returns:
        The scene; equal arguments give equal bytes.

    Raises:
        ValueError: No such kind, a negative seed, or a side below 32 pixels.
    """
    if kind not in KINDS:
        raise ValueError(f"there is no scene {kind!r}; {meant(kind, KINDS, 'a scene is one of')}")
    if seed < 0:
        raise ValueError(f"a seed is 0 or more, not {seed}")
    if min(width, height) < 32:
        raise ValueError(f"a scene is at least 32 by 32 pixels, not {width}x{height}")
    rng = np.random.default_rng([KINDS.index(kind), seed])
    frame = Frame(width, height)
    view = compose(kind, frame, rng)
    if camera == "any":
        # Its own dice, so that it shows the very place that the plain camera shows.
        view = view.through(any_camera(np.random.default_rng([KINDS.index(kind), seed, 1])))
    picture = view.camera.take(_draw(view.camera.canvas(frame), view, rng), frame)
    jpeg = view.camera.expose(picture.photo, rng, contrast=view.contrast, grain=view.grain)
    decoded = np.array(Image.open(io.BytesIO(jpeg)).convert("RGB"))
    read_only(decoded)
    return Scene(kind, seed, decoded, _truth(picture, view.camera), jpeg, camera)


def _draw(frame: Frame, view: View, rng: np.random.Generator) -> Picture:
    sunward = 1 if view.light.sun[0] > 0 else -1
    picture = Picture.of(frame, paint_sky(frame, Noise(rng), rng, view.sky, sunward=sunward))
    for layer in view.layers:
        noise = Noise(rng)  # its own, for small photos take fewer fields from it than large ones
        match layer:
            case Range():
                picture.ground(mountain_range(frame, noise, rng, layer, view.light))
            case Plain():
                picture.ground(plain(frame, noise, layer, view.light))
            case Water():
                draw_water(picture, noise, layer, view.light)
            case Trees():
                draw_trees(picture, noise, rng, layer, view.light)
            case People():
                draw_people(picture, noise, rng, layer, view.light)
            case Branches():
                draw_branches(picture, noise, layer, view.light)
            case Houses() | Wires():
                draw_built(picture, noise, rng, layer, view.light)
            case _:
                draw_air(picture, noise, rng, layer)
    return picture


def _truth(picture: Picture, camera: Camera) -> Skyline:
    """The line in the picture, and where it can be seen."""
    height, width = picture.cover.shape
    rows = picture.line()
    inside = (rows > 0) & (rows < height)
    place = np.clip(rows, 0, height - 1).astype(np.intp), np.arange(width)
    hidden = picture.hidden > np.float32(0.8)
    hidden |= bars(camera.border, camera.margin, (height, width))
    return Skyline(rows=rows, visible=inside & ~hidden[place])


SAMPLES: tuple[tuple[Kind, int, int, int], ...] = (
    ("clear", 2, 960, 540),
    ("clear", 3, 720, 720),
    ("hazy", 1, 960, 540),
    ("hazy", 2, 960, 540),
    ("cloudy", 4, 1388, 519),
    ("cloudy", 5, 960, 540),
    ("snow", 5, 960, 540),
    ("foreground", 3, 960, 540),
    ("spires", 5, 600, 800),
    ("spires", 6, 960, 540),
    ("desert", 6, 960, 540),
    ("rover", 2, 960, 540),
)
"""Kind, seed, width and height of each sample scene."""


def sample_scenes() -> Iterator[Scene]:
    """Render the dozen scenes of `SAMPLES`, one at a time."""
    for kind, seed, width, height in SAMPLES:
        yield render(kind, seed, width, height)


def write_scenes(scenes: Iterable[Scene], folder: str | os.PathLike[str]) -> Iterator[Path]:
    """Write scenes and their truth as a data set, one at a time, each file whole.

    A scene becomes ``images/<name>.jpg`` and ``masks/<name>.png``, a grey picture of the same size
    that is 0 in the sky and 255 in the terrain.

    Args:
        scenes: What to write.
        folder: Where to.

    Yields:
        The path of each photo, once it and its mask are written.
    """
    for scene in scenes:
        path = Path(folder) / "images" / f"{scene.name}.jpg"
        terrain = ~scene.truth.to_mask(len(scene.photo))
        write_photo(Path(folder) / "masks" / f"{scene.name}.png", terrain * np.uint8(255))
        with replacing(path) as temporary:
            temporary.write_bytes(scene.jpeg)
        yield path
