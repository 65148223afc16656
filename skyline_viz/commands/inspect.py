"""``skyline-viz inspect``: look at every stage of photos in the viewer."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING, Annotated, Any

import tyro

from skyline_viz.command_line.inputs import NO_PHOTOS, collect
from skyline_viz.command_line.local import called, local
from skyline_viz.command_line.messages import (
    GOOD,
    SOME_FAILED,
    UsageError,
    counted,
    say,
    status_after,
    tell,
    tell_done,
)
from skyline_viz.command_line.methods import MethodOptions, Methods
from skyline_viz.command_line.reporting import ReportFile, check_report
from skyline_viz.command_line.settings import (
    Switch,
    check_picture,
    window_size,
)
from skyline_viz.command_line.sizes import MaxMegapixels, foresee, pixels_of
from skyline_viz.command_line.truth_options import TruthOptions, Truths
from skyline_viz.commands import inspect_more
from skyline_viz.commands.inspect_report import write_report
from skyline_viz.running.batch import Failure, sentence
from skyline_viz.running.progress import ProgressBar
from skyline_viz.system.aftermath import passing_folder
from skyline_viz.system.memory import (
    FULL_MEGAPIXELS,
    FULL_RECORDING,
    MAX_MEGAPIXELS,
    RECORDING,
    RECORDING_FULL,
    in_words,
)
from skyline_viz.viewer.frugal import import_frugally

if TYPE_CHECKING:
    import rerun as rr

    from skyline_viz.datasets.dataset import DatasetItem
    from skyline_viz.datasets.named_item import NamedItem
    from skyline_viz.filter_bank import FilterBank
    from skyline_viz.method import Method
    from skyline_viz.viewer.contents import Contents, Fidelity


@dataclass(frozen=True)
class Inspect:
    """Look at every stage of photos in the viewer: edges, tensor, scores, cost, path.

    Examples:
        skyline-viz inspect photo.jpg
        skyline-viz inspect photo.jpg --truth mask.png --method default paper
        skyline-viz inspect photo.jpg --report photo.html
    """

    photos: Annotated[
        tuple[str, ...],
        tyro.conf.Positional,
        tyro.conf.arg(metavar="PHOTO"),
    ]
    """Photos, folders of photos, or data sets, by paths or addresses; several share one recording,
    a photo a step."""

    save: Annotated[Path | None, tyro.conf.arg(metavar="FILE.rrd")] = None
    """Write the recording to a file instead of opening the viewer; with --split, into a folder."""

    screenshot: Annotated[Path | None, tyro.conf.arg(metavar="FILE.png")] = None
    """Draw every tab into FILE-TAB.png (or .jpg) instead of opening the viewer; needs no screen."""

    screenshot_size: Annotated[str, tyro.conf.arg(metavar="WIDTHxHEIGHT")] = "1280x800"
    """Size of the viewer's window for --screenshot, in pixels."""

    serve: Switch = False
    """Serve the viewer to a browser on this machine, until Ctrl-C."""

    connect: Annotated[str | None, tyro.conf.arg(metavar="URL")] = None
    """Send the recording to a viewer that runs, such as rerun+http://127.0.0.1:9876/proxy."""

    headless: Switch = False
    """Make the recordings and throw them away: a check that everything works, without a viewer."""

    report: ReportFile = None
    """Write a report to be mailed instead of opening the viewer: one HTML file that needs none."""

    split: Switch = False
    """One recording a photo."""

    truth: Annotated[str | None, tyro.conf.arg(metavar="FILE")] = None
    """True skyline of a single photo, by its path or address: painted photo, mask, CSV or JSON.
    Data sets bring theirs."""

    sweep: Switch = False
    """Sweep single settings of one photo along timelines: drag one, and see the path change."""

    sweep_training: Annotated[str | None, tyro.conf.arg(metavar="DATASET")] = None
    """Folder or address of a data set to train filters of other sizes on, for --sweep; the photo
    itself is left out."""

    methods: MethodOptions = field(default_factory=Methods)
    """What to look at. Of two, the second is laid beside the first; of more, each gets a tab."""

    truths: TruthOptions = field(default_factory=Truths)
    """How to read masks that leave a choice."""

    full_megapixels: Annotated[float, tyro.conf.arg(metavar="N")] = FULL_MEGAPIXELS
    """Million pixels in one recording that are kept in full, 36 bytes each; of a larger photo all
    near its line, of more photos lean maps."""

    max_megapixels: MaxMegapixels = MAX_MEGAPIXELS
    """Largest photo that is read, in million pixels."""

    def run(self) -> int:
        """Detect, log and show; return the exit status."""
        if not self.photos:
            raise UsageError(NO_PHOTOS)
        self._check_targets()
        inputs = collect(self.photos, self.truths)
        if self.truth and len(inputs) > 1:
            raise UsageError(f"--truth belongs to one photo, and there are {len(inputs)}.")
        if self.sweep and len(inputs) > 1:
            raise UsageError(f"--sweep belongs to one photo, and there are {len(inputs)}.")
        if self.report:
            title = inputs[0].name if len(inputs) == 1 else called(self.photos[0])
            items = [replace(self._with_truth(one), name=one.name) for one in inputs]
            return write_report(self.report, title, items, self.methods.chosen())
        failures: list[Failure] = []
        pixels = self._sizes(inputs)
        using = self._using(inputs, failures)
        self._foresee(inputs, pixels)
        with self._folder() as folder:
            files = self._record(inputs, pixels, using, folder, failures)
            if files:
                self._show(files)
        return status_after(failures) or (GOOD if files else SOME_FAILED)

    def _sizes(self, inputs: Sequence[NamedItem]) -> dict[str, int]:
        """Pixels of each input by name; for large ones the viewer's library is told so."""
        if not 0 <= self.full_megapixels < float("inf"):
            raise UsageError(f"--full-megapixels is 0 or more, not {self.full_megapixels:g}.")
        named = (replace(one.item, name=one.name) for one in inputs)
        pixels = {one.name: n for one, n in pixels_of(named) if n <= self.max_megapixels * 1e6}
        if max(pixels.values(), default=0) > FULL_MEGAPIXELS * 1e6:
            import_frugally()
        return pixels

    def _foresee(self, inputs: Sequence[NamedItem], pixels: dict[str, int]) -> None:
        """Say what is too large, or is kept in part."""
        from skyline_viz.viewer.contents import fidelity_of

        total = max(pixels.values(), default=0) if self.split else sum(pixels.values())
        full = total <= self.full_megapixels * 1e6
        if not full:
            large = in_words(FULL_RECORDING * total)
            alone = self.split or len(inputs) == 1
            near = fidelity_of(total, self.full_megapixels, alone=alone) == "full"
            say(
                f"maps are kept {'whole near the line alone' if near else 'lean'}: "
                f"{total / 1e6:.1f} megapixels in full would be {large} in one recording; "
                f"--full-megapixels {math.ceil(total / 1e6)} keeps them."
            )
        size = RECORDING_FULL if full else RECORDING
        foresee((one.item for one in inputs), workers=1, bytes_a_pixel=size)

    def _check_targets(self) -> None:
        check_picture(self.screenshot)
        check_report(self.report)
        window_size(self.screenshot_size)
        if self.sweep_training and not self.sweep:
            raise UsageError("--sweep-training trains filters for --sweep, which is not asked for.")
        named = ("save", "screenshot", "serve", "connect", "headless", "report")
        chosen = [f"--{name}" for name in named if getattr(self, name)]
        if len(chosen) > 1:
            raise UsageError(f"{' and '.join(chosen)} exclude each other.")
        if self.report and (self.sweep or self.split):
            raise UsageError(
                f"--report and {'--sweep' if self.sweep else '--split'} exclude each other."
            )
        if chosen:
            return
        from skyline_viz.viewer.program.process import has_display  # the viewer is heavy

        if not has_display():
            raise UsageError(
                "there is no display to open the viewer on: use --save FILE.rrd, --serve, "
                "or --screenshot FILE.png."
            )

    def _using(self, inputs: Sequence[NamedItem], failures: list[Failure]) -> _Using:
        from skyline_viz.detector import Detector
        from skyline_viz.viewer.method_recording import COLOURS

        named = len(self.methods.method) + (self.methods.network is not None) + self.methods.ours
        if named > 1 + len(COLOURS):
            raise UsageError(
                f"{1 + len(COLOURS)} methods at most can be told apart on a photo, "
                f"and {named} are named."
            )
        first, *others = self.methods.chosen()
        sizes: Sequence[FilterBank] = []
        if self.sweep and not isinstance(first, Detector):
            raise UsageError(f"--sweep changes the settings of our detector, not {first.name}.")
        if self.sweep_training and isinstance(first, Detector):
            dataset = self.truths.open(self.sweep_training)
            sizes, failed = inspect_more.train_sizes(dataset, inputs[0], first)
            failures += failed
        if len(others) == 1:
            return _Using(first, others[0], sizes, [])
        return _Using(first, None, sizes, others)

    @contextmanager
    def _folder(self) -> Iterator[Path]:
        """Where recordings are written: where --save says, else for as long as they are shown."""
        if self.save:
            folder = self.save if self.split else self.save.parent
            folder.mkdir(parents=True, exist_ok=True)
            yield folder
        else:
            with passing_folder() as folder:
                yield folder

    def _record(
        self,
        inputs: Sequence[NamedItem],
        pixels: Mapping[str, int],
        using: _Using,
        folder: Path,
        failures: list[Failure],
    ) -> list[Path]:
        """Write the recordings, and return their files."""
        from skyline_viz.photo import PhotoError
        from skyline_viz.system.names import recording_id
        from skyline_viz.viewer.contents import fidelity_of
        from skyline_viz.viewer.recording import new_recording

        of_a_photo = (PhotoError, ValueError, MemoryError)  # what the other photos survive
        groups = [[one] for one in inputs] if self.split else [list(inputs)]
        files: list[Path] = []
        with ProgressBar(len(inputs), "photos") as bar:
            for group in groups:
                name = group[0].name if len(group) == 1 else called(self.photos[0])
                total = sum(pixels.get(one.name, 0) for one in group)
                fidelity = fidelity_of(total, self.full_megapixels, alone=len(group) == 1)
                together = self.save if not self.split else None
                file = together or folder / f"{recording_id(name)}.rrd"
                with suppress(_Nothing), new_recording(file, name) as recording:
                    contents = None
                    for step, one in enumerate(group):
                        recording.set_time("image", sequence=step)
                        try:
                            logged = self._log(recording, one, using, len(group), fidelity)
                            contents = contents or logged
                        except of_a_photo as problem:
                            failures.append(Failure(one.name, sentence(problem)))
                        bar.advance(one.name)
                    self._lay_out(recording, contents)
                    files.append(file)
        return [file for file in files if file.exists()]

    def _log(
        self,
        recording: rr.RecordingStream,
        one: NamedItem,
        using: _Using,
        together: int,
        fidelity: Fidelity,
    ) -> Contents:
        """Log a photo of `together` ones, and say what the recording now holds."""
        from skyline_viz.detecting.filter_detection import FilterDetection
        from skyline_viz.running.warming import warm_up
        from skyline_viz.viewer import entities, parting_words
        from skyline_viz.viewer.comparison import log_comparison
        from skyline_viz.viewer.contents import Contents, MethodContents
        from skyline_viz.viewer.recording import log_along_columns, log_detection

        photo, truth = one.item.photo(), self._with_truth(one).truth()
        warm_up()
        found = using.detector.detect(photo)
        alone = together == 1
        if alone:  # what is logged below is there in every column
            recording.set_time("column", sequence=entities.OPENING)
        ours = found if isinstance(found, FilterDetection) else None
        sweeps = []
        if self.sweep and ours:
            sweeps = inspect_more.begin_sweeps(recording, ours, using.sizes)
        verdict = log_detection(recording, found, truth, name=one.name, fidelity=fidelity)
        compared: dict[str, Any] = {}
        beside = None
        if using.other:
            second = using.other.detect(photo)
            beside = log_comparison(recording, found, second, truth, second.method, fidelity)
            held = MethodContents.of(second)
            compared = {
                "first": found.method,
                "compared": held.name,
                "compared_stages": held.stages,
                "apart": beside.unlike if alone else beside.of_any_photo,
            }
        methods = inspect_more.log_methods(recording, found, using.methods, truth, fidelity)
        others = inspect_more.log_other_lines(recording, found, truth) if alone else 0
        diagnosis = None
        if alone and truth is not None and truth.visible.any():
            diagnosis = inspect_more.log_diagnosis(recording, found, truth, one.name)
        if alone:
            recording.disable_timeline("column")
            openings = inspect_more.openings_of(sweeps)
            log_along_columns(recording, found, truth, openings)
        if sweeps and ours:
            inspect_more.log_sweeps(recording, sweeps, ours, truth)
        inspect_more.tell_verdict(verdict, using.detector, photo, one.name)
        if beside:
            tell(f"{one.name}: {parting_words.said(beside.parting)}")
        if found.visibility and found.visibility.doubt:
            tell(f"{one.name}: {found.visibility.doubt}")
        if diagnosis:
            tell(*diagnosis.said.splitlines())
        return Contents.of(
            found,
            fidelity,
            truth=truth is not None,
            diagnosed=diagnosis is not None and not diagnosis.right,
            columns=alone,
            photos=together,
            **compared,
            methods=methods,
            other_lines=others,
            swept=sweeps[0].timeline if sweeps else "",
        )

    def _with_truth(self, one: NamedItem) -> DatasetItem:
        """A photo with the truth that was given, or its own."""
        if self.truth is None:
            return one.item
        sky, terrain = self.truths.sky, self.truths.terrain
        return replace(
            one.item, truth_path=local(self.truth), label_map=False, sky=sky, terrain=terrain
        )

    def _lay_out(self, recording: rr.RecordingStream, contents: Contents | None) -> None:
        from skyline_viz.viewer.blueprints import detection_blueprint

        if contents is None:
            raise _Nothing
        recording.send_blueprint(detection_blueprint(contents))

    def _show(self, files: list[Path]) -> None:
        """Show recordings, and return when nobody looks any more."""
        from skyline_viz.viewer.program import process as viewer

        if self.headless:
            tell_done(f"{counted(len(files), 'recording')} made.")
        elif self.save:
            tell(f"Look at it with: rerun {self.save}")
        elif self.screenshot:
            window = window_size(self.screenshot_size)
            for file in files:
                several = f"-{file.stem}" if len(files) > 1 else ""
                for picture in viewer.save_pictures(file, self.screenshot, several, window):
                    tell_done(str(picture))
        elif self.connect:
            viewer.send(files, self.connect)
        elif self.serve:
            from skyline_viz.viewer.program.web_viewer import served

            with served(files) as address, suppress(KeyboardInterrupt):
                tell(f"Open {address} in a browser. Ctrl-C ends.")
                Event().wait()
        else:
            viewer.wait_for(viewer.open_viewer(files))


@dataclass(frozen=True)
class _Using:
    """What photos are looked at with."""

    detector: Method
    other: Method | None
    sizes: Sequence[FilterBank]
    methods: Sequence[Method]


class _Nothing(Exception):  # noqa: N818  # no error: there is nothing to write
    """No photo of a recording could be read."""
