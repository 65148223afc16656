"""Run every benchmark and write ``benchmarks/results.md``.

    python -m benchmarks [DATA]

DATA is a folder with the real data sets: ``web_dataset`` (photos with truth, in the layout in
which the authors publish the Web set) and, if there, ``mountains`` and ``uav`` (other photos with
truth) and ``new_dataset`` (large photos). Without it only the rendered samples are measured, and
the report says so.
"""

import datetime as dt
import os
import platform
import sys
from pathlib import Path

from benchmarks import (
    accuracy,
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
from skyline_viz import __version__
from skyline_viz.files import write_text

ROOT = Path(__file__).resolve().parent.parent


def main() -> None:
    """Run all benchmarks that the given data allow."""
    data = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    web = data / "web_dataset" if data else None
    parts = [
        "# Benchmarks",
        f"skyline-viz {__version__}, Python {platform.python_version()}, {os.cpu_count()} "
        f"processors ({platform.machine()}), {dt.datetime.now(dt.UTC):%Y-%m-%d}. "
        "Times are ratios within one run, or say what else they are.",
    ]
    if web is None or not web.is_dir():
        parts.append(f"Real photographs: **not run**, {web or 'no folder of data'} is not there.")
    else:
        parts += [accuracy.cross_validated(web), robustness.varied(web), filters.studies(web)]
        parts.append(methods.compared(web))
        others = (data / name for name in ("mountains", "uav"))
        parts.append(visibility.denied([web, *(one for one in others if one.is_dir())]))
    parts += [accuracy.rendered(ROOT / "sample_data"), speed.measured(web, ROOT / "sample_data")]
    parts.append(recordings.measured(web, ROOT / "sample_data"))
    parts += [labelling.measured(web, data), clicks.measured(), causes.confusion()]
    report = "\n\n".join(parts) + "\n"
    write_text(ROOT / "benchmarks" / "results.md", report)
    print(report)


if __name__ == "__main__":
    main()
