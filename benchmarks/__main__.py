"""Run benchmarks and write ``benchmarks/results.md``.

    python -m benchmarks [DATA [MODELS [FILE.onnx ...]]] [--only PART ...]

DATA is a folder with the real data sets: ``web_dataset`` (photos with truth, in the layout in
which the authors publish the Web set) and, if there, ``mountains`` and ``uav`` (photos with masks)
and ``new_dataset`` (large photos). Without it only the rendered samples are measured, and the
report says so. MODELS and the files are the sky models of `benchmarks.cameras`. ``--only`` renews
some parts, and keeps the others as they were: each part says when it was measured.
"""

import argparse
import datetime as dt
import os
import platform
import re
from collections.abc import Callable
from pathlib import Path

from benchmarks import (
    accuracy,
    cameras,
    causes,
    clicks,
    confidence,
    filters,
    gestures,
    labelling,
    mended,
    methods,
    recordings,
    robustness,
    sequence,
    speed,
    visibility,
)
from benchmarks.left_out import Models
from skyline_viz import __version__
from skyline_viz.files import write_text
from skyline_viz.sky_model import SkyModel

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "benchmarks" / "results.md"
SAMPLES = ROOT / "sample_data"


def main() -> None:
    """Run all benchmarks that the given data allow, or some of them."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", allow_abbrev=False)
    parser.add_argument("data", type=Path, nargs="?", help="folder with the real data sets")
    parser.add_argument("models", type=Path, nargs="?", help="sky models that saw less")
    parser.add_argument("networks", type=Path, nargs="*", help="further sky networks")
    parser.add_argument("--only", nargs="+", default=[], metavar="PART")
    given = parser.parse_args()
    parts = _parts(given.data, given.models, given.networks)
    if unknown := [name for name in given.only if name not in parts]:
        parser.error(f"{unknown[0]} is no part; there are {', '.join(parts)}")
    told = _told(RESULTS.read_text(encoding="utf-8")) if given.only else {}
    made = f"{dt.datetime.now(dt.UTC):%Y-%m-%d}, skyline-viz {__version__}"
    for name, measure in parts.items():
        if not given.only or name in given.only:
            told[name] = f"<!-- {name} -->\n\n{measure().strip()}\n\nMeasured {made}."
            write_text(RESULTS, _report({one: told[one] for one in parts if one in told}))
            print(told[name], flush=True)


def _parts(
    data: Path | None, models: Path | None, networks: list[Path]
) -> dict[str, Callable[[], str]]:
    """What can be measured, by name, in the order of the report."""
    web = data / "web_dataset" if data else None
    parts: dict[str, Callable[[], str]] = {}
    if data is None or web is None or not web.is_dir():
        missing = f"## Real photographs\n\n**Not run**: {web or 'no folder of data'} is not there."
        parts["real"] = lambda: missing
    else:
        unseen = Models(models)("web")
        sky = unseen or SkyModel.small()
        others = [one for name in ("mountains", "uav") if (one := data / name).is_dir()]
        parts["cameras"] = lambda: cameras.measured(data, models, networks)
        parts["confidence"] = lambda: confidence.measured(data, models)
        parts["accuracy"] = lambda: accuracy.cross_validated(web, sky) + _sky_told(unseen)
        parts["robustness"] = lambda: robustness.varied(web, sky) + _sky_told(unseen)
        parts["mended"] = lambda: mended.measured(data, models)
        parts["filters"] = lambda: filters.studies(data, sky)
        parts["methods"] = lambda: methods.compared(web, sky) + _sky_told(unseen)
        parts["visibility"] = lambda: visibility.denied([web, *others], Models(models))
        parts["gestures"] = lambda: gestures.measured(data, models)
        parts["sequence"] = lambda: sequence.measured(data, models)
        parts["labelling"] = lambda: labelling.measured(web, data, sky)
    parts["samples"] = lambda: accuracy.rendered(SAMPLES)
    parts["speed"] = lambda: speed.measured(web, SAMPLES)
    parts["recordings"] = lambda: recordings.measured(web, SAMPLES)
    parts["clicks"] = clicks.measured
    parts["causes"] = causes.confusion
    return parts


def _report(told: dict[str, str]) -> str:
    """The whole report, from the text of each part."""
    head = (
        f"# Benchmarks\n\nOn Python {platform.python_version()}, {os.cpu_count()} processors "
        f"({platform.machine()}). Times are ratios within one run, or say what else they are."
    )
    return "\n\n".join([head, *told.values()]) + "\n"


def _told(report: str) -> dict[str, str]:
    """The text of each part of a report, by name."""
    marks = list(re.finditer(r"^<!-- (\w+) -->$", report, re.MULTILINE))
    ends = [mark.start() for mark in marks[1:]] + [len(report)]
    return {
        mark[1]: report[mark.start() : end].strip() for mark, end in zip(marks, ends, strict=True)
    }


def _sky_told(unseen: SkyModel | None) -> str:
    """What the folds of Web photographs are tested with: filters are trained anew, this is not."""
    if unseen:
        return f"\n\nTested with the sky model {unseen.name}, which saw none of these photographs."
    return (
        "\n\n**Not a test**: no sky model that has not seen the Web photographs was named. The "
        "shipped one has, so figures are too good wherever the sky model is used."
    )


if __name__ == "__main__":
    main()
