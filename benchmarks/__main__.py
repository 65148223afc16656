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
)
from skyline_viz import __version__
from skyline_viz.files import write_text

ROOT = Path(__file__).resolve().parent.parent


def main() -> None:
    """Run all benchmarks that the given data allow."""
    arguments = map(Path, sys.argv[1:])
    data, models, networks = next(arguments, None), next(arguments, None), list(arguments)
    web = data / "web_dataset" if data else None
    parts = [
        "# Benchmarks",
        f"skyline-viz {__version__}, Python {platform.python_version()}, {os.cpu_count()} "
        f"processors ({platform.machine()}), {dt.datetime.now(dt.UTC):%Y-%m-%d}. "
        "Times are ratios within one run, or say what else they are.",
    ]
    if data is None or web is None or not web.is_dir():
        parts.append(f"Real photographs: **not run**, {web or 'no folder of data'} is not there.")
    else:
        parts += [accuracy.cross_validated(web), cameras.measured(data, models, networks)]
        parts += [robustness.varied(web), filters.studies(web)]
        parts.append(methods.compared(web))
    parts += [accuracy.rendered(ROOT / "sample_data"), speed.measured(web, ROOT / "sample_data")]
    parts.append(recordings.measured(web, ROOT / "sample_data"))
    parts += [labelling.measured(web, data), clicks.measured(), causes.confusion()]
    report = "\n\n".join(parts) + "\n"
    write_text(ROOT / "benchmarks" / "results.md", report)
    print(report)


if __name__ == "__main__":
    main()
