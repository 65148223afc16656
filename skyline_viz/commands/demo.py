"""``skyline-viz demo``: from nothing to a gallery of detected skylines."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from skyline_viz import rendering
from skyline_viz.command_line.inputs import collect, output_folder
from skyline_viz.command_line.messages import SOME_FAILED, say, status_after, tell
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.settings import Folder
from skyline_viz.command_line.sizes import MaxMegapixels
from skyline_viz.commands.gallery import build, show, show_picture
from skyline_viz.commands.render import write_with_progress
from skyline_viz.datasets.dataset import DatasetError
from skyline_viz.datasets.layouts import open_dataset
from skyline_viz.system.memory import MAX_MEGAPIXELS


@dataclass(frozen=True)
class Demo:
    """Find the skylines of the sample photos, or of yours, and show them as a gallery.

    Examples:
        skyline-viz demo
        skyline-viz demo photos
        skyline-viz demo photos --out gallery
    """

    photos: Annotated[
        tuple[str, ...],
        tyro.conf.Positional,
        tyro.conf.arg(metavar="PHOTO"),
    ] = ()
    """Photos, folders of photos, or data sets, by paths or addresses; the sample photos unless
    given."""

    out: Folder = Path("skyline-demo")
    """Folder of the gallery; without a display, a picture of it goes there, too."""

    methods: MethodOptions = field(default_factory=Methods)
    """What detects, one method; our detector with its default settings unless given."""

    workers: int = 0
    """Processes to work in; 0 chooses by the number of photos, their size and the free memory."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Detect, record and show; return the exit status."""
        from skyline_viz.viewer.program.process import has_display  # heavy
        from skyline_viz.viewer.program.rerun_internals import ViewerError

        inputs = collect(self.photos or [self._samples()])
        output_folder(self.out, (one.item for one in inputs))
        entries, failures = build(self.out, inputs, self.methods.one(), self.workers)
        if not entries:
            return status_after(failures) or SOME_FAILED
        if has_display():
            show(self.out, entries, window=True)
        else:
            try:
                show_picture(self.out, entries, self.out / "gallery.png")
            except ViewerError as error:
                say(f"no picture of the gallery was drawn: {error}")
            shown = " ".join(map(str, self.photos or [self._samples()]))
            serve = f"skyline-viz gallery {shown} --out {self.out} --serve"
            tell(f"There is no display here. This serves the gallery to a browser: {serve}")
        return status_after(failures)

    def _samples(self) -> Path:
        """Folder of the sample photos: of a checkout, or rendered now."""
        checkout = Path(__file__).resolve().parents[2]
        for folder in (Path("sample_data"), checkout / "sample_data", self.out / "sample_data"):
            try:
                if len(open_dataset(folder)):
                    return folder
            except DatasetError:
                continue
        folder = output_folder(self.out, ()) / "sample_data"
        say(f"rendering sample photos into {folder}.")
        list(write_with_progress(rendering.sample_scenes(), folder, len(rendering.SAMPLES)))
        return folder
