"""``skyline-viz render``: sample photos with exact truth, from a seed."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import tyro

from skyline_viz.commands.inputs import output_folder
from skyline_viz.commands.messages import GOOD, UsageError, counted
from skyline_viz.commands.settings import Folder


@dataclass(frozen=True)
class Render:
    """Render mountain scenes with exact truth: the samples, byte for byte, or others."""

    out: Folder = Path("sample_data")
    """Folder for images/NAME.jpg and masks/NAME.png (0 is sky, 255 terrain)."""

    kind: Annotated[str | None, tyro.conf.arg(metavar="KIND")] = None
    """Kind of scenes, to render others than the samples; a wrong one gets the list."""

    seed: int = 1
    """Seed of the first scene; each seed is another place and another light."""

    count: int = 1
    """Number of scenes, with one seed after the other."""

    width: int = 960
    """Columns of the photos."""

    height: int = 540
    """Rows of the photos."""

    def run(self) -> int:
        """Render and write the scenes; return the exit status."""
        if self.kind is None and self != Render(out=self.out):
            raise UsageError("--seed, --count, --width and --height are for scenes of a --kind.")
        if self.count < 1:
            raise UsageError(f"--count is 1 or more, not {self.count}.")
        output_folder(self.out, ())
        if self.kind is None:
            from skyline_viz.rendering import write_samples  # noqa: PLC0415

            paths = write_samples(self.out)
        else:
            seeds = range(self.seed, self.seed + self.count)
            paths = [self._write(self.kind, seed) for seed in seeds]
        for path in paths:
            print(path)
        print(f"{counted(len(paths), 'scene')} in {self.out}")
        return GOOD

    def _write(self, kind: str, seed: int) -> Path:
        from skyline_viz.files import replacing  # noqa: PLC0415
        from skyline_viz.photo import write_photo  # noqa: PLC0415
        from skyline_viz.rendering import render  # noqa: PLC0415

        scene = render(kind, seed, self.width, self.height)  # type: ignore[arg-type]  # it checks
        path = self.out / "images" / f"{scene.name}.jpg"
        with replacing(path) as temporary:
            temporary.write_bytes(scene.jpeg)
        terrain = ~scene.truth.to_mask(len(scene.photo))
        mask = terrain.astype(np.uint8) * np.uint8(255)
        write_photo(self.out / "masks" / f"{scene.name}.png", mask)
        return path
