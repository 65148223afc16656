"""Cameras of the renderer: how they are held, and what lens, film and JPEG make of the light."""

import io
from dataclasses import dataclass

import numpy as np
from PIL import Image

from skyline_viz.arrays import F32
from skyline_viz.rendering.filters import mix, soften
from skyline_viz.rendering.marks import Border, bars, sash, stamp
from skyline_viz.rendering.picture import Picture
from skyline_viz.rendering.terrain import Colour, Frame, tint


@dataclass(frozen=True)
class Camera:
    """A camera in somebody's hand; the plain one, unless told otherwise."""

    roll: float = 0.0
    """How far it is tilted, as the tangent of half the angle: 0.22 is 25 degrees."""

    pitch: float = 0.0
    """How far down it moves everything, as a share of the height: it looks up, or down (< 0)."""

    exposure: float = 1.0
    cast: Colour = (1.0, 1.0, 1.0)
    """What it makes of white."""

    flare: float = 0.0
    """Light that lens and window spread over the whole photo."""

    vignette: float = 0.45
    """What is lost towards the corners."""

    blur: int = 0
    """How often the photo is softened, beyond what every lens does."""

    grain: float = 1.0
    """How many times the grain of the film."""

    grey: bool = False
    quality: int = 90
    """Quality of the JPEG, 1 to 95."""

    border: Border = ""
    """What the photo is seen through, or framed with."""

    margin: float = 0.05
    """Width of the border, as a share of the height."""

    shade: float = 0.0
    """Brightness of the border, 0 to 1."""

    stamp: bool = False
    """Whether it writes the date into the lower right corner."""

    def canvas(self, frame: Frame) -> Frame:
        """What has to be drawn, so that the tilted camera has no empty corners."""
        if not self.roll:
            return frame
        cosine, sine = self._turn()
        across = abs(cosine) * frame.width + abs(sine) * frame.height
        along = abs(cosine) * frame.height + abs(sine) * frame.width
        return Frame(int(across) + 4, int(along) + 4)

    def take(self, drawn: Picture, frame: Frame) -> Picture:
        """What it sees of a picture of the size of `canvas`: one of the size of `frame`."""
        picture = self._tilted(drawn, frame) if self.roll else drawn
        if self.border == "window":
            share = sash(picture, self.margin)
            picture.paint(share, tint((self.shade,) * 3), "thing")
        return picture

    def _turn(self) -> tuple[float, float]:
        """Cosine and sine of the angle."""
        half = self.roll
        return (1 - half * half) / (1 + half * half), 2 * half / (1 + half * half)

    def _tilted(self, drawn: Picture, frame: Frame) -> Picture:
        cosine, sine = (np.float32(part) for part in self._turn())
        x = (np.arange(frame.width) - (frame.width - 1) / 2).astype(np.float32)[None, :]
        y = (np.arange(frame.height) - (frame.height - 1) / 2).astype(np.float32)[:, None]
        column: F32 = x * cosine - y * sine + np.float32((drawn.frame.width - 1) / 2)
        row: F32 = x * sine + y * cosine + np.float32((drawn.frame.height - 1) / 2)
        left, top = np.floor(column), np.floor(row)
        right_part, low_part = column - left, row - top
        start = top.astype(np.intp) * drawn.frame.width + left.astype(np.intp)

        def sample(field: F32) -> F32:
            flat = field.reshape(drawn.frame.width * drawn.frame.height, -1)
            across, along = right_part[..., None], low_part[..., None]
            lines = [
                mix(flat[start + k], flat[start + k + 1], across) for k in (0, drawn.frame.width)
            ]
            return mix(lines[0], lines[1], along)

        cover, hidden = sample(drawn.cover)[..., 0], sample(drawn.hidden)[..., 0]
        return Picture(frame, sample(drawn.photo), cover, hidden)

    def expose(
        self, photo: F32, rng: np.random.Generator, *, contrast: float, grain: float
    ) -> bytes:
        """The JPEG file of linear light ``(H, W, 3)``.

        Args:
            photo: What falls through the lens.
            rng: Of the grain.
            contrast: How much darker than true the dark, and brighter the bright tones are.
            grain: Standard deviation of the film grain, in levels of 255.
        """
        height, width = photo.shape[:2]
        x = ((np.arange(width) + 0.5) / width - 0.5).astype(np.float32)[None, :]
        y = ((np.arange(height) + 0.5) / height - 0.5).astype(np.float32)[:, None]
        photo = photo * (1 - (x * x + y * y) * np.float32(self.vignette))[..., None]
        photo = soften(photo, 0.11)
        for _ in range(self.blur):
            photo = soften(photo, 0.25)
        if self.grey:
            photo = np.repeat(
                (photo[..., :1] + photo[..., 1:2] * 2 + photo[..., 2:]) / 4, 3, axis=2
            )
        photo = photo * (tint(self.cast) * np.float32(self.exposure)) + np.float32(self.flare)
        tone = np.sqrt(np.clip(photo, 0, 1))  # a gamma of 2
        tone = mix(tone, tone * tone * (3 - 2 * tone), contrast)
        # Four dice make a bell; most of the grain is common to the three colours.
        dice = rng.integers(0, 256, (4, height, width), dtype=np.uint8).astype(np.int16).sum(axis=0)
        noise = soften((dice - 510).astype(np.float32), 0.16)[..., None]
        if not self.grey:
            noise = noise + rng.integers(-100, 101, (height, width, 3), dtype=np.int16).astype(
                np.float32
            )
        levels = np.rint(tone * 255 + noise * np.float32(grain * self.grain / 148))
        pixels = np.clip(levels, 0, 255).astype(np.uint8)
        pixels[bars(self.border, self.margin, (height, width))] = round(255 * self.shade)
        if self.stamp:
            pixels[stamp(height, width)] = (255, 140, 30)
        file = io.BytesIO()
        image = Image.fromarray(pixels[..., 0] if self.grey else pixels)
        image.save(file, "JPEG", quality=self.quality)
        return file.getvalue()


PLAIN = Camera()
"""The camera of the sample scenes."""


def any_camera(rng: np.random.Generator) -> Camera:
    """One of many cameras: tilted, looking up or down, of good and bad lenses, films and light."""

    def between(low: float, high: float) -> float:
        return low + (high - low) * float(rng.random())

    def seldom(chance: float, low: float, high: float, usual: float) -> float:
        value, dice = between(low, high), float(rng.random())
        return value if dice < chance else usual

    borders: tuple[Border, ...] = ("letterbox", "pillarbox", "passepartout", "window")
    border: Border = borders[int(rng.integers(4))] if rng.random() < 0.14 else ""
    warm, green = between(-0.14, 0.14), between(-0.07, 0.07)
    strong = seldom(0.2, 1.5, 3.0, 1.0)
    return Camera(
        roll=seldom(0.5, -0.09, 0.09, 0.0) if rng.random() < 0.7 else between(-0.23, 0.23),
        pitch=seldom(0.4, -0.3, 0.45, 0.0),
        exposure=seldom(0.5, 0.45, 1.9, 1.0),
        cast=(1 + warm * strong, 1 + green * strong, 1 - warm * strong),
        flare=seldom(0.25, 0.0, 0.12, 0.0),
        vignette=between(0.0, 1.3),
        blur=int(seldom(0.3, 1, 5, 0)),
        grain=seldom(0.35, 1.0, 6.0, between(0.2, 1.2)),
        grey=bool(rng.random() < 0.06),
        quality=round(seldom(0.4, 25, 80, 90)),
        border=border,
        margin=between(0.02, 0.13),
        stamp=bool(rng.random() < 0.06),
        shade=0.0 if rng.random() < 0.7 else between(0, 0.95),
    )
