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

import numpy as np
from PIL import Image

from skyline_viz.arrays import F32, U8, read_only
from skyline_viz.files import replacing
from skyline_viz.photo import write_photo
from skyline_viz.rendering.filters import mix, soften
from skyline_viz.rendering.kinds import KINDS, Kind, View, compose
from skyline_viz.rendering.mountains import mountain_range
from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.plain import Plain, plain
from skyline_viz.rendering.sky import paint_sky
from skyline_viz.rendering.terrain import Frame, project
from skyline_viz.skyline import Skyline

_QUALITY = 90


@dataclass(frozen=True, eq=False)
class Scene:
    """A rendered photograph and its true skyline."""

    kind: Kind
    seed: int
    photo: U8 = field(repr=False)
    """``(H, W, 3)`` uint8 RGB: the decoded `jpeg`."""

    truth: Skyline
    """Row of the first pixel of each column that is at least half terrain; all visible."""

    jpeg: bytes = field(repr=False)
    """The photo as a JPEG file."""

    @property
    def name(self) -> str:
        """Kind and seed, as ``clear-1``."""
        return f"{self.kind}-{self.seed}"


def render(kind: Kind, seed: int, width: int = 960, height: int = 540) -> Scene:
    """Render one scene.

    Args:
        kind: One of `KINDS`.
        seed: Not negative; each seed is another place and another light.
        width: Columns of the photo.
        height: Rows of the photo.

    Returns:
        The scene; equal arguments give equal bytes.

    Raises:
        ValueError: No such kind, a negative seed, or a side below 32 pixels.
    """
    if kind not in KINDS:
        raise ValueError(f"a scene is one of {', '.join(KINDS)}, not {kind!r}")
    if seed < 0:
        raise ValueError(f"a seed is 0 or more, not {seed}")
    if min(width, height) < 32:
        raise ValueError(f"a scene is at least 32 by 32 pixels, not {width}x{height}")
    rng = np.random.default_rng([KINDS.index(kind), seed])
    frame = Frame(width, height)
    view = compose(kind, frame, rng)
    photo, outline = _draw(frame, view, rng)
    truth = np.clip(np.ceil(outline - np.float32(0.5)), 0, height - 1)
    jpeg = _expose(photo, view, rng, grey=kind == "rover")
    decoded = np.array(Image.open(io.BytesIO(jpeg)).convert("RGB"))
    read_only(decoded)
    return Scene(kind, seed, decoded, Skyline(rows=truth), jpeg)


def _draw(frame: Frame, view: View, rng: np.random.Generator) -> tuple[F32, F32]:
    sunward = 1 if view.light.sun[0] > 0 else -1
    photo = paint_sky(frame, Noise(rng), rng, view.sky, sunward=sunward)
    outline: F32 = np.full(frame.width, frame.height, np.float32)
    for spec in view.terrain:
        noise = Noise(rng)  # its own, for small photos take fewer fields from it than large ones
        terrain = (
            plain(frame, noise, spec, view.light)
            if isinstance(spec, Plain)
            else mountain_range(frame, noise, rng, spec, view.light)
        )
        outline = np.minimum(outline, project(terrain, photo))
    return photo, outline


def _expose(photo: F32, view: View, rng: np.random.Generator, *, grey: bool) -> bytes:
    """What lens, film and JPEG make of linear light ``(H, W, 3)``."""
    height, width = photo.shape[:2]
    x = ((np.arange(width) + 0.5) / width - 0.5).astype(np.float32)[None, :]
    y = ((np.arange(height) + 0.5) / height - 0.5).astype(np.float32)[:, None]
    photo = photo * (1 - (x * x + y * y) * np.float32(0.45))[..., None]
    photo = soften(photo, 0.11)
    if grey:
        photo = np.repeat((photo[..., :1] + photo[..., 1:2] * 2 + photo[..., 2:]) / 4, 3, axis=2)
    tone = np.sqrt(np.clip(photo, 0, 1))  # a gamma of 2
    tone = mix(tone, tone * tone * (3 - 2 * tone), view.contrast)
    # Four dice make a bell; most of the grain is common to the three colours.
    dice = rng.integers(0, 256, (4, height, width), dtype=np.uint8).astype(np.int16).sum(axis=0)
    grain = soften((dice - 510).astype(np.float32), 0.16)[..., None]
    if not grey:
        tint = rng.integers(-100, 101, (height, width, 3), dtype=np.int16).astype(np.float32)
        grain = grain + tint
    levels = np.rint(tone * 255 + grain * np.float32(view.grain / 148))
    pixels = np.clip(levels, 0, 255).astype(np.uint8)
    file = io.BytesIO()
    image = Image.fromarray(pixels[..., 0] if grey else pixels)
    image.save(file, "JPEG", quality=_QUALITY)
    return file.getvalue()


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
