"""``skyline-viz render``: sample photos with exact truth, from a seed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import tyro

from skyline_viz import rendering
from skyline_viz.command_line.inputs import output_folder
from skyline_viz.command_line.messages import GOOD, UsageError, counted, tell_done
from skyline_viz.command_line.settings import Folder
from skyline_viz.running.progress import ProgressBar

if TYPE_CHECKING:
    from skyline_viz.rendering import Scene


@dataclass(frozen=True)
class Render:
    """Render mountain scenes with exact truth: the samples, byte for byte, or others.

    Examples:
        skyline-viz render --out samples
        skyline-viz render --kind hazy snow --count 8 --out scenes
        skyline-viz render --kind all --camera any --seed 7 --out scenes
    """

    out: Folder = Path("sample_data")
    """Folder for images/NAME.jpg and masks/NAME.png (0 is sky, 255 terrain)."""

    kind: Annotated[tuple[str, ...], tyro.conf.arg(metavar="KIND")] = ()
    """Kinds of scenes, or all, to render others than the samples; a wrong one gets the list."""

    seed: int = 1
    """Seed of the first scene; each seed is another place and another light."""

    count: int = 1
    """Number of scenes of each kind, with one seed after the other."""

    width: int = 960
    """Columns of the photos."""

    height: int = 540
    """Rows of the photos."""

    camera: Literal["plain", "any"] = "plain"
    """plain is upright and good; any is tilted, blurred, grainy or framed, as the seed chooses."""

    def run(self) -> int:
        """Render and write the scenes; return the exit status."""
        if not self.kind and self != Render(out=self.out):
            raise UsageError(
                "--seed, --count, --width, --height and --camera are for scenes of a --kind."
            )
        if self.count < 1:
            raise UsageError(f"--count is 1 or more, not {self.count}.")
        output_folder(self.out, ())
        kinds: Any = rendering.KINDS if self.kind == ("all",) else dict.fromkeys(self.kind)
        seeds = range(self.seed, self.seed + self.count)
        size = self.width, self.height
        scenes = (
            (rendering.render(k, n, *size, camera=self.camera) for k in kinds for n in seeds)
            if kinds
            else rendering.sample_scenes()
        )
        total = len(kinds) * self.count if kinds else len(rendering.SAMPLES)
        count = 0
        for path in write_with_progress(scenes, self.out, total):
            tell_done(str(path))
            count += 1
        tell_done(f"{counted(count, 'scene')} in {self.out}")
        return GOOD


def write_with_progress(scenes: Iterable[Scene], folder: Path, total: int) -> Iterator[Path]:
    """Write scenes as a data set with a progress bar; yield the path of each photo.

    Args:
        scenes: What to write.
        folder: Where to.
        total: Number of scenes, for the progress bar.
    """
    with ProgressBar(total, "scenes") as bar:
        for path in rendering.write_scenes(scenes, folder):
            bar.advance(path.stem)
            yield path
