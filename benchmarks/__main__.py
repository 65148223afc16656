"""Run every benchmark and write ``benchmarks/results.md``.

    python -m benchmarks [DATA [MODELS [FILE.onnx ...]]]

DATA is a folder with the real data sets: ``web_dataset`` (photos with truth, in the layout in
which the authors publish the Web set) and, if there, ``mountains`` and ``uav`` (photos with masks)
and ``new_dataset`` (large photos). Without it only the rendered samples are measured, and the
report says so. MODELS and the files are the sky models of `benchmarks.cameras`.
"""

import datetime as dt
import os
import platform
import sys
from pathlib import Path

from benchmarks import (
    accuracy,
    cameras,
    causes,
    clicks,
    filters,
    labelling,
    methods,
    recordings,
    robustness,
    speed,
    visibility,
)
from benchmarks.left_out import Models
from skyline_viz import __version__
from skyline_viz.files import write_text
from skyline_viz.sky_model import SkyModel

ROOT = Path(__file__).resolve().parent.parent


def main() -> None:
    """Run all benchmarks that the given data allow."""
    arguments = map(Path, sys.argv[1:])
    data, models, networks = next(arguments, None), next(arguments, None), list(arguments)
    web = data / "web_dataset" if data else None
    unseen = Models(models)("web")
    sky = unseen or SkyModel.small()
    parts = [
        "# Benchmarks",
        f"skyline-viz {__version__}, Python {platform.python_version()}, {os.cpu_count()} "
        f"processors ({platform.machine()}), {dt.datetime.now(dt.UTC):%Y-%m-%d}. "
        "Times are ratios within one run, or say what else they are.",
    ]
    if data is None or web is None or not web.is_dir():
        parts.append(f"Real photographs: **not run**, {web or 'no folder of data'} is not there.")
    else:
        parts += [_sky_told(unseen), accuracy.cross_validated(web, sky)]
        parts.append(cameras.measured(data, models, networks))
        parts += [robustness.varied(web, sky), filters.studies(data, sky)]
        parts.append(methods.compared(web, sky))
        others = (data / name for name in ("mountains", "uav"))
        parts.append(visibility.denied([web, *(one for one in others if one.is_dir())]))
    parts += [accuracy.rendered(ROOT / "sample_data"), speed.measured(web, ROOT / "sample_data")]
    parts.append(recordings.measured(web, ROOT / "sample_data"))
    parts += [labelling.measured(web, data, sky), clicks.measured(), causes.confusion()]
    report = "\n\n".join(parts) + "\n"
    write_text(ROOT / "benchmarks" / "results.md", report)
    print(report)


def _sky_told(unseen: SkyModel | None) -> str:
    """What the folds of Web photographs are tested with: filters are trained anew, this is not."""
    if unseen:
        return (
            f"Web photographs are tested with the sky model {unseen.name}, which saw none of them."
        )
    return (
        "**Not a test**: no sky model that has not seen the Web photographs was named. The shipped "
        "one has, so figures of Web photographs are too good wherever the sky model is used."
    )


if __name__ == "__main__":
    main()
