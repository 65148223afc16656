"""How the detector holds on cameras that it has never seen: whole sources left out of training.

    python -m benchmarks.cameras DATA [MODELS [FILE.onnx ...]]

DATA is a folder with ``web_dataset``, ``mountains`` and ``uav``; one that is not there is left out.
MODELS is a folder of sky models that have not seen a source, see `benchmarks.left_out`. Further sky
networks are measured beside them, as they are.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from benchmarks.ablation import DEFAULT, LARGE, WITHOUT_SKY, compared, variants
from benchmarks.left_out import LeftOut, Models, Results
from benchmarks.misses import explained
from benchmarks.sources import Source, sources
from benchmarks.table import markdown, percent
from skyline_viz.evaluation.intervals import resampled
from skyline_viz.evaluation.results import PhotoResult

HEADER = (
    "left out, and tested", "photos", "mean A_err", "95 %", "median", "near the truth", "95 %",
    "gross misses", "95 %",
)  # fmt: skip


def measured(data: Path, models: Path | None = None, networks: Sequence[Path] = ()) -> str:
    """All tables: how good it is, what each of its parts brings, and what it gets wrong.

    Args:
        data: Folder of the real data sets.
        models: Folder of sky models that have not seen a source.
        networks: Further sky networks.
    """
    given = sources(data)
    left_out, small = LeftOut(given), Models(models)
    chosen = {one.name: one for one in variants(small, networks)}
    found = {name: left_out.results(one) for name, one in chosen.items()}
    parts = ["## Cameras that were never seen", told(given), small.missing(given)]
    parts += [
        f"{name.strip('*').capitalize()}:\n\n{table(given, found[name])}"
        for name in (DEFAULT, LARGE, WITHOUT_SKY)
        if found[name]
    ]
    parts += [compared(given, found), explained(left_out, chosen[DEFAULT], found[DEFAULT])]
    return "\n\n".join(part for part in parts if part)


def told(given: Sequence[Source]) -> str:
    """What is measured, and how."""
    names = ", ".join(f"{one.name} {one.tolerance:g} px" for one in given)
    return (
        "Each source is tested with filters and with a sky model that were trained on the other "
        "sources. The settings were chosen by these very figures, which are slightly optimistic "
        f"so. *Near the truth* is an A_err below a tolerance: {names}. A gross miss is over 5 % of "
        "the height. Intervals hold 95 %: of shares by Wilson's score, of means by the bootstrap. "
        "Frames of a clip resemble each other, and are drawn together. Rendered scenes are of "
        "the kinds that sky models were trained on, but other ones."
    )


def table(given: Sequence[Source], results: Results) -> str:
    """A line for each source."""
    return markdown(HEADER, [_line(source, results.get(source.name)) for source in given])


def _line(source: Source, results: Sequence[PhotoResult] | None) -> list[str]:
    count = str(len(source.items))
    if source.clips:
        count += f" of {len(set(source.groups))} clips"
    if results is None:
        return [source.name, count, "not measured", *[""] * 6]
    errors = [one.a_err for one in results]
    near, gross = source.near(results), [one.gross_miss for one in results]
    low, high = resampled(errors, source.groups)
    return [
        source.name,
        count,
        f"{np.mean(errors):.2f} px",
        f"{low:.2f} to {high:.2f}",
        f"{np.median(errors):.2f} px",
        f"{sum(near)}/{len(near)}",
        percent(source.share(near)),
        str(sum(gross)),
        percent(source.share(gross)),
    ]


def main() -> None:
    """Print the tables."""
    arguments = map(Path, sys.argv[1:])
    data, models, networks = next(arguments, None), next(arguments, None), list(arguments)
    if data is None or not data.is_dir():
        sys.exit(f"{data or 'no folder of data'} is not there.")
    print(measured(data, models, networks))


if __name__ == "__main__":
    main()
